"""How far the correction of the sensor's matching moved the surface, and where."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.prepared_view import PreparedView
from insole_core.reconstruct.parallel import for_views


def corrections_mm(mesh: TriangleMesh, views: list[PreparedView]) -> FloatArray | None:
    """Compute how far the readings at every vertex were moved along the surface's normal.

    Parameters
    ----------
    mesh : mm, reference frame
    views
        At least one.

    Returns
    -------
    (n,) float64, mm
        Outwards positive; the mean of the views, weighted as they face the vertex. NaN where no
        view has a reading. None when no view was corrected.
    """
    corrected = [(view.reading, view.within.raw) for view in views if view.within is not None]
    if not corrected:
        return None
    found = for_views(lambda one: _in_view(mesh, *one), corrected)
    moved, weights = zip(*found, strict=True)
    total, weight = np.sum(moved, axis=0), np.sum(weights, axis=0)
    return np.asarray(np.where(weight > 0, total / np.where(weight > 0, weight, 1), np.nan))


def _in_view(
    mesh: TriangleMesh, reading: DepthView, raw: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the weighted ways (n,), mm, of the readings of a view, and the weights."""
    column, row = np.rint(reading.project(mesh.vertices)).astype(int).T
    height, width = reading.raw.shape
    seen = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    error_raw = np.full(len(seen), np.nan)
    error_raw[seen] = (raw - reading.raw)[row[seen], column[seen]]
    depth_mm = reading.depth_along(mesh.vertices)
    rays = (mesh.vertices - reading.origin_mm) / depth_mm[:, None]
    slope = np.einsum("nc,nc->n", mesh.vertex_normals, rays)
    facing = np.clip(-slope / np.linalg.norm(rays, axis=1), 0, 1) ** 2
    weight = np.where(np.isfinite(error_raw), facing, 0.0)
    way_mm = -np.nan_to_num(error_raw) / reading.raw_per_mm(depth_mm) * slope
    return weight * way_mm, weight
