"""The contact surface: the sole on a grid, and what each correction does to it.

``contact.contact_base``, ``pads_on_surface.apply_pads``.
"""
