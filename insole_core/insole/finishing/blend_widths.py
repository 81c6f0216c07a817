"""How wide the transition from the supporting surface to the rim is, along the edge."""

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
