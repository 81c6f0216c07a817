"""Reduction of triangles within a stated deviation."""

from __future__ import annotations

from dataclasses import dataclass

import manifold3d
import numpy as np

from insole_core.errors import DesignError
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.point_tree import point_tree
from insole_core.geometry.sampling import sample_triangles

_ROUNDS = 7
_FINEST_SHARE = 1 / 64  # of the allowed deviation, where the search starts
_PITCH_MM = 0.5
_NEIGHBOURS = (6, 150)  # among slender triangles the nearest samples are not on the nearest one
_NEAR_MM = 0.01
_AT_ONCE = 200  # points whose distance is found closely, the farthest first


@dataclass(frozen=True, eq=False)
class Simplified:
    """A solid with fewer triangles.

    Parameters
    ----------
    mesh
        Closed, facing outwards.
    deviation_mm
        Greatest measured distance of the original's vertices from it (an upper bound).
    """

    mesh: TriangleMesh
    deviation_mm: float


def simplify(solid: TriangleMesh, most_triangles: int, most_deviation_mm: float) -> Simplified:
    """Collapse edges until the target is met, with the least deviation found.

    Parameters
    ----------
    most_triangles
        A solid with no more is returned unchanged.
    most_deviation_mm
        Greatest allowed distance of the original's vertices from the result.

    Raises
    ------
    DesignError
        If the target cannot be met within the deviation.
    """
    if len(solid.triangles) <= most_triangles:
        return Simplified(solid, 0.0)
    body = to_manifold(solid)
    low, high = most_deviation_mm * _FINEST_SHARE, most_deviation_mm
    fewest = None
    for _ in range(_ROUNDS):
        middle = float(np.sqrt(low * high))
        attempt = body.simplify(middle)
        if attempt.num_tri() <= most_triangles:
            fewest, high = attempt, middle
        else:
            low = middle
    best = from_manifold(body.simplify(high) if fewest is None else fewest)
    deviation = greatest_distance(best, solid.vertices)
    if len(best.triangles) > most_triangles or deviation > most_deviation_mm:
        raise DesignError(
            "{limit} triangles are too few for this solid: {count} deviate by {deviation_mm:.3f} "
            "mm, and {allowed_mm:g} mm are allowed; allow more triangles or more deviation.",
            limit=most_triangles,
            count=len(best.triangles),
            deviation_mm=deviation,
            allowed_mm=most_deviation_mm,
        )
    return Simplified(best, deviation)


def to_manifold(mesh: TriangleMesh) -> manifold3d.Manifold:
    """Convert a closed mesh for the solid modeller.

    Raises
    ------
    DesignError
        If it is not a closed solid.
    """
    triangles = mesh.triangles.astype(np.uint64)
    body = manifold3d.Manifold(manifold3d.Mesh64(np.ascontiguousarray(mesh.vertices), triangles))
    if body.status() != manifold3d.Error.NoError:
        raise DesignError("The mesh is open or crosses itself; only a closed solid can be worked.")
    return body


def from_manifold(body: manifold3d.Manifold) -> TriangleMesh:
    """Convert a solid of the solid modeller to a mesh."""
    mesh = body.to_mesh64()
    return TriangleMesh(
        np.asarray(mesh.vert_properties, float)[:, :3].copy(),
        np.asarray(mesh.tri_verts).astype(np.int32),
    )


def greatest_distance(mesh: TriangleMesh, points: FloatArray) -> float:
    """Compute the distance of the farthest of some points from a surface.

    Parameters
    ----------
    points : (n, 3) float64, mm, frame of `mesh`

    Returns
    -------
    float, mm
        Never smaller than the true distance.
    """
    places, triangle = _covering(mesh)
    tree = point_tree(places)

    def to_nearest(which: IntArray, neighbours: int) -> FloatArray:
        at = points[which]
        nearest = triangle[tree.query(at, k=neighbours)[1]].T
        found = (_to_triangles(at, mesh.vertices[mesh.triangles[each]]) for each in nearest)
        return np.asarray(np.minimum.reduce(list(found)))

    few, many = _NEIGHBOURS
    most = to_nearest(np.arange(len(points)), few)  # what it is at most
    greatest = 0.0
    # Of a point that is at most as far as another one is, it need not be known more closely.
    for which in np.array_split(np.argsort(-most), np.ceil(len(points) / _AT_ONCE)):
        if most[which[0]] <= max(greatest, _NEAR_MM):
            return max(greatest, float(most[which[0]]))
        closer = np.minimum(most[which], to_nearest(which, many))
        greatest = max(greatest, float(closer.max()))
    return greatest


def _covering(mesh: TriangleMesh) -> tuple[FloatArray, IntArray]:
    """Return points (n, 3) that cover a mesh without gaps, and the triangle (n,) of each.

    The samples of slender triangles do not reach into their tips; their edges do.
    """
    inner = sample_triangles(mesh, _PITCH_MM)
    start = mesh.vertices[mesh.triangles].reshape(-1, 3)
    end = mesh.vertices[np.roll(mesh.triangles, -1, axis=1)].reshape(-1, 3)
    count = np.ceil(np.linalg.norm(end - start, axis=1) / _PITCH_MM).astype(np.int64) + 1
    edge = np.repeat(np.arange(len(count)), count)
    number = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    share = (number / count[edge])[:, None]
    places = start[edge] + share * (end - start)[edge]
    return np.concatenate([inner.points, places]), np.concatenate([inner.triangle, edge // 3])


def _to_triangles(points: FloatArray, corners: FloatArray) -> FloatArray:
    """Return the distance (n,) of each point from its triangle (n, 3, 3)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    ab, ac, ap = b - a, c - a, points - a
    normal = np.cross(ab, ac)
    size2 = np.maximum((normal**2).sum(axis=1), 1e-30)
    v = (np.cross(ap, ac) * normal).sum(axis=1) / size2
    w = (np.cross(ab, ap) * normal).sum(axis=1) / size2
    inside = (v >= 0) & (w >= 0) & (v + w <= 1)
    plane = np.abs((ap * normal).sum(axis=1)) / np.sqrt(size2)
    edges = [_to_segments(points, *ends) for ends in ((a, b), (b, c), (c, a))]
    return np.asarray(np.where(inside, plane, np.minimum.reduce(edges)))


def _to_segments(points: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    along = end - start
    share = ((points - start) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-30)
    nearest = start + np.clip(share, 0, 1)[:, None] * along
    return np.asarray(np.linalg.norm(points - nearest, axis=1))
