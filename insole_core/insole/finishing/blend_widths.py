"""How wide the transition from the supporting surface to the rim is, along the edge."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d, maximum_filter1d

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.finishing.edge_distance import EdgeDistance
from insole_core.insole.prescription.finish import HEADS_ALONG, Finish
from insole_core.insole.surface.height_field import HeightField

# Along a border: the heel's width up to the first of these, the arch's between the two middle ones.
_ZONES_ALONG = (0.18, 0.35, 0.55, HEADS_ALONG)
_LEAST_MM, _MOST_MM, _PITCH_MM = 4.0, 46.0, 0.5
_OF_ROOM = 0.75
"""Greatest width as a share of the way to the middle: in between, the insole supports."""
_STEEPEST = np.tan(np.radians(59.0))
"""Of a wall by the beam's equation; 60 degrees are asked of the plate."""
_MOST_BEND = 0.22
"""Greatest curvature of a wall at its foot, 1/mm, likewise; 0.3 is asked of the Laplacian."""
_SPREAD_MM, _SIGMA_MM = 6.0, 6.0
_NEAREST_MM = 1.5  # by which a node may lie nearer to another part of the edge
_OUTSIDE_MM = -10.0


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
    return np.asarray(gaussian_filter1d(widths, _SIGMA_MM / place.edge.step_mm, mode="wrap"))


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
    across = _Across.of(place)
    most_mm = np.maximum(_OF_ROOM * across.room_mm, _LEAST_MM)
    strain = across.strain(surface, rim_mm)
    possible = (across.width_mm >= np.minimum(asked_mm, most_mm)[:, None]) & (
        across.width_mm <= most_mm[:, None] + _PITCH_MM
    )
    strain = np.where(possible, strain, np.inf)
    sound = strain <= 1
    is_steep = ~np.asarray(sound.any(axis=1))
    chosen = np.where(is_steep, strain.argmin(axis=1), sound.argmax(axis=1))
    needed_mm = np.maximum(across.width_mm[chosen], asked_mm)
    step_mm = place.edge.step_mm
    size = 2 * round(_SPREAD_MM / step_mm) + 1
    wide_mm = maximum_filter1d(needed_mm - asked_mm, size, mode="wrap")
    wide_mm = gaussian_filter1d(wide_mm, _SIGMA_MM / step_mm, mode="wrap")
    width_mm = np.minimum(asked_mm + wide_mm, most_mm)
    return BlendWidths(asked_mm, width_mm, across.room_mm, is_steep)


@dataclass(frozen=True, eq=False)
class _Across:
    """Lines from the points of the edge inwards, with a place every 0.5 mm.

    Parameters
    ----------
    width_mm : (k,) float64
        Distances of the places from the edge.
    places_mm : (n, k, 2) float64
    room_mm : (n,) float64
        How far the places are nearest to their own part of the edge.
    """

    width_mm: FloatArray
    places_mm: FloatArray
    room_mm: FloatArray

    @classmethod
    def of(cls, place: EdgeDistance) -> _Across:
        points = place.edge.points_mm
        along = np.roll(points, -2, axis=0) - np.roll(points, 2, axis=0)
        inward = along[:, ::-1] * [-1.0, 1.0] / np.linalg.norm(along, axis=1, keepdims=True)
        inward = inward * place.edge.turn
        width_mm = np.arange(_LEAST_MM, _MOST_MM, _PITCH_MM)
        places = points[:, None] + width_mm[:, None] * inward[:, None]
        inside = place.inside_at(places, _OUTSIDE_MM)
        far = inside < width_mm - _NEAREST_MM
        room_mm = np.where(far.any(axis=1), width_mm[far.argmax(axis=1)], _MOST_MM)
        return cls(width_mm, places, room_mm)

    def strain(self, surface: HeightField, rim_mm: FloatArray) -> FloatArray:
        """Return (n, k) the larger of slope and curvature of the walls, 1 where just allowed."""
        heights = surface.height_at(self.places_mm)
        slope = -np.gradient(heights, self.width_mm, axis=1)
        beyond = rim_mm[:, None] - (heights + slope * self.width_mm)
        at_rim = np.abs(slope + 1.5 * beyond / self.width_mm)
        bend = np.abs(3 * beyond / self.width_mm**2)
        steep = np.maximum(np.abs(slope), at_rim) / _STEEPEST
        return np.asarray(np.nan_to_num(np.maximum(steep, bend / _MOST_BEND), nan=np.inf))
