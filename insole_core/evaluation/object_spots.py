"""Automatic detection of the coloured spots of a known object (thesis 5.5)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

import numpy as np

from insole_core.errors import CalibrationError, ReconstructionError
from insole_core.evaluation.color_points import points_at_color
from insole_core.geometry.arrays import ByteArray, FloatArray
from insole_core.reconstruct.markers.blobs import find_blobs
from insole_core.reconstruct.markers.detections import locate_blobs
from insole_core.reconstruct.poses.registration import PoseSearch
from insole_core.recording.session import Marker, ReferenceSystem
from insole_core.sensing.sensor import Sensor

Paint = Literal["blue", "red", "green"]

_AS_BLUE: dict[Paint, tuple[int, int, int]] = {
    "blue": (0, 1, 2),
    "red": (2, 1, 0),
    "green": (0, 2, 1),
}
"""Order of the picture's channels that makes spots of a paint blue (thesis 24)."""
_FACE = "object"


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
