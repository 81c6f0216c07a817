"""Pads: their shapes, places and heights.

``pad_shapes.local_outline``, ``pad_places.placed_pad``, ``pad_heights.pad_heights``.
"""
