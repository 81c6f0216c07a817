"""Scraps that float beside a scan: blankets, reflections, single triangles."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from insole_core.geometry.mesh import TriangleMesh

_SCRAP_SHARE = 0.02


def without_scraps(mesh: TriangleMesh) -> tuple[TriangleMesh, int]:
    """Leave out unconnected pieces below 2 % of the area; give the rest and how many went.

    A surface that consists of nothing but such pieces stays as it is.
    """
    count = len(mesh.vertices)
    edges = mesh.triangles[:, [0, 1, 1, 2]].reshape(-1, 2)
    links = coo_array((np.ones(len(edges), bool), (edges[:, 0], edges[:, 1])), (count, count))
    pieces, piece = connected_components(links, directed=False)
    area = np.bincount(piece, mesh.vertex_areas, minlength=pieces)
    scrap = area < _SCRAP_SHARE * area.sum()
    if not scrap.any() or area[scrap].sum() > area.sum() / 2:
        return mesh, 0
    return mesh.part(~scrap[piece]), int(scrap.sum())
