"""Find the regions of a relief into which a foot was pressed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.imprints.relief import Relief

_LEVELS_MM = (5.0, 8.0, 11.0, 15.0, 20.0)
"""Depths at which imprints are looked for; deeper ones where two imprints run into each other."""
_DEEPEST_MM = 60.0
_RIM_MM = (-4.0, 12.0)
"""Heights of undisturbed foam, and of the carton around it."""
_LENGTH_MM, _WIDTH_TO_LENGTH = (100.0, 340.0), (0.2, 0.62)
_PART_MM2 = 60.0
_GAP_MM = 30.0  # between the parts of one imprint, such as the toes and the ball
_RING_MM, _SURROUNDED = 14.0, 0.6
_DEPTH_MM = 6.0
_MOST_FEET = 2


@dataclass(frozen=True, eq=False)
class PressedRegion:
    """Where one foot was pressed in.

    Parameters
    ----------
    mask : (ny, nx) bool
        Nodes of the relief.
    depth_mm
        Of its deepest part below the plane.
    length_mm, width_mm
        Of the region below the level at which it was found.
    facing
        Mean z of the normals of its floor, as the surface has them: > 0 for a hollow.
    flatness
        Share of its area that lies deeper than half its depth.
    """

    mask: BoolArray
    depth_mm: float
    length_mm: float
    width_mm: float
    facing: float
    flatness: float


def pressed_regions(relief: Relief) -> list[PressedRegion]:
    """Find the regions below z = 0 that are as large as a foot and surrounded by a rim.

    Returns
    -------
    list of PressedRegion
        Two at most; none where there is no imprint.
    """
    best: list[PressedRegion] = []
    for level_mm in _LEVELS_MM:
        found = _at_level(relief, level_mm)
        if len(found) > len(best):
            best = found
    return best


def _at_level(relief: Relief, level_mm: float) -> list[PressedRegion]:
    low = (relief.heights_mm < -level_mm) & (relief.heights_mm > -_DEEPEST_MM)
    parts, count = scipy.ndimage.label(_holes_filled(low, relief), np.ones((3, 3)))
    sizes = np.bincount(parts.ravel(), minlength=count + 1) * relief.cell_mm**2
    large = [n for n in range(1, count + 1) if sizes[n] > _PART_MM2]
    masks = _grouped([parts == n for n in sorted(large, key=lambda n: -sizes[n])], relief)
    regions = [region for mask in masks if (region := _region(mask, relief)) is not None]
    return regions if len(regions) <= _MOST_FEET else []


def _holes_filled(low: BoolArray, relief: Relief) -> BoolArray:
    """Add what is enclosed and was not measured, such as steep walls."""
    missing = np.isnan(relief.heights_mm)
    enclosed = missing & scipy.ndimage.binary_fill_holes(~missing)
    return np.asarray(low | (enclosed & _near(low, relief)))


def _near(mask: BoolArray, relief: Relief) -> BoolArray:
    return np.asarray(scipy.ndimage.distance_transform_edt(~mask) * relief.cell_mm < _RING_MM)


def _grouped(parts: list[BoolArray], relief: Relief) -> list[BoolArray]:
    """Join parts, the largest first, that make one longish shape with a larger one near them."""
    groups: list[BoolArray] = []
    for part in parts:
        for number, group in enumerate(groups):
            gap = scipy.ndimage.distance_transform_edt(~group)[part].min() * relief.cell_mm
            if gap < _GAP_MM and _is_foot_like(*_extents(group | part, relief)):
                groups[number] = group | part
                break
        else:
            groups.append(part)
    return groups


def _extents(mask: BoolArray, relief: Relief) -> tuple[float, float]:
    """Return length and width of a region along its main directions, mm."""
    places = relief.positions(mask)
    centred = places - places.mean(axis=0)
    along = centred @ np.linalg.eigh(centred.T @ centred)[1]
    width, length = np.ptp(along, axis=0)
    return float(length), float(width)


def _is_foot_like(length_mm: float, width_mm: float) -> bool:
    least, most = _WIDTH_TO_LENGTH
    fits = _LENGTH_MM[0] <= length_mm <= _LENGTH_MM[1]
    return fits and least <= width_mm / length_mm <= most


def _region(mask: BoolArray, relief: Relief) -> PressedRegion | None:
    length_mm, width_mm = _extents(mask, relief)
    if not _is_foot_like(length_mm, width_mm) or _surrounded(mask, relief) < _SURROUNDED:
        return None
    heights: FloatArray = relief.heights_mm[mask]
    measured = np.isfinite(heights)
    depth_mm = -float(np.quantile(heights[measured], 0.02))
    if depth_mm < _DEPTH_MM:
        return None
    floor = mask & (relief.heights_mm < -0.5 * depth_mm)
    facing = float(np.mean(relief.facing[floor]))
    return PressedRegion(
        mask, depth_mm, length_mm, width_mm, facing, float(floor.sum() / measured.sum())
    )


def _surrounded(mask: BoolArray, relief: Relief) -> float:
    """Return the share of the surroundings of a region that is rim."""
    ring = _near(mask, relief) & ~mask
    heights = relief.heights_mm[ring]
    return float(((heights > _RIM_MM[0]) & (heights < _RIM_MM[1])).mean())
