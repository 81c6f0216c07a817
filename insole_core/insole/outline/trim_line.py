"""The front edge of a short shell: a curve through points from the medial to the lateral border."""

from __future__ import annotations

import numpy as np
import scipy

from insole_core.errors import DesignError
from insole_core.foot.landmarks import HEADS, Landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.fields import Place
from insole_core.insole.prescription.shell import Shell

_BEHIND_FIRST_MM, _BEHIND_FIFTH_MM, _MIDDLE_AHEAD_MM = 11.0, 10.0, 4.0
_STEEPEST = 0.7  # slope with which the curve goes on beyond its ends
_SHORTEST = 0.35  # share of the foot's length that a shell keeps at least
_BESIDE_MM = 15.0  # a point may lie this far beside the insole, so that the line reaches its edge


def trim_points(shell: Shell, side: Side, landmarks: Landmarks) -> tuple[Place, ...]:
    """Return the points of a shell's trim line: its own, or the usual ones behind the heads.

    Parameters
    ----------
    landmarks
        Of the foot, insole frame; only read for a shell without points of its own.

    Returns
    -------
    tuple of (x, y), mm, insole frame
        From the medial to the lateral border.
    """
    if shell.trim_mm is not None:
        return shell.trim_mm
    medial, lateral = (landmarks[name].point[:2] for name in (HEADS[0], HEADS[-1]))
    medial, lateral = medial - [0, _BEHIND_FIRST_MM], lateral - [0, _BEHIND_FIFTH_MM]
    middle = (medial + lateral) / 2 + [0, _MIDDLE_AHEAD_MM]
    return tuple((float(x), float(y)) for x, y in (medial, middle, lateral))


class TrimLine:
    """The curve of a trim line, y over x.

    Parameters
    ----------
    points : (n, 2) float64, mm
        In descending x.
    """

    def __init__(self, points: FloatArray) -> None:
        self._points = points[::-1]
        self._spline = scipy.interpolate.CubicSpline(
            self._points[:, 0], self._points[:, 1], bc_type="natural"
        )

    def y_mm(self, x_mm: FloatArray) -> FloatArray:
        """Return the curve's y; beyond its ends it goes straight on."""
        first, last = self._points[0, 0], self._points[-1, 0]
        within = np.clip(x_mm, first, last)
        slope = np.clip(self._spline([first, last], 1), -_STEEPEST, _STEEPEST)
        beyond = np.where(x_mm < first, slope[0], slope[1]) * (x_mm - within)
        return np.asarray(self._spline(within) + beyond)

    def between(self, medial: FloatArray, lateral: FloatArray, count: int) -> FloatArray:
        """Return points (count, 2) of the curve strictly between two others."""
        x = np.linspace(medial[0], lateral[0], count + 2)[1:-1]
        return np.column_stack([x, self.y_mm(x)])

    def ahead_mm(self, curve: FloatArray, length_mm: float) -> FloatArray:
        """Return how far the points (n, 2) of an outline lie ahead of the line.

        Parameters
        ----------
        curve
            Of the whole insole; closed.
        length_mm
            Of the foot.

        Raises
        ------
        DesignError
            If the line does not cut the insole in two parts, one of which is a shell.
        """
        self._require_points_on(curve)
        ahead = curve[:, 1] - self.y_mm(curve[:, 0])
        crossings = int(((ahead < 0) != (np.roll(ahead, -1) < 0)).sum())
        if crossings == 0:
            raise DesignError(
                "The trim line does not cross the insole; move its points onto the insole, behind "
                "the metatarsal heads."
            )
        if crossings > 2:
            raise DesignError(
                "The trim line crosses the edge of the insole {count} times, and must cross it "
                "once on either side; even out its points.",
                count=crossings,
            )
        left_mm = float(curve[ahead < 0, 1].max() - curve[:, 1].min())
        if left_mm < _SHORTEST * length_mm:
            raise DesignError(
                "The trim line leaves only {left_mm:.0f} mm of the insole, and a shell needs "
                "{least_mm:.0f} mm; move it towards the toes.",
                left_mm=left_mm,
                least_mm=_SHORTEST * length_mm,
            )
        return np.asarray(ahead)

    def _require_points_on(self, curve: FloatArray) -> None:
        low, high = curve.min(axis=0) - _BESIDE_MM, curve.max(axis=0) + _BESIDE_MM
        outside = ((self._points < low) | (self._points > high)).any(axis=1)
        if outside.any():
            number = len(outside) - int(np.flatnonzero(outside)[-1])
            raise DesignError(
                "Point {number} of the trim line, counted from the medial side, lies beside the "
                "insole; move it onto the insole.",
                number=number,
            )
