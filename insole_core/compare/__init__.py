"""How far two surfaces differ.

``comparison_source.read_source`` reads what is compared, ``comparison.compare_surfaces`` compares
it.
"""
