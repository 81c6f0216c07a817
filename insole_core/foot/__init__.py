"""A foot: found in a scan, placed, measured.

``foot.Foot`` is the value, ``foot_placement.find_foot`` finds it, ``landmarks.find_landmarks`` and
``measures.measure`` say what it is like, ``display_surface.DisplaySurface`` how it is shown.
"""
