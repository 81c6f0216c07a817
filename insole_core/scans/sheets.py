"""Cut off the floor, the table or the sheet of glass on which a foot stands.

A sole that rests on the sheet lies in its plane and is joined to it. What lies in the plane within
the outline of the foot above it is the sole, and what lies outside of that is the sheet.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh

_TRIALS = 60
_ALIGNED = np.cos(np.radians(12.0))
_LEAST_SHARE = 0.12
"""Of all area, that a sheet outside of the foot has at least."""
_FOOT_SHARE = 0.4
"""Of the height over the plane, that counts for the outline of the foot: no leaning leg."""
_CELLS = 150
_MOST_BELOW = 0.05
_LEAST_PIECE = 0.03


@dataclass(frozen=True)
class _Plane:
    normal: FloatArray
    offset: float

    def heights(self, points: FloatArray) -> FloatArray:
        return np.asarray(points @ self.normal - self.offset)


def without_sheet(mesh: TriangleMesh, tolerance: float, least_height: float = 0.0) -> TriangleMesh:
    """Cut off the largest plane, as far as it goes beyond the outline of what stands on it.

    Parameters
    ----------
    tolerance
        Greatest distance of the sheet's points from its plane, in the unit of the mesh.
    least_height
        Of what stands on the sheet.

    Returns
    -------
    TriangleMesh
        The same object if there is no sheet.
    """
    plane = _largest_plane(mesh, tolerance)
    heights = plane.heights(mesh.vertices)
    in_plane = np.abs(heights) <= tolerance
    flat = in_plane[mesh.triangles].all(axis=1)
    above = heights > tolerance
    below = heights < -tolerance
    if above.sum() < below.sum():
        heights, above, below = -heights, below, above
    if not above.any() or below.sum() > _MOST_BELOW * above.sum():
        return mesh  # it goes through the middle: no sheet on which something stands
    if np.quantile(heights[above], 0.98) < least_height:
        return mesh
    sheet = flat & ~_under_foot(mesh, plane, heights, above)
    areas = mesh.triangle_areas_mm2
    if areas[sheet].sum() < _LEAST_SHARE * areas.sum():
        return mesh
    kept = np.zeros(len(mesh.vertices), dtype=bool)
    kept[mesh.triangles[~sheet]] = True
    used = mesh.triangles[~sheet]
    part = TriangleMesh(mesh.vertices, used, mesh.colors, mesh.touches)
    return part.part(kept)


def _largest_plane(mesh: TriangleMesh, tolerance: float) -> _Plane:
    """Find the plane with the largest area of triangles in it, among trials (RANSAC)."""
    areas, normals = mesh.triangle_areas_mm2, mesh.triangle_normals
    centres = mesh.vertices[mesh.triangles].mean(axis=1)
    rng = np.random.default_rng(0)
    chosen = rng.choice(len(areas), min(20_000, len(areas)), p=areas / areas.sum())
    normals, centres = normals[chosen], centres[chosen]
    best, most = _Plane(normals[0], float(centres[0] @ normals[0])), 0
    for trial in rng.choice(len(chosen), _TRIALS):
        normal = normals[trial]
        if not normal.any():
            continue
        offset = float(centres[trial] @ normal)
        members = _members(normals, centres, _Plane(normal, offset), tolerance)
        if members.sum() > most:
            best, most = _refined(normals, centres, members, normal), int(members.sum())
    members = _members(normals, centres, best, tolerance)
    if members.sum() >= 3:
        best = _refined(normals, centres, members, best.normal)
    return best


def _members(
    normals: FloatArray, centres: FloatArray, plane: _Plane, tolerance: float
) -> BoolArray:
    aligned = np.abs(normals @ plane.normal) > _ALIGNED
    return np.asarray(aligned & (np.abs(plane.heights(centres)) <= tolerance))


def _refined(
    normals: FloatArray, centres: FloatArray, members: BoolArray, normal: FloatArray
) -> _Plane:
    """Fit a plane to the members."""
    points = centres[members]
    if len(points) < 3:
        return _Plane(normal, float(points.mean(axis=0) @ normal))
    middle = points.mean(axis=0)
    fitted = np.linalg.eigh((points - middle).T @ (points - middle))[1][:, 0]
    if fitted @ normal < 0:
        fitted = -fitted
    return _Plane(fitted, float(middle @ fitted))


def _under_foot(
    mesh: TriangleMesh, plane: _Plane, heights: FloatArray, above: BoolArray
) -> BoolArray:
    """Return which triangles (m,) lie within the outline of what stands on the plane."""
    top = np.quantile(heights[above], 0.99)
    across = np.linalg.svd(plane.normal[None])[2][1:]
    places = mesh.vertices @ across.T
    low = places.min(axis=0)
    cell = float(np.ptp(places[above], axis=0).max()) / _CELLS
    standing = above & (heights < max(_FOOT_SHARE * top, 0.0))
    shape = np.minimum(np.ceil(np.ptp(places, axis=0) / cell).astype(int) + 5, 40 * _CELLS)
    corners = mesh.triangles[standing[mesh.triangles].any(axis=1)]
    mask = np.zeros(shape, dtype=bool)
    middles = mesh.vertices[corners].mean(axis=1) @ across.T
    for points in (places[standing], middles):
        cells = np.minimum(((points - low) / cell).astype(int) + 2, shape - 1)
        mask[tuple(cells.T)] = True
    mask = scipy.ndimage.binary_closing(mask, np.ones((5, 5), dtype=bool))
    mask = scipy.ndimage.binary_fill_holes(mask)
    pieces, count = scipy.ndimage.label(mask)
    sizes = np.bincount(pieces.ravel(), minlength=count + 1)
    large = sizes >= _LEAST_PIECE * sizes[1:].max(initial=1)
    large[0] = False
    mask = large[pieces]
    centres = mesh.vertices[mesh.triangles].mean(axis=1) @ across.T
    cells = np.minimum(((centres - low) / cell).astype(int) + 2, shape - 1)
    return np.asarray(mask[tuple(cells.T)])
