"""Fusion of the registered depth readings of all views to one smooth surface."""
