"""The depth readings of the foot in one view of known pose."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray
from insole_core.geometry.point_tree import point_tree
from insole_core.geometry.transforms import inverse, transform
from insole_core.reconstruct.volume import check_any_inside, is_inside
from insole_core.recording.box import Box
from insole_core.sensing.metric_depth import finer_camera
from insole_core.sensing.sensor import Sensor

_MARGIN_PX = 6
_EDGE_PX = 10
"""Distance of the outermost readings from the edge: the sensor's window and its blind columns."""
_LEAST_CUT_PX = 15
_LEAST_AHEAD_MM = 100.0
_LENS_PX = 16
"""Lens distortion bends the edges of the box outwards by less than this."""


@dataclass(frozen=True, eq=False)
class DepthView:
    """The part of a view's depth image that may show the foot, in disparity.

    Parameters
    ----------
    name
        Of the view.
    sensor
    sensor2reference : (4, 4) float64, mm
        Pose of the depth camera.
    corner : (u, v), px
        Position of ``raw[0, 0]`` in the depth image.
    raw : (height, width) float64, raw units
        Averaged and corrected; NaN where nothing was measured in the volume of interest.
    color : (height, width, 3) uint8, RGB
        The whole image of the sensor's colour camera.
    """

    name: str
    sensor: Sensor
    sensor2reference: FloatArray
    corner: tuple[int, int]
    raw: FloatArray
    color: ByteArray

    @cached_property
    def pixels(self) -> FloatArray:
        """(height, width, 2) positions in the depth image, px."""
        height, width = self.raw.shape
        v, u = np.mgrid[:height, :width].astype(float)
        return np.stack([u + self.corner[0], v + self.corner[1]], axis=-1)

    @cached_property
    def known(self) -> BoolArray:
        """(height, width) pixels with a reading."""
        return np.isfinite(self.raw)

    @cached_property
    def surface_points(self) -> FloatArray:
        """(n, 3) points of all readings, mm, reference frame."""
        return self.points(self.raw)[self.known]

    @cached_property
    def _tree(self) -> scipy.spatial.cKDTree:
        return point_tree(self.surface_points)

    @property
    def cut_edges(self) -> tuple[str, ...]:
        """The edges of the depth image at which the foot is cut off."""
        camera = self.sensor.depth_camera
        v, u = np.nonzero(self.known) + np.array(self.corner)[::-1, None]
        far = {
            "left": u,
            "right": camera.width - 1 - u,
            "upper": v,
            "lower": camera.height - 1 - v,
        }
        return tuple(
            edge for edge, away_px in far.items() if (away_px < _EDGE_PX).sum() >= _LEAST_CUT_PX
        )

    def distance_mm(self, points: FloatArray, farthest_mm: float) -> FloatArray:
        """Compute the distances of points from the nearest reading.

        Parameters
        ----------
        points : (n, 3) float64, mm, reference frame
        farthest_mm

        Returns
        -------
        (n,) float64, mm
            inf beyond `farthest_mm`.
        """
        return np.asarray(self._tree.query(points, distance_upper_bound=farthest_mm)[0])

    @cached_property
    def origin_mm(self) -> FloatArray:
        """(3,) position of the depth camera, reference frame."""
        return np.asarray(self.sensor2reference[:3, 3])

    @cached_property
    def color2reference(self) -> FloatArray:
        """(4, 4) colour camera frame to reference frame, mm."""
        return np.asarray(self.sensor2reference @ inverse(self.sensor.depth2color))

    @cached_property
    def rays(self) -> FloatArray:
        """(height, width, 3) rays through all pixels (see `directions`)."""
        return self.directions(self.pixels)

    def directions(self, pixels: FloatArray) -> FloatArray:
        """Return rays (..., 3) through depth pixels (..., 2), reference frame.

        Their component along the depth axis is 1.
        """
        rotation = self.sensor2reference[:3, :3]
        normalised = self.sensor.depth_camera.normalised(pixels)
        return np.asarray(normalised @ rotation[:, :2].T + rotation[:, 2])

    def points(self, raw: FloatArray) -> FloatArray:
        """Compute the points (height, width, 3), mm, reference frame, of this part's raw values."""
        depth_mm = self.sensor.disparity.depth_mm(raw)
        return self.origin_mm + depth_mm[..., None] * self.rays

    def depth_along(self, points: FloatArray) -> FloatArray:
        """Compute the depths (...,), mm, of points (..., 3), mm, reference frame."""
        return np.asarray((points - self.origin_mm) @ self.sensor2reference[:3, 2])

    def raw_per_mm(self, depth_mm: FloatArray) -> FloatArray:
        """Compute the change of the raw value per mm of depth, at depths of any shape."""
        disparity = self.sensor.disparity
        return np.asarray(disparity.raw(depth_mm + 0.5) - disparity.raw(depth_mm - 0.5))

    def project(self, points: FloatArray) -> FloatArray:
        """Project points (n, 3), reference frame, to pixels (n, 2) of this part of the image."""
        in_sensor = transform(inverse(self.sensor2reference), points)
        return np.asarray(self.sensor.depth_camera.project(in_sensor) - np.array(self.corner))

    def without(self, wrong: BoolArray) -> DepthView:
        """Return the view without the readings chosen by the mask `wrong` (height, width)."""
        return self.with_raw(np.where(wrong, np.nan, self.raw))

    def finer(self, size: int) -> DepthView:
        """Return the view with `size` × `size` pixels of the same disparity for each reading."""
        if size == 1:
            return self
        sensor = replace(self.sensor, depth_camera=finer_camera(self.sensor.depth_camera, size))
        u, v = self.corner
        raw = self.raw.repeat(size, axis=0).repeat(size, axis=1)
        return replace(self, sensor=sensor, corner=(size * u, size * v), raw=raw)

    def with_raw(self, raw: FloatArray) -> DepthView:
        """Return the view with other raw values (height, width)."""
        return replace(self, raw=raw)


