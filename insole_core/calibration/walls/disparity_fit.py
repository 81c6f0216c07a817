"""Fit of the disparity model to captures at known distances (thesis (9), (12), (17))."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from insole_core.calibration.least_squares import Adjustment, least_squares
from insole_core.calibration.walls.captures import WallCapture
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import FloatArray
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.disparity import (
    DisparityModel,
    LinearInverseDisparity,
    TangentDisparity,
)

_TANGENT_START = (123.6, 2842.5, 1.1863)
"""The commonly used constants of a Kinect v1."""
_ROBUST_RAW = 2.0
_LEAST_DEPTH_RATIO = 1.1
_LEAST_APART_RAW = 2.0
_DEPTH_MM = (300.0, 12000.0)
_CENTRE = (slice(230, 250), slice(310, 330))


@dataclass(frozen=True, eq=False)
class DisparityFit:
    """A fitted disparity model.

    Parameters
    ----------
    deviations
        Standard deviation of each of its numbers, by name.
    rms_raw, rms_mm
        Root mean square of the residuals.
    range_mm
        The distances it was fitted to; beyond them it extrapolates.
    """

    model: DisparityModel
    deviations: dict[str, float]
    rms_raw: float
    rms_mm: float
    range_mm: tuple[float, float]


def fit_linear_inverse(raw: FloatArray, depth_mm: FloatArray) -> DisparityFit:
    """Fit Z = 1000 / (a + b raw), thesis (17), minimising the errors in raw units.

    Parameters
    ----------
    raw : (n,) float64, raw units, corrected for distortion
    depth_mm : (n,) float64, mm along the optical axis

    Raises
    ------
    CalibrationError
        If there are fewer than two clearly different distances, or they are in another unit.
    """
    _check(raw, depth_mm, 2)
    # raw = (1000/Z - a) / b is linear in (1/b, a/b).
    columns = np.stack([1000 / depth_mm, -np.ones_like(depth_mm)], axis=-1)
    (inverse_b, a_by_b), *_ = np.linalg.lstsq(columns, raw, rcond=None)
    start = np.array([a_by_b / inverse_b, 1 / inverse_b])
    solution = least_squares(
        lambda x: raw - LinearInverseDisparity(x[0], x[1]).raw(depth_mm),
        start,
        robust=_ROBUST_RAW,
    )
    a, b = solution.values.tolist()
    return _fit_of(LinearInverseDisparity(a, b), ("a", "b"), solution, raw, depth_mm)


def fit_tangent(raw: FloatArray, depth_mm: FloatArray) -> DisparityFit:
    """Fit Z = k1 tan(raw / k2 + k3), thesis (12), minimising the errors in raw units.

    Parameters
    ----------
    raw : (n,) float64, raw units, corrected for distortion
    depth_mm : (n,) float64, mm along the optical axis

    Raises
    ------
    CalibrationError
        If there are fewer than three clearly different distances, or they are in another unit.
    """
    _check(raw, depth_mm, 3)
    solution = least_squares(
        lambda x: raw - TangentDisparity(x[0], x[1], x[2]).raw(depth_mm),
        np.array(_TANGENT_START),
        robust=_ROBUST_RAW,
    )
    k1, k2, k3 = solution.values.tolist()
    return _fit_of(TangentDisparity(k1, k2, k3), ("k1_mm", "k2", "k3"), solution, raw, depth_mm)


def centre_pairs(
    captures: Sequence[WallCapture], correction: DisparityCorrection | None = None
) -> tuple[FloatArray, FloatArray]:
    """Return the raw number at the image centre and the measured distance of every capture.

    Parameters
    ----------
    captures
        With their distances at the image centre.
    correction
        Of the distortion, where it is known.

    Returns
    -------
    raw, depth_mm : (n,) float64, raw units and mm

    Raises
    ------
    CalibrationError
        If a capture has no distance, or no reading at the centre.
    """
    raw, depth_mm = [], []
    for capture in captures:
        image = correction.corrected(capture.raw) if correction else capture.raw
        centre = image[_CENTRE]
        if capture.distance_mm is None or not np.isfinite(centre).any():
            raise CalibrationError(
                "{capture} needs a reading at the image centre and its measured distance; measure "
                "it, or take the capture out.",
                capture=capture.name,
            )
        raw.append(float(np.nanmedian(centre)))
        depth_mm.append(capture.distance_mm)
    return np.array(raw), np.array(depth_mm)


def linear_inverse_near(model: DisparityModel, raw: FloatArray) -> LinearInverseDisparity:
    """Approximate a disparity model by a linear-inverse one over the given raw numbers.

    For the device's own numbers, thesis (9), the two are identical.

    Parameters
    ----------
    raw : (n,) float64, raw units
        Where the two shall agree.
    """
    inverse = 1000 / model.depth_mm(raw)
    known = np.isfinite(inverse)
    b, a = np.polyfit(raw[known], inverse[known], 1).tolist()
    return LinearInverseDisparity(a, b)


def _fit_of(
    model: DisparityModel,
    names: tuple[str, ...],
    solution: Adjustment,
    raw: FloatArray,
    depth_mm: FloatArray,
) -> DisparityFit:
    left_mm = model.depth_mm(raw) - depth_mm
    return DisparityFit(
        model=model,
        deviations=dict(zip(names, solution.std.tolist(), strict=True)),
        rms_raw=float(np.sqrt((solution.residuals**2).mean())),
        rms_mm=float(np.sqrt(np.nanmean(left_mm**2))),
        range_mm=(float(depth_mm.min()), float(depth_mm.max())),
    )


def _check(raw: FloatArray, depth_mm: FloatArray, least: int) -> None:
    if len(raw) != len(depth_mm) or not (np.isfinite(raw).all() and np.isfinite(depth_mm).all()):
        raise CalibrationError(
            "Every capture needs a raw number and a distance; measure the missing ones."
        )
    low, high = _DEPTH_MM
    if len(depth_mm) and not (low <= depth_mm.min() and depth_mm.max() <= high):
        raise CalibrationError(
            "The distances reach from {nearest_mm:g} to {farthest_mm:g} mm; give them in "
            "millimetres, between {low_mm:g} and {high_mm:g}.",
            nearest_mm=depth_mm.min(),
            farthest_mm=depth_mm.max(),
            low_mm=low,
            high_mm=high,
        )
    if np.ptp(raw) < _LEAST_APART_RAW:
        raise CalibrationError(
            "All captures show a wall at the same distance, though other distances are given; "
            "capture a wall at each of them."
        )
    if _distinct(depth_mm) < least:
        raise CalibrationError(
            "The model needs walls at {count} clearly different distances; capture more, for "
            "example at 600, 800 and 1000 mm.",
            count=least,
        )


def _distinct(depth_mm: FloatArray) -> int:
    """Count distances that differ by at least a tenth from each other."""
    count, last = 0, 0.0
    for depth in np.sort(depth_mm):
        if depth >= last * _LEAST_DEPTH_RATIO:
            count, last = count + 1, float(depth)
    return count
