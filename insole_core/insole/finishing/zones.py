"""Where a finished insole keeps its contact surface or has a floor, and how wide it blends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.finishing.edge_distance import (
    DEPTH_PITCH_MM,
    LEAST_DEPTH_MM,
    EdgeDistance,
    InwardLines,
)
from insole_core.insole.finishing.toe_zone import ToeZone
from insole_core.insole.prescription.finish import HEADS_ALONG, Finish
from insole_core.insole.primitives.height_field import HeightField

# Along a border: the heel's width up to the first of these, the arch's between the two middle ones.
_ZONES_ALONG = (0.18, 0.35, 0.55, HEADS_ALONG)
_OF_ROOM = 0.75
"""Greatest width as a share of the way to the middle: in between, the insole supports."""
STEEPEST_DEG = 60.0
"""Greatest inclination of a wall."""
_STEEPEST = np.tan(np.radians(STEEPEST_DEG - 1.0))  # by the beam's equation
_MOST_BEND = (0.18, 0.235)
"""Greatest curvature at the foot of a wall that turns down to a low rim, and of one that turns up
to a high one, 1/mm, likewise; 0.3 is asked of the Laplacian, and 0.1 of its root mean square."""
_SPREAD_MM, _SIGMA_MM = 6.0, 6.0
_ROUNDING_MM = 1e-6  # a width that equals a depth but for last bits does not depend on them
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
class BlendWidths:
    """Widths of the transition at each point of the edge.

    Parameters
    ----------
    asked_mm : (n,) float64
        By the finish.
    width_mm : (n,) float64
        That are used: wider where a wall would be too steep, narrower where there is no room.
    room_mm : (n,) float64
        Half the local width of the insole.
    is_steep : (n,) bool
        Whether the wall is too steep even at the greatest width.
    """

    asked_mm: FloatArray
    width_mm: FloatArray
    room_mm: FloatArray
    is_steep: BoolArray


def asked_widths(place: EdgeDistance, finish: Finish) -> FloatArray:
    """Return the widths (n,), mm, that a finish asks for at the points of the edge."""
    heel, arch, forefoot = finish.heel_blend_mm, finish.arch_blend_mm, finish.forefoot_blend_mm
    widths = np.interp(place.edge.along, _ZONES_ALONG, (heel, arch, arch, forefoot))
    return np.asarray(
        scipy.ndimage.gaussian_filter1d(widths, _SIGMA_MM / place.edge.step_mm, mode="wrap")
    )


def blend_widths(
    place: EdgeDistance, surface: HeightField, rim_mm: FloatArray, finish: Finish
) -> BlendWidths:
    """Find the widths at which the walls to a rim are neither too steep nor too sharply bent.

    At each point of the edge the wall is a beam along the normal, clamped to the surface at its
    foot and hinged at the rim; the plate is close to it.

    Parameters
    ----------
    surface
        What the plate is pinned to.
    rim_mm : (n,) float64
        Heights of the rim, in the frame of `surface`.
    """
    asked_mm = asked_widths(place, finish)
    lines = place.lines_inward
    most_mm = np.maximum(_OF_ROOM * lines.room_mm, LEAST_DEPTH_MM)
    strain = _strain(lines, surface, rim_mm)
    least_mm = np.minimum(asked_mm, most_mm) - _ROUNDING_MM
    possible = (lines.depth_mm >= least_mm[:, None]) & (
        lines.depth_mm <= most_mm[:, None] + DEPTH_PITCH_MM
    )
    strain = np.where(possible, strain, np.inf)
    sound = strain <= 1
    is_steep = ~np.asarray(sound.any(axis=1))
    chosen = np.where(is_steep, strain.argmin(axis=1), sound.argmax(axis=1))
    needed_mm = np.maximum(lines.depth_mm[chosen], asked_mm)
    step_mm = place.edge.step_mm
    size = 2 * round(_SPREAD_MM / step_mm) + 1
    wide_mm = scipy.ndimage.maximum_filter1d(needed_mm - asked_mm, size, mode="wrap")
    wide_mm = scipy.ndimage.gaussian_filter1d(wide_mm, _SIGMA_MM / step_mm, mode="wrap")
    width_mm = np.minimum(asked_mm + wide_mm, most_mm)
    return BlendWidths(asked_mm, width_mm, lines.room_mm, is_steep)


def _strain(lines: InwardLines, surface: HeightField, rim_mm: FloatArray) -> FloatArray:
    """Return (n, k) the larger of slope and curvature of the walls, 1 where just allowed."""
    heights = surface.height_at(lines.places_mm)
    slope = -np.gradient(heights, lines.depth_mm, axis=1)
    beyond = rim_mm[:, None] - (heights + slope * lines.depth_mm)
    at_rim = np.abs(slope + 1.5 * beyond / lines.depth_mm)
    bend = np.abs(3 * beyond / lines.depth_mm**2) / np.where(beyond < 0, *_MOST_BEND)
    steep = np.maximum(np.abs(slope), at_rim) / _STEEPEST
    return np.asarray(np.nan_to_num(np.maximum(steep, bend), nan=np.inf))


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
