"""What the rules of the elements look at."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import Landmarks
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.clinic_rules import ClinicRules
from insole_core.insole.fields import Place
from insole_core.insole.primitives.height_field import HeightField

SHOWN = 0.1
"""Step in mm and degrees to which values are rounded, before they are compared and printed."""
SHOWN_SHARE = 0.01


@dataclass(frozen=True, eq=False)
class Judged:
    """An insole as the rules of its elements look at it, and the clinic's limits.

    Parameters
    ----------
    landmarks
        Of the foot, insole frame; those that were set by hand in their places.
    surface
        The finished contact surface; insole frame, mm.
    measured : (ny, nx) bool
        Nodes of the surface where the foot was measured.
    thickness_mm : (ny, nx) float64
        Material below it.
    posted_deg
        By how much all postings and posts turn rearfoot and forefoot; > 0 is medial.
    lifted_mm
        Returns by how much all elements together lift the section at a share of the length.
    cup_mm
        Depth of the heel cup, whatever makes it.
    outline_mm
        Returns the edge of the insole, that of a shell in its full length; (n, 2), insole frame.
    """

    rules: ClinicRules
    foot: Foot
    landmarks: Landmarks
    surface: HeightField
    measured: BoolArray
    thickness_mm: FloatArray
    posted_deg: tuple[float, float]
    lifted_mm: Callable[[float], float]
    cup_mm: float
    outline_mm: Callable[[], FloatArray]

    def place_of(self, values: FloatArray) -> Place:
        """Return the place of the greatest of the values (ny, nx) at the surface's nodes."""
        row, column = np.unravel_index(values.argmax(), values.shape)
        return float(self.surface.x_mm[column]), float(self.surface.y_mm[row])
