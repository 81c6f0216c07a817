"""Pads by themselves: their values, shapes and heights, where they are grabbed, what is unusual.

``pad_form.PadForm``, ``pad_shapes.local_outline``, ``pad_heights.pad_heights``.
"""
