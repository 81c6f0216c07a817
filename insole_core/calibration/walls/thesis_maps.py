"""The two corrections of the thesis (5.2), kept for comparison with the default."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from insole_core.calibration.walls.wall_plane import WallFit
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.sensing.correction import CorrectionRecord, DisparityCorrection
from insole_core.sensing.disparity import DisparityModel

_DEGREE = 3


def mean_map(walls: Sequence[WallFit]) -> DisparityCorrection:
    """Average measured minus expected raw numbers per pixel: thesis algorithm 1, (16).

    The expected disparity is that of the fitted plane, so that a wall need not be perpendicular.

    Raises
    ------
    CalibrationError
        If there is no capture.
    """
    _check_count(walls, 1)
    total = np.zeros(walls[0].wall.shape)
    count = np.zeros(walls[0].wall.shape)
    for wall in walls:
        total += np.where(wall.wall, wall.residual_raw, 0)
        count += wall.wall
    mean = np.divide(total, count, out=np.zeros_like(total), where=count > 0)
    return DisparityCorrection(
        mean.astype(np.float32),
        coverage=np.minimum(count, 255).astype(np.uint8),
        record=CorrectionRecord(method="thesis algorithm 1"),
    )


@dataclass(frozen=True, eq=False)
class CubicCorrection:
    """A cubic of the depth for every pixel, subtracted from the depth, thesis (20), (21).

    Parameters
    ----------
    coefficients : (4, 480, 640) float64, mm
        Of 1, t, t², t³ with t = (Z - centre_mm) / span_mm.
    covered : (480, 640) bool
        Pixels with enough captures for a cubic; the others are not changed.
    """

    coefficients: FloatArray
    centre_mm: float
    span_mm: float
    covered: BoolArray

    def depth_mm(self, raw: FloatArray, disparity: DisparityModel) -> FloatArray:
        """Convert a raw image to mm, then correct it at each pixel's own depth (21).

        Parameters
        ----------
        raw : (480, 640) float64, raw units

        Returns
        -------
        (480, 640) float64, mm
        """
        depth = disparity.depth_mm(raw)
        # The cubic is not valid outside the distances it was fitted to.
        t = np.clip((depth - self.centre_mm) / self.span_mm, -1, 1)
        error = sum(c * t**power for power, c in enumerate(self.coefficients))
        return np.asarray(depth - error)


def cubic_map(walls: Sequence[WallFit], disparity: DisparityModel) -> CubicCorrection:
    """Fit a cubic to each pixel's errors in mm over the distance: thesis algorithm 2, (20).

    Parameters
    ----------
    walls
        Of one sensor, at four distances or more.

    Raises
    ------
    CalibrationError
        If there are fewer than four captures.
    """
    _check_count(walls, _DEGREE + 1)
    expected = np.stack([disparity.depth_mm(wall.expected_raw) for wall in walls])
    seen = np.stack([wall.wall for wall in walls]) & np.isfinite(expected)
    error = np.where(
        seen, np.stack([disparity.depth_mm(wall.capture.raw) for wall in walls]) - expected, 0
    )
    low, high = expected[seen].min(), expected[seen].max()
    centre, span = (low + high) / 2, max((high - low) / 2, 1.0)
    t = np.where(seen, (expected - centre) / span, 0)
    covered = seen.sum(0) > _DEGREE
    coefficients = _fit_cubics(t, seen, error) * covered
    return CubicCorrection(coefficients, float(centre), float(span), covered)


def _fit_cubics(t: FloatArray, seen: BoolArray, error: FloatArray) -> FloatArray:
    """Solve every pixel's normal equations, (4, height, width)."""
    powers = [seen.astype(float)]
    for _ in range(2 * _DEGREE):
        powers.append(powers[-1] * t)
    moments = [power.sum(0) for power in powers]
    unknowns = range(_DEGREE + 1)
    right = [(powers[i] * error).sum(0) for i in unknowns]
    # Distances that nearly coincide leave a cubic undetermined; the trace keeps it finite.
    normal = [[moments[i + j] + 1e-9 * (i == j) for j in unknowns] for i in unknowns]
    return np.stack(_eliminate(normal, right))


def _eliminate(normal: list[list[FloatArray]], right: list[FloatArray]) -> list[FloatArray]:
    """Solve positive definite systems, given entry by entry for all pixels; overwrites them.

    Many times faster than `np.linalg.solve`, which solves one pixel's system after the other.
    """
    count = len(right)
    for i in range(count):
        for j in range(i + 1, count):
            factor = normal[j][i] / normal[i][i]
            for k in range(i + 1, count):
                normal[j][k] = normal[j][k] - factor * normal[i][k]
            right[j] = right[j] - factor * right[i]
    for i in reversed(range(count)):
        for k in range(i + 1, count):
            right[i] = right[i] - normal[i][k] * right[k]
        right[i] = right[i] / normal[i][i]
    return right


def _check_count(walls: Sequence[WallFit], least: int) -> None:
    if len(walls) < least:
        raise CalibrationError(
            "The correction needs captures of the wall at {least} distances or more, but only "
            "{count} can be used; capture more.",
            least=least,
            count=len(walls),
        )
