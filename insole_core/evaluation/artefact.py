"""Acceptance with an artefact in the manner of VDI/VDE 2634: spheres and a plate in captures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.calibration.walls.captures import WallCapture
from insole_core.calibration.walls.wall_plane import fit_wall, plane_rows
from insole_core.errors import InputError
from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray
from insole_core.sensing.sensor import Sensor

_DROPPED = 0.003
"""Share of the points that the guideline allows to discard."""
_ROUNDS = 30
_LEAST_POINTS = 50
_JUMP_MM = 6.0
"""Neighbouring pixels that differ by more are on different surfaces."""
_SIZE_SHARE = 0.25
"""Permitted relative difference of a fitted sphere from the true diameter."""
_DISC_SHARE = (0.2, 1.3)
"""Permitted area of a region, relative to the disc of the sphere in the image."""
_RIM_PX = 5


@dataclass(frozen=True, eq=False)
class SphereFit:
    """A sphere of free radius fitted to measured points, mm.

    Parameters
    ----------
    center_mm : (3,) float64, frame of the points
    form_mm
        Probing error, form: range of the radial residuals without three per mille of them.
    form_95_mm
        The range that holds 95 % of them.
    """

    center_mm: FloatArray
    radius_mm: float
    form_mm: float
    form_95_mm: float

    def size_error_mm(self, true_diameter_mm: float) -> float:
        """Return the probing error, size: measured minus true diameter."""
        return 2 * self.radius_mm - true_diameter_mm


@dataclass(frozen=True)
class PlaneFit:
    """Flatness: range of the distances from the best-fitting plane, mm."""

    form_mm: float
    form_95_mm: float
    rms_mm: float


@dataclass(frozen=True)
class ArtefactEvaluation:
    """The worst values over all positions, mm."""

    probing_form_mm: float
    probing_form_95_mm: float
    probing_size_mm: float
    spacing_mm: float
    flatness_mm: float
    flatness_95_mm: float


def fit_sphere(points: FloatArray) -> SphereFit:
    """Fit centre and radius by least squares of the radial residuals.

    Parameters
    ----------
    points : (n, 3) float64, mm

    Raises
    ------
    InputError
        If there are fewer than 50 points, or they lie on no sphere.
    """
    _check(points, "sphere")
    # Start from the algebraic sphere, which is linear in the centre and r² - |c|².
    columns = np.column_stack([2 * points, np.ones(len(points))])
    solved = np.linalg.lstsq(columns, (points**2).sum(1), rcond=None)[0]
    center, radius = solved[:3], np.sqrt(max(solved[3] + solved[:3] @ solved[:3], 1e-12))
    for _ in range(_ROUNDS):
        away = points - center
        distance = np.linalg.norm(away, axis=1)
        jacobian = np.column_stack([-away / distance[:, None], -np.ones(len(points))])
        step = np.linalg.lstsq(jacobian, radius - distance, rcond=None)[0]
        center, radius = center + step[:3], radius + step[3]
    off = np.linalg.norm(points - center, axis=1) - radius
    if not (np.isfinite(radius) and radius < 1e4):
        raise InputError("The points of a sphere lie on no sphere; select the sphere alone.")
    return SphereFit(center, float(radius), _range(off, _DROPPED), _range(off, 0.05))


def fit_plane(points: FloatArray) -> PlaneFit:
    """Fit a plane by total least squares to points (n, 3), mm.

    Raises
    ------
    InputError
        If there are fewer than 50 points.
    """
    _check(points, "plane")
    centred = points - points.mean(0)
    off = centred @ np.linalg.eigh(centred.T @ centred)[1][:, 0]
    return PlaneFit(_range(off, _DROPPED), _range(off, 0.05), float(np.sqrt((off**2).mean())))


def evaluate_artefact(
    sphere_pairs: Sequence[tuple[FloatArray, FloatArray]],
    planes: Sequence[FloatArray],
    true_diameter_mm: float,
    true_spacing_mm: float,
) -> ArtefactEvaluation:
    """Evaluate a two-sphere bar at several positions and a plate at several positions.

    Parameters
    ----------
    sphere_pairs
        For each position of the bar the points (n, 3), mm, of its two spheres.
    planes
        For each position of the plate its points (n, 3), mm.
    true_diameter_mm, true_spacing_mm
        Calibrated values of the bar.

    Raises
    ------
    InputError
        If there is no position of the bar or of the plate.
    """
    if not sphere_pairs or not planes:
        raise InputError("Measure the bar and the plate at one position at least.")
    pairs = [(fit_sphere(a), fit_sphere(b)) for a, b in sphere_pairs]
    spheres = [sphere for pair in pairs for sphere in pair]
    plates = [fit_plane(points) for points in planes]
    spacings = [
        float(np.linalg.norm(a.center_mm - b.center_mm)) - true_spacing_mm for a, b in pairs
    ]
    return ArtefactEvaluation(
        probing_form_mm=max(sphere.form_mm for sphere in spheres),
        probing_form_95_mm=max(sphere.form_95_mm for sphere in spheres),
        probing_size_mm=max((s.size_error_mm(true_diameter_mm) for s in spheres), key=abs),
        spacing_mm=max(spacings, key=abs),
        flatness_mm=max(plate.form_mm for plate in plates),
        flatness_95_mm=max(plate.form_95_mm for plate in plates),
    )


def _range(values: FloatArray, dropped: float) -> float:
    low, high = np.quantile(values, [dropped / 2, 1 - dropped / 2])
    return float(high - low)


def _check(points: FloatArray, what: str) -> None:
    if len(points) < _LEAST_POINTS or not np.isfinite(points).all():
        raise InputError(
            "A {part} has only {count} usable points, but {least} are needed; move the sensor "
            "nearer and measure again.",
            part=what,
            count=len(points),
            least=_LEAST_POINTS,
        )


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
