"""Remove scraps that float beside a scan: blankets, reflections, single triangles."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import pieces

_SCRAP_SHARE = 0.02


def without_scraps(mesh: TriangleMesh) -> tuple[TriangleMesh, int]:
    """Remove unconnected pieces below 2 % of the area.

    A surface that consists mostly of such pieces is left unchanged.

    Returns
    -------
    mesh : TriangleMesh
    removed : int
        Number of pieces that were removed.
    """
    count, piece = pieces(mesh)
    area = np.bincount(piece, mesh.vertex_areas, minlength=count)
    scrap = area < _SCRAP_SHARE * area.sum()
    if not scrap.any() or area[scrap].sum() > area.sum() / 2:
        return mesh, 0
    return mesh.part(~scrap[piece]), int(scrap.sum())
