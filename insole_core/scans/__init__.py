"""Scans of any scanner: read, and made a clean surface in millimetres.

``mesh_file.read_mesh`` reads any format and returns a ``mesh_file.ReadMesh``.
"""
