"""What is unusual about a design on its foot; nothing here refuses it.

``clinic_rules.design_warnings`` asks for all of them, ``design_warning.DesignWarning`` is one.
"""
