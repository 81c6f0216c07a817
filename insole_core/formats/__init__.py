"""Formats of surfaces: a module for each, and one table of what they are.

``file_formats`` declares every format; ``reading.read_raw`` makes a ``raw_surface.RawSurface`` of a
``scan_content.ScanContent``, ``solid_content.write_solids`` writes the parts of a
``solid_content.SolidContent``; ``units.Unit`` is what the numbers of a file are taken for.
"""
