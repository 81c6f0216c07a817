"""A coarse foot for display while the fine one is computed."""

from __future__ import annotations

from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import in_large_pieces, relaxed
from insole_core.reconstruct.fusion.distance_field import FieldLimits, mesh_views
from insole_core.reconstruct.fusion.prepared_view import PreparedView
from insole_core.reconstruct.fusion.texture import color_vertices

_LATTICE = FieldLimits(cell_mm=3.0, truncation_mm=9.0)
_RELAXING_ROUNDS = 5
_LEAST_PIECE = 0.05


def coarse_foot(views: list[PreparedView]) -> TriangleMesh:
    """Mesh and colour all views coarsely, mm, reference frame, ten times as fast as `fuse`."""
    mesh = mesh_views(views, _LATTICE)
    mesh = mesh.part(in_large_pieces(mesh, _LEAST_PIECE))
    mesh = mesh.moved(relaxed(mesh, _RELAXING_ROUNDS))
    return mesh.with_attributes(colors=color_vertices(mesh, [view.reading for view in views]))
