"""A view of known pose, corrected and smoothed on its own, and how far the correction moved it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.infrared_evidence import InfraredView
from insole_core.reconstruct.fusion.matching_error import without_matching_error
from insole_core.reconstruct.fusion.occluding_contour import (
    OccludingContour,
    find_occluding_contour,
)
from insole_core.reconstruct.fusion.silhouette import Silhouette, find_silhouette, within_outline
from insole_core.reconstruct.parallel import for_views

_SIGMA_PX = 1.5
_REACH_PX = 3
_JUMP_RAW = 8.0
_LEAST_SUPPORT = 2.5
"""Sum of weights below which a pixel has almost no neighbours; the kernel's full sum is 13.6."""
_UNKNOWN_COSINE = 0.2


@dataclass(frozen=True, eq=False)
class SmoothDepth:
    """The smoothed depth of one view.

    Parameters
    ----------
    depth_mm : (height, width) float64, NaN = no surface
    cosine : (height, width) float64
        Of the angle between ray and surface normal.
    """

    depth_mm: FloatArray
    cosine: FloatArray


def smooth_depth(reading: DepthView) -> SmoothDepth:
    """Smooth a reading by a Gaussian that stops at jumps; pixels without neighbours are dropped."""
    raw, support = _smooth(reading.raw.astype(np.float32))
    raw = np.where(support > _LEAST_SUPPORT, raw, np.nan)
    points = reading.points(raw)
    normals = np.cross(_difference(points, 1), _difference(points, 0))
    rays = points - reading.origin_mm
    lengths = np.linalg.norm(normals, axis=-1) * np.linalg.norm(rays, axis=-1)
    cosine = np.abs(np.einsum("vuc,vuc->vu", normals, rays)) / np.maximum(lengths, 1e-12)
    return SmoothDepth(
        reading.depth_along(points), np.where(np.isfinite(cosine), cosine, _UNKNOWN_COSINE)
    )


def _smooth(raw: Float32Array) -> tuple[FloatArray, Float32Array]:
    height, width = raw.shape
    known = np.isfinite(raw)
    values = np.pad(np.where(known, raw, np.inf), _REACH_PX, constant_values=np.inf)
    total, support = np.zeros_like(raw), np.zeros_like(raw)
    steps = range(2 * _REACH_PX + 1)
    profile = np.exp(-((np.arange(2 * _REACH_PX + 1) - _REACH_PX) ** 2) / (2 * _SIGMA_PX**2))
    center = np.where(known, raw, 0)
    for dv in steps:
        for du in steps:
            difference = values[dv : dv + height, du : du + width] - center
            weight = np.float32(profile[dv] * profile[du])
            near = np.abs(difference) < _JUMP_RAW
            total += np.where(near, weight * difference, 0)
            support += np.where(near, weight, 0)
    smooth = center.astype(float) + total / np.maximum(support, 1e-9)
    return np.where(known, smooth, np.nan), support * known


def _difference(points: FloatArray, axis: int) -> FloatArray:
    """Compute central differences, one-sided beside a gap, NaN without a neighbour."""
    ahead, behind = np.full_like(points, np.nan), np.full_like(points, np.nan)
    low = tuple(slice(None, -1) if i == axis else slice(None) for i in range(3))
    high = tuple(slice(1, None) if i == axis else slice(None) for i in range(3))
    ahead[low] = points[high] - points[low]
    behind[high] = points[high] - points[low]
    central = (ahead + behind) / 2
    return np.where(np.isfinite(central), central, np.where(np.isfinite(ahead), ahead, behind))


@dataclass(frozen=True, eq=False)
class PreparedView:
    """One view, ready to be joined with others.

    Parameters
    ----------
    measured
        The view as it was cut out of the depth image.
    within
        The view without readings outside the foot's silhouette, not corrected; None if the reading
        is not corrected either.
    reading
        The same without the sensor's matching error.
    outline
        None when the foot cannot be distinguished from the background by colour.
    depth
        The smoothed reading.
    rim
        The contour to a fraction of a pixel; None when it is not certain.
    infrared
        The picture of the dots; None where there is none, or it is not used.
    """

    measured: DepthView
    within: DepthView | None
    reading: DepthView
    outline: Silhouette | None
    depth: SmoothDepth
    rim: OccludingContour | None = None
    infrared: InfraredView | None = None


def prepare(reading: DepthView, *, corrected: bool = True) -> PreparedView:
    """Find the outline of the foot in a view; correct and smooth the readings inside.

    Parameters
    ----------
    reading
    corrected
        Whether the sensor's matching error is subtracted, if it was learnt for its family.

    Returns
    -------
    PreparedView
    """
    corrected = corrected and reading.sensor.family.learnt
    outline = find_silhouette(reading)
    within = within_outline(reading, outline)
    right = without_matching_error(within) if corrected else within
    rim = None if outline is None else find_occluding_contour(right, outline)
    # Copies, so that the properties cached so far are not kept in memory.
    given = replace(within) if corrected else None
    return PreparedView(replace(reading), given, right, outline, smooth_depth(right), rim)


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
