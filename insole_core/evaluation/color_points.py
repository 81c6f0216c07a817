"""Positions in space of points marked in an image, measured by the depth image."""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import transform
from insole_core.sensing.sensor import Sensor

_NEIGHBOURS = 25
_FAR_PX = 5 / 640
"""Of the image width: a point farther than this from every depth pixel was not measured."""
_SAME_SURFACE_MM = 20.0


def points_at_color(sensor: Sensor, depth_mm: FloatArray, color_px: FloatArray) -> FloatArray:
    """Measure points that are marked in the colour image.

    A plane is fitted to the 25 depth pixels that project nearest to a point in colour, and
    intersected with the point's ray.

    Parameters
    ----------
    depth_mm : (480, 640) float64, mm, NaN = no reading
    color_px : (n, 2) float64, px

    Returns
    -------
    (n, 3) float64, mm, colour camera frame; NaN where the depth has no reading

    Raises
    ------
    InputError
        If the depth image is almost empty.
    """
    space = sensor.points(depth_mm)
    seen = transform(sensor.depth2color, space[np.isfinite(depth_mm)])
    if len(seen) < _NEIGHBOURS:
        raise InputError("The depth image has no readings; capture it again.")
    pixels = sensor.color_camera.project(seen)
    distance, nearest = scipy.spatial.cKDTree(pixels).query(color_px, k=_NEIGHBOURS)
    inverse = _plane_value(pixels[nearest] - color_px[:, None], seen[nearest, 2])
    far = np.asarray(distance)[:, _NEIGHBOURS // 3] > _FAR_PX * sensor.color_camera.width
    inverse[far] = np.nan
    rays = sensor.color_camera.normalised(color_px)
    rows: FloatArray = np.column_stack([rays, np.ones(len(rays))])
    return np.asarray(rows / inverse[:, None])


def points_at_depth(sensor: Sensor, depth_mm: FloatArray, depth_px: FloatArray) -> FloatArray:
    """Measure points that are marked in the depth image.

    Parameters
    ----------
    depth_mm : (480, 640) float64, mm, NaN = no reading
    depth_px : (n, 2) float64, px

    Returns
    -------
    (n, 3) float64, mm, depth camera frame
        At the median depth of 3 x 3 pixels; NaN where they have no reading.

    Raises
    ------
    InputError
        If a point lies at the border of the image or outside it.
    """
    column, row = np.round(depth_px).astype(int).T
    height, width = depth_mm.shape
    if not ((column > 0) & (column < width - 1) & (row > 0) & (row < height - 1)).all():
        raise InputError(
            "A point is marked outside of the depth image of {width}×{height}; correct its pixel.",
            width=width,
            height=height,
        )
    step_v, step_u = (axis.ravel() for axis in np.mgrid[-1:2, -1:2])
    window = depth_mm[row[:, None] + step_v, column[:, None] + step_u]
    depth = np.full(len(window), np.nan)
    known = np.isfinite(window).any(1)
    depth[known] = np.nanmedian(window[known], axis=1)
    rays = sensor.depth_camera.normalised(np.asarray(depth_px, dtype=float))
    rows: FloatArray = np.column_stack([rays, np.ones(len(rays))])
    return np.asarray(rows * depth[:, None])


def _plane_value(offsets: FloatArray, depth_mm: FloatArray) -> FloatArray:
    """Return 1/Z at offset zero, (n,), of a plane in 1/Z through (n, k) neighbours."""
    middle = np.median(depth_mm, axis=1, keepdims=True)
    weight = (np.abs(depth_mm - middle) < _SAME_SURFACE_MM).astype(float)
    rows = np.concatenate([offsets, np.ones((*offsets.shape[:2], 1))], axis=-1)
    normal = np.einsum("nki,nk,nkj->nij", rows, weight, rows) + 1e-9 * np.eye(3)
    right = np.einsum("nki,nk,nk->ni", rows, weight, 1 / depth_mm)
    return np.asarray(np.linalg.solve(normal, right[..., None])[:, 2, 0])
