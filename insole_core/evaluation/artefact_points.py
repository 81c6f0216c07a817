"""Detection of the spheres and the plate of an artefact in captures."""

from __future__ import annotations

import cv2
import numpy as np

from insole_core.calibration.walls.captures import WallCapture
from insole_core.calibration.walls.wall_plane import fit_wall, plane_rows
from insole_core.errors import InputError
from insole_core.evaluation.artefact import fit_sphere
from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray
from insole_core.sensing.sensor import Sensor

_JUMP_MM = 6.0
"""Neighbouring pixels that differ by more are on different surfaces."""
_SIZE_SHARE = 0.25
"""Permitted relative difference of a fitted sphere from the true diameter."""
_DISC_SHARE = (0.2, 1.3)
"""Permitted area of a region, relative to the disc of the sphere in the image."""
_RIM_PX = 5


def sphere_points(
    capture: WallCapture, sensor: Sensor, true_diameter_mm: float
) -> tuple[FloatArray, FloatArray]:
    """Find the points of the two spheres of a bar.

    Parameters
    ----------
    sensor
        Converts and corrects the raw numbers of the capture.

    Returns
    -------
    (n, 3) and (m, 3) float64, mm, depth camera frame
        Left and right, as the sensor sees them.

    Raises
    ------
    InputError
        If not exactly two spheres of about this diameter are seen.
    """
    depth = sensor.depth_mm(capture.raw)
    space = sensor.points(depth)
    found = []
    for region in _smooth_regions(depth):
        points = space[region]
        radius_px = true_diameter_mm / 2 * sensor.depth_camera.fx / np.median(points[:, 2])
        share = len(points) / (np.pi * radius_px**2)
        if not _DISC_SHARE[0] < share < _DISC_SHARE[1]:
            continue
        error = fit_sphere(points).size_error_mm(true_diameter_mm)
        if abs(error) < _SIZE_SHARE * true_diameter_mm:
            found.append(points)
    if len(found) != 2:
        raise InputError(
            "{capture} shows {count} spheres of about {diameter_mm:g} mm, but the bar has 2; keep "
            "the space around them free and check the diameter.",
            capture=capture.name,
            count=len(found),
            diameter_mm=true_diameter_mm,
        )
    a, b = sorted(found, key=lambda points: float(points[:, 0].mean()))
    return a, b


def plate_points(capture: WallCapture, sensor: Sensor) -> FloatArray:
    """Find the points of the plate, without its border.

    Parameters
    ----------
    sensor
        Converts and corrects the raw numbers of the capture.

    Returns
    -------
    (n, 3) float64, mm, depth camera frame

    Raises
    ------
    CalibrationError
        If no plane fills at least 4 % of the image.
    """
    raw = sensor.corrected(capture.raw)
    flat = WallCapture(capture.name, raw)
    wall = fit_wall(flat, plane_rows(sensor.depth_camera), sensor.disparity).wall
    inside = cv2.erode(wall.astype(np.uint8), np.ones((_RIM_PX, _RIM_PX), np.uint8)) > 0
    return np.asarray(sensor.points(sensor.disparity.depth_mm(raw))[inside])


def _smooth_regions(depth: FloatArray) -> list[BoolArray]:
    """Split the image at depth discontinuities."""
    known = np.isfinite(depth)
    filled = np.where(known, depth, 0).astype(np.float32)
    square = np.ones((3, 3), np.uint8)
    step: FloatArray = cv2.dilate(filled, square) - cv2.erode(filled, square)
    smooth: ByteArray = (known & (step < 2 * _JUMP_MM)).astype(np.uint8)
    count, labels, stats, _ = cv2.connectedComponentsWithStats(smooth, connectivity=4)
    large = stats[:, cv2.CC_STAT_AREA] >= 50
    return [labels == label for label in range(1, count) if large[label]]
