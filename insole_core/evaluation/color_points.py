"""Points of a colour image in space: marked by hand, or the coloured spots of a known object."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from insole_core.errors import CalibrationError, InputError, ReconstructionError
from insole_core.evaluation.alignment import Correspondence
from insole_core.geometry.arrays import ByteArray, FloatArray
from insole_core.geometry.point_tree import point_tree
from insole_core.geometry.transforms import transform
from insole_core.json_object import JsonObject
from insole_core.reconstruct.markers.blobs import find_blobs
from insole_core.reconstruct.markers.detections import locate_blobs
from insole_core.reconstruct.poses.registration import PoseSearch
from insole_core.recording.session import Marker, ReferenceSystem
from insole_core.sensing.sensor import Sensor

_NEIGHBOURS = 25
_FAR_PX = 5 / 640
"""Of the image width: a point farther than this from every depth pixel was not measured."""
_SAME_SURFACE_MM = 20.0
_MOST_PX, _MOST_MM = 1e4, 1e5
"""Far beyond any picture and any room; larger numbers are mistakes, and overflow."""
Paint = Literal["blue", "red", "green"]
_AS_BLUE: dict[Paint, tuple[int, int, int]] = {
    "blue": (0, 1, 2),
    "red": (2, 1, 0),
    "green": (0, 2, 1),
}
"""Order of the picture's channels that makes spots of a paint blue (thesis 24)."""
_FACE = "object"


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
    distance, nearest = point_tree(pixels).query(color_px, k=_NEIGHBOURS)
    inverse = _plane_value(pixels[nearest] - color_px[:, None], seen[nearest, 2])
    far = np.asarray(distance)[:, _NEIGHBOURS // 3] > _FAR_PX * sensor.color_camera.width
    inverse[far] = np.nan
    rays = sensor.color_camera.normalised(color_px)
    rows: FloatArray = np.column_stack([rays, np.ones(len(rays))])
    return np.asarray(rows / inverse[:, None])


def _points_at_depth(sensor: Sensor, depth_mm: FloatArray, depth_px: FloatArray) -> FloatArray:
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


@dataclass(frozen=True, eq=False)
class ObjectPoints:
    """The points of a known object.

    Parameters
    ----------
    true_mm : (n, 3) float64, mm, the object's own axes
    pixels : (n, 2) float64, px, optional
        None for coloured spots, which are detected automatically.
    in_color
        Whether they are marked in the colour image rather than in the depth image.
    """

    names: list[str]
    true_mm: FloatArray
    pixels: FloatArray | None
    in_color: bool

    def measured_mm(self, sensor: Sensor, depth_mm: FloatArray) -> FloatArray:
        """Measure the marked points.

        Parameters
        ----------
        depth_mm : (480, 640) float64, mm, NaN = no reading

        Returns
        -------
        (n, 3) float64, mm, frame of the camera in whose image they are marked; NaN where unseen

        Raises
        ------
        InputError
            If the depth image is almost empty, or a point is outside the image.
        """
        assert self.pixels is not None
        measure = points_at_color if self.in_color else _points_at_depth
        return measure(sensor, depth_mm, self.pixels)


def load_object_points(path: Path) -> ObjectPoints:
    """Read ``{"points": [{"name", "true_mm": [x, y, z], "depth_px" or "color_px": [u, v]}]}``.

    Without pixels the points are coloured spots.

    Raises
    ------
    InputError
        Naming the key of the first violation.
    """
    items = _points(path)
    key = "color_px" if items[0].has("color_px") else "depth_px"
    marked = any(item.has("color_px") or item.has("depth_px") for item in items)
    return ObjectPoints(
        [item.text("name") for item in items],
        np.array([item.triple("true_mm", _MOST_MM) for item in items]),
        np.array([item.pair(key, _MOST_PX) for item in items]) if marked else None,
        key == "color_px",
    )


def load_correspondences(path: Path) -> list[Correspondence]:
    """Read ``{"points": [{"depth_px": [u, v], "depth_mm": z, "color_px": [u, v]}]}``.

    Raises
    ------
    InputError
        Naming the key of the first violation.
    """
    return [
        Correspondence(
            item.pair("depth_px", _MOST_PX),
            item.number("depth_mm", 1, _MOST_MM),
            item.pair("color_px", _MOST_PX),
        )
        for item in _points(path)
    ]


def _points(path: Path) -> list[JsonObject]:
    root = JsonObject.read(path)
    items = root.objects("points")
    if not items:
        raise root.fail("points", "is empty; mark the points in the image")
    return items


def measure_spots(
    sensor: Sensor,
    depth_mm: FloatArray,
    color: ByteArray,
    names: Sequence[str],
    true_mm: FloatArray,
    *,
    paint: Paint = "blue",
) -> FloatArray:
    """Measure the spots of an object in one position.

    The spots may be placed freely, as long as no rotation of the object maps them onto themselves:
    they are identified by their distances.

    Parameters
    ----------
    depth_mm : (480, 640) float64, mm, NaN = no reading
    color : (height, width, 3) uint8, RGB
    names
        Of the n spots.
    true_mm : (n, 3) float64, mm, the object's own axes

    Returns
    -------
    (n, 3) float64, mm, colour camera frame; NaN for a spot that was not seen

    Raises
    ------
    CalibrationError
        If the object is not found; its message is the end of a sentence.
    """
    markers = (Marker(n, _place(p), _FACE) for n, p in zip(names, true_mm, strict=True))
    system = ReferenceSystem("the known object", tuple(markers))
    blobs = find_blobs(np.ascontiguousarray(color[..., _AS_BLUE[paint]]))
    points = sensor.points(depth_mm)
    detections = locate_blobs(blobs, points, sensor)
    try:
        fixes = PoseSearch(system, replace(sensor, faces=(_FACE,))).by_places(detections).fixes
    except ReconstructionError as error:
        raise CalibrationError(
            "the {paint} spots of the object are not found ({reason}); show it whole and well lit, "
            "and check its list of points",
            paint=paint,
            reason=error.message,
        ) from error
    measured = np.full((len(names), 3), np.nan)
    seen = [names.index(fix.id) for fix in fixes if fix.used]
    pixels = np.array([fix.pixel for fix in fixes if fix.used])
    measured[seen] = points_at_color(sensor, depth_mm, pixels)
    return measured


def _place(point: FloatArray) -> tuple[float, float, float]:
    x, y, z = point.tolist()
    return x, y, z