def read_volume(
    name: str,
    sensor: Sensor,
    sensor2reference: FloatArray,
    box: Box,
    *,
    raw: FloatArray,
    color: ByteArray,
) -> DepthView:
    """Cut the part inside the volume of interest out of a whole depth image.

    Parameters
    ----------
    name
        Of the view.
    sensor
    sensor2reference : (4, 4) float64, mm
        Pose of the depth camera.
    box
        The volume of interest, reference frame.
    raw : (480, 640) float64, raw units
        Averaged and corrected, NaN = no reading.
    color : (height, width, 3) uint8, RGB
        Image of the sensor's colour camera.

    Returns
    -------
    DepthView

    Raises
    ------
    ReconstructionError
        When there is no reading in the volume.
    """
    rows, columns = _window(box, sensor, sensor2reference)
    corner = (columns.start, rows.start)
    seen = DepthView(name, sensor, sensor2reference, corner, raw[rows, columns], color)
    inside = is_inside(seen.points(seen.raw), box)
    check_any_inside(inside)
    rows, columns = (_extent(np.any(inside, axis=axis)) for axis in (1, 0))
    part = np.where(inside, seen.raw, np.nan)[rows, columns]
    return replace(seen, corner=(corner[0] + columns.start, corner[1] + rows.start), raw=part)


def _window(box: Box, sensor: Sensor, sensor2reference: FloatArray) -> tuple[slice, slice]:
    """Return the rows and columns in which a box is seen; all when it is not in front."""
    camera = sensor.depth_camera
    corners = np.array(list(product(*zip(box.min_mm, box.max_mm, strict=True))))
    in_sensor = transform(inverse(sensor2reference), corners)
    size = np.array([camera.width, camera.height])
    low, high = np.zeros(2, dtype=np.int64), size
    if in_sensor[:, 2].min() > _LEAST_AHEAD_MM:
        pixels = camera.project(in_sensor)
        low = np.clip(np.floor(pixels.min(0)).astype(np.int64) - _LENS_PX, 0, size)
        high = np.clip(np.ceil(pixels.max(0)).astype(np.int64) + _LENS_PX, 0, size)
    return slice(int(low[1]), int(high[1])), slice(int(low[0]), int(high[0]))


def _extent(occupied: BoolArray) -> slice:
    index = np.flatnonzero(occupied)
    return slice(
        max(int(index[0]) - _MARGIN_PX, 0), min(int(index[-1]) + _MARGIN_PX + 1, len(occupied))
    )
