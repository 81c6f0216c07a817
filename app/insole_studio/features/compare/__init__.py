"""Comparing surfaces.

``compare_window.COMPARE_ACTIONS`` of ``compare_window.CompareWindow``.
"""
