"""Fusion of the registered depth readings of all views to one smooth surface.

``fused_surface.fuse`` does it; ``matching_error`` holds the learnt correction.
"""
