"""How far two surfaces differ.

``comparison.read_source`` reads what is compared, ``comparison.compare_surfaces`` compares it.
"""
