"""Positions of blobs in space: direction from the colour image, distance from the depth image."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.geometry.arrays import FloatArray, LabelArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.reconstruct.markers.blobs import Blobs
from insole_core.sensing.sensor import Sensor

_RIM_SHARE = 3 / 1280
"""Width of a blob's rim as a share of the image width."""
_NEAR_MM = 4.0
_PLACE_SHARE = 6 / 1280
"""Radius of the readings used around a pixel, as a share of the image width."""
_DISTANCES_MM = (400.0, 2000.0)
_AROUND_PX = 10


@dataclass(frozen=True)
class SizeLimits:
    """How large a marker can be, and how many depth readings it needs."""

    smallest_mm: float = 6.0
    largest_mm: float = 40.0
    least_depth_pixels: int = 5


@dataclass(frozen=True, eq=False)
class Detections:
    """Marker candidates of one view with their positions in space.

    Parameters
    ----------
    pixels : (n, 2) float64, px, colour image
    points : (n, 3) float64, mm, depth camera frame
    spreads : (n, 2, 2) float64, px², optional
        Covariance of the pixels of each.
    fills : (n,) float64, optional
        How square each is (see `Blobs`).
    placed
        Number of detections, the last ones, that are not blobs but were pointed at by the user:
        their `spreads` and `fills` are NaN, and their `points` where there is no depth reading.
    """

    pixels: FloatArray
    points: FloatArray
    spreads: FloatArray | None = None
    fills: FloatArray | None = None
    placed: int = 0

    def __len__(self) -> int:
        return len(self.points)

    def with_places(self, pixels: FloatArray, points: FloatArray) -> Detections:
        """Append positions that the user pointed at.

        Parameters
        ----------
        pixels : (k, 2) float64, px, colour image
        points : (k, 3) float64, mm, depth camera frame, NaN = unknown

        Returns
        -------
        Detections
            With k more `placed` ones at the end.
        """
        more = len(pixels)
        return Detections(
            np.concatenate([self.pixels, pixels]),
            np.concatenate([self.points, points]),
            _extended(self.spreads, more),
            _extended(self.fills, more),
            self.placed + more,
        )


def locate_blobs(
    blobs: Blobs,
    points: FloatArray,
    sensor: Sensor,
    limits: SizeLimits = SizeLimits(),
) -> Detections:
    """Locate blobs in space: the direction from the colour image, the distance from the depth.

    The rim of every blob is left out, because depth there blends with what lies behind; the
    distance of the rest is taken along the ray through its centroid (thesis 6.2.2, with the
    inverse of (13) - (15)). The distance is the mean of the readings near the median: the median
    alone has the sensor's steps of 2 mm.

    Parameters
    ----------
    blobs
        In the colour image.
    points : (height, width, 3) float64, mm, depth camera frame, NaN = no reading
    sensor
    limits

    Returns
    -------
    Detections
        Those blobs that have enough readings and the size of a marker, in the order of `blobs`.
    """
    color_points = transform(sensor.depth2color, points[np.isfinite(points[..., 2])])
    blob = _blob_below(sensor.color_camera.project(color_points), _without_rim(blobs.labels))
    distance, support = _robust_means(color_points[blob >= 0, 2], blob[blob >= 0], len(blobs))
    size_mm = np.sqrt(blobs.areas) * distance / sensor.color_camera.fx
    good = (support >= limits.least_depth_pixels) & (size_mm >= limits.smallest_mm)
    good &= size_mm <= limits.largest_mm
    pixels = blobs.centroids[good]
    rays = sensor.color_camera.normalised(pixels)
    in_color = np.column_stack([rays, np.ones(len(rays))]) * distance[good, None]
    spreads, fills = (None if x is None else x[good] for x in (blobs.spreads, blobs.fills))
    return Detections(pixels, transform(inverse(sensor.depth2color), in_color), spreads, fills)


def locate_places(pixels: FloatArray, points: FloatArray, sensor: Sensor) -> FloatArray:
    """Locate positions that the user pointed at by the depth readings around them.

    Parameters
    ----------
    pixels : (n, 2) float64, px, colour image
    points : (height, width, 3) float64, mm, depth camera frame, NaN = no reading
    sensor

    Returns
    -------
    (n, 3) float64, mm, depth camera frame; NaN where there is no reading
    """
    return np.array([_point_below(pixel, points, sensor) for pixel in pixels]).reshape(-1, 3)


def _point_below(pixel: FloatArray, points: FloatArray, sensor: Sensor) -> FloatArray:
    camera, color2depth = sensor.color_camera, inverse(sensor.depth2color)
    ray = np.append(camera.normalised(pixel[None])[0], 1.0)
    # Only the part of the depth image that the ray can cross is searched.
    ends = sensor.depth_camera.project(
        transform(color2depth, ray * np.array(_DISTANCES_MM)[:, None])
    )
    low = np.maximum(np.floor(ends.min(0)).astype(int) - _AROUND_PX, 0)
    high = np.maximum(np.ceil(ends.max(0)).astype(int) + _AROUND_PX, 0)
    patch = points[low[1] : high[1], low[0] : high[0]].reshape(-1, 3)
    in_color = transform(sensor.depth2color, patch[np.isfinite(patch[:, 2])])
    apart = np.linalg.norm(camera.project(in_color) - pixel, axis=1)
    distances = in_color[apart < _PLACE_SHARE * camera.width, 2]
    if len(distances) == 0:
        return np.full(3, np.nan)
    return transform(color2depth, ray * float(np.median(distances)))


def _extended(values: FloatArray | None, more: int) -> FloatArray | None:
    """Append `more` unknown (NaN) values."""
    if values is None:
        return None
    return np.concatenate([values, np.full((more, *values.shape[1:]), np.nan)])


def _without_rim(labels: LabelArray) -> LabelArray:
    steps = max(1, round(_RIM_SHARE * labels.shape[1]))
    inside = cv2.erode((labels >= 0).astype(np.uint8), np.ones((3, 3), np.uint8), iterations=steps)
    return np.where(inside > 0, labels, -1)


def _blob_below(pixels: FloatArray, labels: LabelArray) -> LabelArray:
    """Return the blob at every pixel position (n, 2), -1 for none or outside."""
    height, width = labels.shape
    u, v = np.rint(pixels).astype(np.int64).T
    inside = (u >= 0) & (u < width) & (v >= 0) & (v < height)
    return np.where(inside, labels[np.clip(v, 0, height - 1), np.clip(u, 0, width - 1)], -1)


def _robust_means(
    values: FloatArray, group: LabelArray, count: int
) -> tuple[FloatArray, np.ndarray[tuple[int], np.dtype[np.intp]]]:
    """Return the mean of the values near every group's median, NaN if empty, and their number."""
    order = np.lexsort((values, group))
    size = np.bincount(group, minlength=count)
    middle = np.cumsum(size) - size + size // 2
    median = np.append(values[order], np.nan)[np.where(size > 0, middle, -1)]
    near = np.abs(values - median[group]) <= _NEAR_MM
    total = np.bincount(group[near], values[near], minlength=count)
    support = np.bincount(group[near], minlength=count)
    return np.divide(total, support, out=np.full(count, np.nan), where=support > 0), support
