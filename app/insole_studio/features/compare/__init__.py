"""Comparing surfaces.

``actions.COMPARE_ACTIONS`` of ``compare_window.CompareWindow``.
"""
