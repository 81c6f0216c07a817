"""The inside of shoes, by size or by last.

``shoe_sizes.ShoeTable``, ``last.last_outline``.
"""
