"""The prescription as a value: its parts, limits, file and differences.

``design.InsoleDesign`` is the value, ``design_json.read_design`` its file, ``device.apply_device``
a kind of insole, ``design_differences.design_differences`` what changes between two.
"""
