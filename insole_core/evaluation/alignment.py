"""Alignment of colour and depth (thesis 5.4, table 2), and the pixel shift that corrects it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray
from insole_core.sensing.sensor import Sensor

_SAME_DISTANCE_MM = 50.0


@dataclass(frozen=True)
class Correspondence:
    """One point marked in both images.

    Parameters
    ----------
    depth_px
        (u, v) in the depth image.
    depth_mm
        Depth there.
    color_px
        (u, v) in the colour image.
    """

    depth_px: tuple[float, float]
    depth_mm: float
    color_px: tuple[float, float]


@dataclass(frozen=True)
class Misalignment:
    """Marked minus expected colour pixel at one distance: mean and standard deviation, px."""

    distance_mm: float
    x_px: float
    y_px: float
    sd_x_px: float
    sd_y_px: float
    points: int


def evaluate_alignment(sensor: Sensor, points: Sequence[Correspondence]) -> list[Misalignment]:
    """Measure the misalignment at every distance (table 2).

    Parameters
    ----------
    points
        Those within 50 mm of depth are taken as one distance.

    Returns
    -------
    list of Misalignment
        In order of distance.

    Raises
    ------
    InputError
        If there are no points.
    """
    if not points:
        raise InputError("No point is marked in both images; mark the targets in colour and depth.")
    ordered = sorted(points, key=lambda point: point.depth_mm)
    groups: list[list[Correspondence]] = [[]]
    for point in ordered:
        if groups[-1] and point.depth_mm - groups[-1][0].depth_mm > _SAME_DISTANCE_MM:
            groups.append([])
        groups[-1].append(point)
    return [_misalignment(sensor, group) for group in groups]


def shift_color(sensor: Sensor, points: Sequence[Correspondence]) -> Sensor:
    """Return the sensor with the thesis's constant pixel shift applied to its colour camera.

    Parameters
    ----------
    points
        Their median offset is the shift.

    Raises
    ------
    InputError
        If there are no points.
    """
    if not points:
        raise InputError("No point is marked in both images; mark the targets in colour and depth.")
    x, y = np.median(_offsets(sensor, points), axis=0).tolist()
    camera = sensor.color_camera
    return replace(sensor, color_camera=replace(camera, cx=camera.cx + x, cy=camera.cy + y))


def _misalignment(sensor: Sensor, points: Sequence[Correspondence]) -> Misalignment:
    offsets = _offsets(sensor, points)
    (x, y), (sd_x, sd_y) = offsets.mean(0).tolist(), offsets.std(0).tolist()
    distance = float(np.mean([point.depth_mm for point in points]))
    return Misalignment(distance, x, y, sd_x, sd_y, len(points))


def _offsets(sensor: Sensor, points: Sequence[Correspondence]) -> FloatArray:
    """Return marked minus expected colour pixels (n, 2), thesis (13) - (15)."""
    rays = sensor.depth_camera.normalised(np.array([point.depth_px for point in points]))
    rows = np.column_stack([rays, np.ones(len(rays))])
    space = rows * np.array([[point.depth_mm] for point in points])
    return np.array([point.color_px for point in points]) - sensor.color_pixels(space)
