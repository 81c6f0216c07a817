"""Corrections of the heel: skive, lift and cup depth."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.elements import HeelCup, HeelLift, HeelSkive
from insole_core.insole.primitives.blending import smooth_hinge, smooth_step
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.surface.heel_rim import RimBand

HEEL_SHARE = 0.22
"""Length of the heel as a share of the foot's length."""
_SKIVE_END = 0.32
_WALL_DEG = 80.0  # greatest mean inclination of a rim that is raised beside the scan
_WALL_MM = (2.5, 5.0)  # breadth over which such a rim rises, with little and with ample room
_LAND_MM = 1.0  # of the rim along the edge that has its full height
_ROUNDING_MM = 1.0  # height over which a plane and the surface blend


def skived(
    field: HeightField, measured: BoolArray, skive: HeelSkive, side: Side, length_mm: float
) -> FloatArray:
    """Add a heel skive: a plane that rises to one border of the heel.

    Parameters
    ----------
    measured : (ny, nx) bool
        Nodes where the foot was measured.
    length_mm
        Of the foot.

    Returns
    -------
    (ny, nx) float64, mm
        Heights, at most `skive.depth_mm` above those of `field`.
    """
    rows = _rows(field, _SKIVE_END * length_mm)
    heights = field.heights_mm[rows]
    heel = measured[rows] & (field.y_mm[rows, None] <= HEEL_SHARE * length_mm)
    if not heel.any():
        return field.heights_mm
    outward = side.medial_sign * (1 if skive.border == "medial" else -1)
    plane = np.tan(np.radians(skive.slope_deg)) * outward * field.x_mm
    over = plane - heights
    over = over + (skive.depth_mm - over[heel].max())
    rise = smooth_hinge(over, min(_ROUNDING_MM, skive.depth_mm))
    fade = 1 - smooth_step(field.y_mm[rows] / length_mm, HEEL_SHARE, _SKIVE_END)
    changed = field.heights_mm.copy()
    changed[rows] += np.minimum(rise, skive.depth_mm) * fade[:, None]
    return changed


def lifted(field: HeightField, lift: HeelLift, length_mm: float) -> FloatArray:
    """Raise the heel with a smooth transition to the forefoot.

    Parameters
    ----------
    length_mm
        Of the foot.

    Returns
    -------
    (ny, nx) float64, mm
    """
    fade = 1 - smooth_step(field.y_mm / length_mm, lift.fade_start, lift.fade_end)
    return np.asarray(field.heights_mm + lift.height_mm * fade[:, None])


def cupped(field: HeightField, band: RimBand, cup: HeelCup, length_mm: float) -> FloatArray:
    """Bring the rim of the heel to the cup depth above the heel's lowest point.

    A higher rim is lowered. Where the scan ends lower, a wall rises beside it without a step and
    reaches that height 1 mm before the edge of the insole and 5 mm beside the scan at the latest,
    unless it would be steeper than 80 degrees on average. The measured sole is never raised.

    Parameters
    ----------
    band
        Of the rows up to `cup_rows`.
    length_mm
        Of the foot.

    Returns
    -------
    (ny, nx) float64, mm
    """
    rows = slice(0, cup_rows(field, cup, length_mm))
    limit = heel_floor_mm(field, length_mm) + cup.depth_mm
    fade = (1 - smooth_step(field.y_mm[rows] / length_mm, cup.fade_start, cup.fade_end))[:, None]
    changed = field.heights_mm.copy()
    changed[rows] -= smooth_hinge(field.heights_mm[rows] - limit, _ROUNDING_MM) * fade
    missing = np.maximum(limit - changed[rows], 0.0)
    breadth = np.clip(band.room_mm - _LAND_MM, *_WALL_MM)
    breadth = np.maximum(breadth, missing / np.tan(np.radians(_WALL_DEG)))
    changed[rows] += missing * smooth_step(band.beside_mm / breadth, 0.0, 1.0) * fade
    return changed


def cup_rows(field: HeightField, cup: HeelCup, length_mm: float) -> int:
    """Return how many rows, counted from the heel, a cup may change."""
    return _row_count(field, cup.fade_end * length_mm)


def heel_floor_mm(field: HeightField, length_mm: float) -> float:
    """Return the lowest height of the heel of a foot of this length."""
    return float(field.heights_mm[_rows(field, HEEL_SHARE * length_mm)].min())


def _rows(field: HeightField, end_mm: float) -> slice:
    return slice(0, _row_count(field, end_mm))


def _row_count(field: HeightField, end_mm: float) -> int:
    return max(1, int(np.searchsorted(field.y_mm, end_mm)))
