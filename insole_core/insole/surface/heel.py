"""Corrections of the heel: skive, lift and the depth of the cup."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import distance_transform_edt

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import HeelCup, HeelLift, HeelSkive
from insole_core.insole.surface.blending import smooth_hinge, smooth_step
from insole_core.insole.surface.height_field import HeightField

HEEL_SHARE = 0.22
"""Share of the foot's length that the heel takes."""
_SKIVE_END = 0.32
_WALL_DEG = 80.0  # of a rim that is raised beside the scan, against the ground
_ROUNDING_MM = 1.0  # over this height a plane and the surface merge


def skived(
    field: HeightField, measured: BoolArray, skive: HeelSkive, side: Side, length_mm: float
) -> FloatArray:
    """Heights (ny, nx) with a plane that rises to one border, `depth_mm` over them at most."""
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
    """Heights (ny, nx) with the heel raised and a smooth way down to the forefoot."""
    fade = 1 - smooth_step(field.y_mm / length_mm, lift.fade_start, lift.fade_end)
    return np.asarray(field.heights_mm + lift.height_mm * fade[:, None])


def cupped(field: HeightField, measured: BoolArray, cup: HeelCup, length_mm: float) -> FloatArray:
    """Heights (ny, nx) with the rim of the heel at the depth over the heel's floor.

    What is higher is taken down. Where the scan ends lower, a wall rises beside it, steep and as
    high as the way to the edge allows; the sole that was measured is never raised.
    """
    rows = _rows(field, cup.fade_end * length_mm)
    limit = heel_floor_mm(field, length_mm) + cup.depth_mm
    fade = (1 - smooth_step(field.y_mm[rows] / length_mm, cup.fade_start, cup.fade_end))[:, None]
    changed = field.heights_mm.copy()
    changed[rows] -= smooth_hinge(field.heights_mm[rows] - limit, _ROUNDING_MM) * fade
    if measured[rows].any():
        beside = distance_transform_edt(~measured[rows], sampling=field.step_mm)
        wall = np.tan(np.radians(_WALL_DEG)) * beside
        changed[rows] += np.clip(limit - changed[rows], 0, wall) * fade
    return changed


def heel_floor_mm(field: HeightField, length_mm: float) -> float:
    """Height of the heel's lowest place."""
    return float(field.heights_mm[_rows(field, HEEL_SHARE * length_mm)].min())


def _rows(field: HeightField, end_mm: float) -> slice:
    return slice(0, max(1, int(np.searchsorted(field.y_mm, end_mm))))
