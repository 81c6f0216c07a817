"""Draw single vertices that stick out of a surface, as scanners make them, back to it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh

_ROUNDS = 2
_LEAST_DEGREE = 4
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
    """Return the middle (n, 3) of the neighbours of each spike, and whether it is one (n,).

    Medians, since among the neighbours there may be other spikes. They are only computed where the
    mean of the neighbours is far off, which on most surfaces is nowhere.
    """
    links, vertices = mesh.links, mesh.vertices
    starts, ends = links.edges[0].T
    usual = float(np.median(np.linalg.norm(vertices[starts] - vertices[ends], axis=1)))
    off = np.linalg.norm(links.mean @ vertices - vertices, axis=1)
    middle, is_spike = vertices.copy(), np.zeros(len(vertices), dtype=bool)
    suspects = np.flatnonzero((off > usual) & ~links.is_boundary)
    if len(suspects) == 0:
        return middle, is_spike
    involved = np.unique(np.concatenate([suspects, links.adjacency[suspects].indices]))
    rows = links.adjacency[involved]
    degree = np.diff(rows.indptr)
    owner = np.repeat(np.arange(len(involved)), degree)
    around = vertices[rows.indices]
    middle[involved] = np.column_stack([_medians(column, owner, degree) for column in around.T])
    radius = np.zeros(len(vertices))
    from_middle = np.linalg.norm(around - middle[involved][owner], axis=1)
    radius[involved] = _medians(from_middle, owner, degree)
    height = np.linalg.norm(vertices - middle, axis=1)
    typical = np.zeros(len(vertices))
    typical[involved] = _medians(height[rows.indices], owner, degree)
    least = np.maximum(_LEAST_SLENDERNESS * np.maximum(radius, usual), 3 * typical)
    found = suspects[(height > least)[suspects]]
    found = found[degree[np.searchsorted(involved, found)] >= _LEAST_DEGREE]
    is_spike[found] = True
    return middle, is_spike


def _medians(values: FloatArray, owner: IntArray, degree: IntArray) -> FloatArray:
    """Return the lower median (n,) of each owner's values; each has at least one."""
    order = np.lexsort((values, owner))
    firsts = np.cumsum(degree) - degree
    return np.asarray(values[order[firsts + (degree - 1) // 2]])
