"""Foam boxes made of simulated feet, and how near their imprints come to the feet."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial import cKDTree

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sampling import sample_triangles
from insole_core.geometry.sections import level_cut
from insole_core.simulate.foam_box import DOUBLE_MM, FoamBox, press_feet, pressing

_SUPPORTING = -0.8  # z of the normals of a sole that carries


def single_box(foot: TriangleMesh, depth_mm: float = 28.0, **box: float) -> TriangleMesh:
    """Press a foot that stands in the reference frame into a box of its own."""
    return press_feet([pressed(foot, depth_mm)], FoamBox(**box), np.random.default_rng(5))  # type: ignore[arg-type]


def pressed(foot: TriangleMesh, depth_mm: float = 28.0) -> TriangleMesh:
    """Return a foot where it was pressed into a box of its own."""
    return foot.transformed(pressing(depth_mm, (3.0, 0.0), 4.0))


def double_box(feet: Sequence[TriangleMesh], apart_mm: float = 150.0, **box: float) -> TriangleMesh:
    """Press a left and a right foot into one box, turned outwards."""
    placed = [
        foot.transformed(pressing(26.0, (sign * apart_mm / 2, 4.0 * sign), -6.0 * sign))
        for foot, sign in zip(feet, (-1, 1), strict=True)
    ]
    return press_feet(placed, FoamBox(DOUBLE_MM, **box), np.random.default_rng(6))  # type: ignore[arg-type]


def flat_cast(foot: TriangleMesh, height_mm: float) -> TriangleMesh:
    """Cut a foot that stands at z = 0 flat at a height, closed, as a cast poured into foam is."""
    cut = level_cut(foot, height_mm - foot.vertices[:, 2])
    low = TriangleMesh(cut.extended(foot.vertices), cut.triangles)
    ends, middle = low.links.ends, len(low.vertices)
    top = np.stack([ends[:, 1], ends[:, 0], np.full(len(ends), middle)], axis=1)
    centre = low.vertices[np.unique(ends)].mean(axis=0)
    triangles = np.concatenate([low.triangles, top]).astype(np.int32)
    return TriangleMesh(np.vstack([low.vertices, centre]), triangles)


def deviations_mm(sole: TriangleMesh, foot: TriangleMesh) -> FloatArray:
    """Return the distances of the supporting points of a sole, seen from above, from the foot."""
    supporting = sole.vertex_normals[:, 2] < _SUPPORTING
    points = sole.vertices[supporting]
    samples = sample_triangles(foot, 0.7)
    nearest = cKDTree(samples.points).query(points)[1]
    normals = foot.triangle_normals[samples.triangle[nearest]]
    return np.asarray(np.abs(np.einsum("ij,ij->i", points - samples.points[nearest], normals)))
