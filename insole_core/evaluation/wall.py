"""Error of a flat wall over distance, before and after correction (thesis 5.2, figure 11)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from insole_core.calibration.walls.captures import WallCapture
from insole_core.calibration.walls.wall_plane import plane_rows
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.sensing.disparity import DisparityModel
from insole_core.sensing.pinhole_camera import PinholeCamera

_FAR_OFF_MM = 30.0
_ROUNDS = 4
_COARSE_STEP = 4
_LEAST_POINTS = 100
_CENTRE = (slice(238, 243), slice(318, 323))


class Correction(Protocol):
    """A correction that converts raw numbers to depths."""

    def depth_mm(self, raw: FloatArray, disparity: DisparityModel) -> FloatArray:
        """Return the corrected depth (480, 640), mm, of a raw image of that shape."""
        ...


@dataclass(frozen=True)
class NoCorrection:
    """The uncorrected sensor."""

    def depth_mm(self, raw: FloatArray, disparity: DisparityModel) -> FloatArray:
        """Return the depth (480, 640), mm, by the disparity model alone."""
        return disparity.depth_mm(raw)


@dataclass(frozen=True)
class WallError:
    """Deviation of one corrected capture of a wall from flat, mm.

    Parameters
    ----------
    distance_mm
        Depth of the fitted plane at the image centre.
    mean_abs_mm
        Thesis (19) over the valid pixels, against the fitted plane.
    mean_abs_raw
        Thesis (18), raw units.
    perpendicular_mean_abs_mm
        Thesis (19) as printed: against the distance at the image centre, which holds for a
        perpendicular wall only.
    pixels
        Number of valid pixels.
    """

    distance_mm: float
    mean_abs_mm: float
    rms_mm: float
    p95_mm: float
    mean_abs_raw: float
    perpendicular_mean_abs_mm: float
    pixels: int


def wall_error(
    capture: WallCapture, correction: Correction, camera: PinholeCamera, disparity: DisparityModel
) -> WallError:
    """Measure a corrected capture against its best-fitting plane.

    Parameters
    ----------
    camera
        The depth camera.
    disparity
        Converts raw numbers to depth.

    Raises
    ------
    CalibrationError
        If too few pixels remain.
    """
    depth = correction.depth_mm(capture.raw, disparity)
    rows = plane_rows(camera)
    plane_depth, valid = _fitted_depth(depth, rows, capture.name)
    error = (depth - plane_depth)[valid]
    raw_error = (disparity.raw(depth) - disparity.raw(plane_depth))[valid]
    centre = np.nanmean(depth[_CENTRE]) if np.isfinite(depth[_CENTRE]).any() else np.nan
    return WallError(
        distance_mm=float(plane_depth[240, 320]),
        mean_abs_mm=float(np.abs(error).mean()),
        rms_mm=float(np.sqrt((error**2).mean())),
        p95_mm=float(np.percentile(np.abs(error), 95)),
        mean_abs_raw=float(np.abs(raw_error).mean()),
        perpendicular_mean_abs_mm=float(np.abs(depth[valid] - centre).mean()),
        pixels=int(valid.sum()),
    )


def wall_deviation_mm(
    capture: WallCapture, correction: Correction, camera: PinholeCamera, disparity: DisparityModel
) -> FloatArray:
    """Compute how far each pixel lies behind the best-fitting plane of a capture (figure 10).

    Parameters
    ----------
    camera
        The depth camera.
    disparity
        Converts raw numbers to depth.

    Returns
    -------
    (480, 640) float64, mm
        NaN off the wall.

    Raises
    ------
    CalibrationError
        If too few pixels remain.
    """
    depth = correction.depth_mm(capture.raw, disparity)
    plane_depth, valid = _fitted_depth(depth, plane_rows(camera), capture.name)
    return np.where(valid, depth - plane_depth, np.nan)


def wall_errors(
    captures: Iterable[WallCapture],
    corrections: Mapping[str, Correction],
    camera: PinholeCamera,
    disparity: DisparityModel,
) -> dict[str, list[WallError]]:
    """Measure every capture with every correction: the curves of figure 11.

    Parameters
    ----------
    corrections
        By name.
    camera
        The depth camera.
    disparity
        Converts raw numbers to depth.

    Returns
    -------
    dict
        The errors in the order of `captures`, by the name of the correction.

    Raises
    ------
    CalibrationError
        If too few pixels of a capture remain.
    """
    listed = list(captures)
    return {
        name: [wall_error(capture, correction, camera, disparity) for capture in listed]
        for name, correction in corrections.items()
    }


def _fitted_depth(depth: FloatArray, rows: FloatArray, name: str) -> tuple[FloatArray, BoolArray]:
    """Return the depth of the total least squares plane at every pixel, and the pixels on it."""
    points = rows * depth[..., None]
    # Every fourth pixel suffices to find those on the wall; the plane is then fitted to all.
    coarse = points[::_COARSE_STEP, ::_COARSE_STEP]
    near = np.isfinite(coarse[..., 2])
    for _ in range(_ROUNDS):
        centre, normal = _plane(coarse[near], name, _LEAST_POINTS // _COARSE_STEP**2)
        near = np.abs((coarse - centre) @ normal) < _FAR_OFF_MM
    centre, normal = _plane(points[np.abs((points - centre) @ normal) < _FAR_OFF_MM], name)
    valid = np.abs((points - centre) @ normal) < _FAR_OFF_MM
    return np.asarray((centre @ normal) / (rows @ normal)), valid


def _plane(
    points: FloatArray, name: str, least: int = _LEAST_POINTS
) -> tuple[FloatArray, FloatArray]:
    """Return centre and normal of the plane through points (n, 3), at least `least` of them."""
    if len(points) < least:
        raise CalibrationError(
            "{name} has no flat surface left to evaluate; capture a flat wall.", name=name
        )
    centre = points.mean(0)
    apart = points - centre
    return centre, np.linalg.eigh(apart.T @ apart)[1][:, 0]
