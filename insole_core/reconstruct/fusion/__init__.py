"""From placed depth readings of all views to one smooth surface."""
