"""The parabola through the metatarsal heads, from which the toe zone is measured."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import HEADS, find_landmarks
from insole_core.geometry.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class HeadsParabola:
    """A parabola y(x) fitted to the five heads of a foot, insole frame, mm.

    Parameters
    ----------
    coefficients : (3,) float64
        Of y over x towards medial, the highest power first, so that a mirrored foot has the same.
    medial_sign
        Sign of the insole frame's x on the medial side.
    """

    coefficients: FloatArray
    medial_sign: float

    @classmethod
    def of(cls, foot: Foot) -> HeadsParabola:
        """Fit the parabola to a foot's landmarks."""
        landmarks, sign = find_landmarks(foot), foot.side.medial_sign
        heads = np.array([landmarks[name].point[:2] for name in HEADS]) * [sign, 1.0]
        return cls(np.polyfit(heads[:, 0], heads[:, 1], 2), sign)

    def ahead_mm(self, x_mm: FloatArray, y_mm: FloatArray) -> FloatArray:
        """Return how far places lie ahead of the parabola, to first order normal to it."""
        y0_mm, steepness = self._at(x_mm)
        return np.asarray((y_mm - y0_mm) / steepness)

    def line_y_mm(self, x_mm: FloatArray, ahead_mm: float) -> FloatArray:
        """Return y of the places that lie a given distance ahead: there `ahead_mm` returns it."""
        y0_mm, steepness = self._at(x_mm)
        return np.asarray(y0_mm + ahead_mm * steepness)

    def _at(self, x_mm: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return y on the parabola, and the length of its tangent for a step of 1 in x."""
        medial_mm = self.medial_sign * x_mm
        slope = np.polyval(np.polyder(self.coefficients), medial_mm)
        y0_mm = np.asarray(np.polyval(self.coefficients, medial_mm), float)
        return y0_mm, np.hypot(1.0, np.asarray(slope, float))
