"""Where a finished insole keeps its contact surface, and where it has the floor of the toe zone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.finishing.blend_widths import BlendWidths
from insole_core.insole.finishing.edge_distance import EdgeDistance
from insole_core.insole.finishing.toe_zone import ToeZone
from insole_core.insole.primitives.height_field import HeightField

_SUPPORT_CORNER_MM, _FLOOR_CORNER_MM = 10.0, 20.0
"""Radii of the corners between rim and toe line. Beside a sharper corner of the level floor the
border behind it, which the foot's flank raises, would end in a knob."""
_CREASE_PER_MM = 0.2
"""Least Laplacian of a contact surface, 1/mm, at which its zone does not end."""
_BESIDE_CREASE_MM, _PASSES = 3.0, 2
_COLLAR_MM, _COLLAR_STIFFNESS = 3.0, 1.0
"""Around the zones, the plate lies on springs whose stiffness falls to zero over this width, as the
square, from this value, 1/mm⁴: so it leaves the contact surface without a crease."""


@dataclass(frozen=True, eq=False)
class Zones:
    """How far nodes lie within the zones that are given, mm; negative outside.

    Parameters
    ----------
    support_mm : (ny, nx) float64
        Within the supporting zone, where the contact surface stays.
    floor_mm : (ny, nx) float64
        Within the floor of the toe zone.
    """

    support_mm: FloatArray
    floor_mm: FloatArray

    @property
    def support(self) -> BoolArray:
        """(ny, nx) nodes of the supporting zone."""
        return np.asarray(self.support_mm > 0)

    @property
    def floor(self) -> BoolArray:
        """(ny, nx) nodes of the toe zone's floor."""
        return np.asarray(self.floor_mm > 0)

    def stiffness(self) -> FloatArray:
        """Return the stiffness (ny, nx), 1/mm⁴, of the plate's springs; inf in the zones."""
        within_mm = np.maximum(self.support_mm, self.floor_mm)
        collar = _COLLAR_STIFFNESS * np.clip(1 + within_mm / _COLLAR_MM, 0, 1) ** 2
        return np.asarray(np.where(within_mm > 0, np.inf, collar))


def zones_of(
    place: EdgeDistance, widths: BlendWidths, toes: ToeZone, contact: HeightField
) -> Zones:
    """Return the zones within the rim's transition, behind the toe line and ahead of it.

    Corners are rounded, and the supporting zone does not end in a fold of the scan: it yields by
    up to 3 mm.
    """
    from_rim_mm = place.inside_mm - place.at_edge(widths.width_mm)
    support_mm = _within_both(from_rim_mm, toes.begin_mm - toes.ahead_mm, _SUPPORT_CORNER_MM)
    floor_mm = _within_both(from_rim_mm, toes.ahead_mm - toes.end_mm, _FLOOR_CORNER_MM)
    return Zones(_beside_creases(support_mm, contact), floor_mm)


def _within_both(first_mm: FloatArray, second_mm: FloatArray, corner_mm: float) -> FloatArray:
    """Return how far nodes lie within two zones, whose corners are rounded by a circle."""
    missing = [np.clip(corner_mm - mm, 0, 1e3) for mm in (first_mm, second_mm)]
    return np.asarray(corner_mm - np.hypot(*missing))


def _beside_creases(within_mm: FloatArray, contact: HeightField) -> FloatArray:
    """Return a zone whose border keeps 3 mm away from creases of the surface."""
    creased = np.abs(contact.laplacian()) > _CREASE_PER_MM
    for _ in range(_PASSES):
        at_border = creased & (np.abs(within_mm) < _BESIDE_CREASE_MM)
        if not at_border.any():
            break
        away_mm = scipy.ndimage.distance_transform_edt(~at_border, sampling=contact.step_mm)
        within_mm = np.minimum(within_mm, away_mm - _BESIDE_CREASE_MM)
    return within_mm
