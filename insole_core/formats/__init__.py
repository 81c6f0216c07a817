"""Formats of surfaces: a module for each, and one table of what they are.

``file_formats`` declares every format; ``reading.read_raw`` makes a ``raw_surface.RawSurface`` of a
``scan_content.ScanContent``, ``writing.write_solids`` writes a ``solid_content.SolidContent``;
``units.Unit`` is what the numbers of a file are taken for.
"""
