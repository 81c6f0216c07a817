"""The outline of an insole: found on the foot, drawn, trimmed to a shoe.

``insole_outline.insole_outline`` returns it, ``trim_line.trim_points`` is the front of a short
shell, ``shoe_outline.ShoeOutline`` the outside of a shoe.
"""
