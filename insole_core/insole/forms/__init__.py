"""Base forms: a shape that takes the place of the scanned sole.

``form_surface.base_surface`` lays one, ``form_file.read_form`` reads one.
"""
