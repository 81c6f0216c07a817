"""The surface on which a sampled field is zero, as a closed triangle mesh.

Marching tetrahedra (Doi & Koide 1991): every grid cell is cut into six tetrahedra that share one
diagonal. Unlike cubes, tetrahedra have no ambiguous case, so the surface is always closed.
"""

from __future__ import annotations

from itertools import permutations

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh, numbered_edges

_SNAP = 0.02
"""Values smaller than this share of a cell are set to it, outside, to avoid sliver triangles."""


def extract_surface(field: FloatArray, origin_mm: FloatArray, cell_mm: float) -> TriangleMesh:
    """Mesh the zero set of a field that is negative inside and positive on the grid's border.

    Parameters
    ----------
    field : (nx, ny, nz) float64, mm
        Roughly the signed distance.
    origin_mm : (3,) float64
        Position of the node (0, 0, 0).
    cell_mm
        Distance of neighbouring nodes.

    Returns
    -------
    TriangleMesh
        Closed, mm; triangles face towards positive values.
    """
    values = np.where(np.abs(field) < _SNAP * cell_mm, _SNAP * cell_mm, field).ravel()
    corners = _tetrahedra((values < 0).reshape(field.shape), field.shape)
    edges = _cut_edges(corners, values)
    pairs, triangles = numbered_edges(edges.reshape(-1, 2), field.size)
    start, end = values[pairs[:, 0]], values[pairs[:, 1]]
    share = (start / (start - end))[:, None]
    nodes = [np.stack(np.unravel_index(pairs[:, i], field.shape), axis=1) for i in range(2)]
    vertices = origin_mm + cell_mm * (nodes[0] * (1 - share) + nodes[1] * share)
    return TriangleMesh(vertices, triangles.reshape(-1, 3).astype(np.int32))


def _tetrahedra(inside: BoolArray, shape: tuple[int, ...]) -> IntArray:
    """Return the nodes (n, 4) of the positively oriented tetrahedra of all cells that are cut."""
    cells = tuple(slice(0, size - 1) for size in shape)
    count = np.zeros(tuple(size - 1 for size in shape), dtype=np.int8)
    for corner in np.ndindex(2, 2, 2):
        count += inside[tuple(slice(o, s - 1 + o) for o, s in zip(corner, shape, strict=True))]
    index = np.arange(inside.size).reshape(shape)[cells][(count > 0) & (count < 8)]
    steps = np.array([shape[1] * shape[2], shape[2], 1])
    parts = []
    for order in permutations(range(3)):
        path = np.cumsum([0, *steps[list(order)]])
        if np.linalg.det(np.eye(3)[list(order)]) < 0:
            path = path[[0, 1, 3, 2]]
        parts.append(index[:, None] + path)
    return np.concatenate(parts)


def _cut_edges(corners: IntArray, values: FloatArray) -> IntArray:
    """Return the cut edges (m, 3, 2), as sorted node pairs, at the corners of every triangle."""
    pattern = (values[corners] < 0) @ np.array([1, 2, 4, 8])
    parts = [np.empty((0, 3, 2), dtype=np.int64)]
    for bits, triangles in _TRIANGLES.items():
        tetrahedra = corners[pattern == bits]
        parts += [np.stack([tetrahedra[:, edge] for edge in edges], axis=1) for edges in triangles]
    return np.sort(np.concatenate(parts), axis=2)


_Edges = tuple[list[int], list[int], list[int]]


def _triangle_table() -> dict[int, list[_Edges]]:
    """Tabulate which edges the triangles join, by the set of inner corners of a tetrahedron."""
    table: dict[int, list[_Edges]] = {}
    for a, b, c, d in ((0, 1, 2, 3), (1, 0, 3, 2), (2, 3, 0, 1), (3, 2, 1, 0)):
        table[1 << a] = [([a, b], [a, c], [a, d])]
        table[15 - (1 << a)] = [([a, b], [a, d], [a, c])]
    for a, b, c, d in (
        (0, 1, 2, 3), (0, 2, 3, 1), (0, 3, 1, 2), (1, 2, 0, 3), (1, 3, 2, 0), (2, 3, 0, 1),
    ):  # fmt: skip
        table[(1 << a) | (1 << b)] = [([a, c], [a, d], [b, d]), ([a, c], [b, d], [b, c])]
    return table


_TRIANGLES = _triangle_table()
