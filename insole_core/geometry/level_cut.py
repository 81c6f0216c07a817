"""Cut a mesh along a level of a field that is linear in every triangle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import TriangleMesh


@dataclass(frozen=True, eq=False)
class LevelCut:
    """The part of a mesh where a field is not negative.

    Parameters
    ----------
    triangles : (m, 3) int32
        Indices of the mesh's own vertices, continued by those of the cut.
    source : (m,) int64
        Triangle of the mesh that each is part of.
    ends : (k, 2) int64
        Edge of the mesh on which each vertex of the cut lies.
    share : (k,) float64
        Where on the edge, 0 to 1.
    """

    triangles: IndexArray
    source: IntArray
    ends: IntArray
    share: FloatArray

    def extended(self, values: FloatArray) -> FloatArray:
        """Continue values (n, ...) at the mesh's vertices by those at the vertices of the cut."""
        start, end = values[self.ends[:, 0]], values[self.ends[:, 1]]
        share = self.share.reshape(-1, *[1] * (values.ndim - 1))
        return np.concatenate([values, start + share * (end - start)])


def level_cut(mesh: TriangleMesh, field: FloatArray) -> LevelCut:
    """Keep the part of a mesh where a field (n,) is not negative."""
    kept = field >= 0
    count = kept[mesh.triangles].sum(axis=1)
    whole, one, two = (np.flatnonzero(count == number) for number in (3, 1, 2))
    # The corner that is alone on its side comes first: both edges that are cut start there.
    alone = np.concatenate([kept[mesh.triangles[one]], ~kept[mesh.triangles[two]]]).argmax(axis=1)
    cut = mesh.triangles[np.concatenate([one, two])].astype(np.int64)
    corner = cut[np.arange(len(cut))[:, None], (alone[:, None] + np.arange(3)) % 3]
    edges = np.sort(corner[:, [[0, 1], [0, 2]]], axis=-1).reshape(-1, 2)
    ends, number = np.unique(edges, axis=0, return_inverse=True)
    first, second = (number.reshape(-1, 2) + len(mesh.vertices)).T
    tips, bases = slice(0, len(one)), slice(len(one), None)
    triangles = np.concatenate(
        [
            mesh.triangles[whole],
            np.stack([corner[tips, 0], first[tips], second[tips]], axis=1),
            np.stack([first[bases], corner[bases, 1], corner[bases, 2]], axis=1),
            np.stack([first[bases], corner[bases, 2], second[bases]], axis=1),
        ]
    )
    from_start, from_end = field[ends].T
    return LevelCut(
        triangles.astype(np.int32),
        np.concatenate([whole, one, two, two]),
        ends,
        from_start / (from_start - from_end),
    )


def cut_off(mesh: TriangleMesh, field: FloatArray) -> TriangleMesh:
    """Return the part of a mesh where a field (n,) is not negative, cut along its zero level."""
    cut = level_cut(mesh, field)
    vertices = cut.extended(mesh.vertices)
    colors = (
        None if mesh.colors is None else cut.extended(mesh.colors.astype(float)).astype(np.uint8)
    )
    used = np.zeros(len(vertices), dtype=bool)
    used[cut.triangles] = True
    return TriangleMesh(vertices, cut.triangles, colors).part(used)
