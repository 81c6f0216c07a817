"""Draw single vertices that stick out of a surface, as scanners make them, back to it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh

_ROUNDS = 2
_LEAST_VERTICES = 1000  # with fewer of them a corner of the form itself may look like a spike
_LEAST_SLENDERNESS = 2.2
"""Height of a spike over the radius of its base: no toe is a cone of less than 50
degrees. The radius counts as the usual length of an edge at least."""


def without_spikes(mesh: TriangleMesh) -> tuple[TriangleMesh, int]:
    """Move the tips of spikes to the middle of their neighbours.

    Returns
    -------
    mesh : TriangleMesh
        With the same triangles.
    moved : int
        Number of vertices.
    """
    moved = np.zeros(len(mesh.vertices), dtype=bool)
    if len(moved) < _LEAST_VERTICES:
        return mesh, 0
    for _ in range(_ROUNDS):
        middle, is_spike = _spikes(mesh)
        if not is_spike.any():
            break
        mesh = replace(mesh, vertices=np.where(is_spike[:, None], middle, mesh.vertices))
        moved |= is_spike
    return mesh, int(moved.sum())


def _spikes(mesh: TriangleMesh) -> tuple[FloatArray, BoolArray]:
    """Return the middle (n, 3) of each vertex's neighbours, and whether it is a spike (n,).

    Medians, since among the neighbours there may be other spikes.
    """
    adjacency = mesh.links.adjacency
    starts, neighbour = adjacency.indptr.astype(np.int64), adjacency.indices
    degree = np.diff(starts)
    owner = np.repeat(np.arange(len(degree)), degree)
    around = mesh.vertices[neighbour]
    middle = np.column_stack([_medians(column, owner, starts, degree) for column in around.T])
    radius = _medians(np.linalg.norm(around - middle[owner], axis=1), owner, starts, degree)
    height = np.linalg.norm(mesh.vertices - middle, axis=1)
    typical = _medians(height[neighbour], owner, starts, degree)
    inner = (degree >= 4) & ~mesh.links.is_boundary
    usual = float(np.median(np.linalg.norm(around - mesh.vertices[owner], axis=1)))
    least = np.maximum(_LEAST_SLENDERNESS * np.maximum(radius, usual), 3 * typical)
    is_spike = inner & (height > least)
    return middle, is_spike


def _medians(values: FloatArray, owner: IntArray, starts: IntArray, degree: IntArray) -> FloatArray:
    """Return the lower median (n,) of each owner's values; 0 for one without any."""
    order = np.lexsort((values, owner))
    place = starts[:-1] + np.maximum(degree - 1, 0) // 2
    found = np.zeros(len(degree))
    has = degree > 0
    found[has] = values[order[place[has]]]
    return found
