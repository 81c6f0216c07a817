"""What is unusual about a design on its foot; nothing here refuses it.

``design_warnings.design_warnings`` asks for all of them; what the clinic's rules say of an element
stands with the element, `Correction.rule`.
"""
