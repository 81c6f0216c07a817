"""Difference maps of two surfaces in the (x, y)-plane, thesis 8.3, (27) to (29)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from insole_core.compare.best_fit import Fit
from insole_core.compare.seen_surface import Grid, SeenMesh, facing, grid_over
from insole_core.errors import InputError
from insole_core.foot.spread import MeasuredFoot, Spread
from insole_core.geometry.arrays import BoolArray, FloatArray

PITCH_MM = 1.0
_LEAST_AREA_MM2 = 100.0
FOOT_MEASURES = ("foot_length", "ball_width", "heel_width", "arch_height")
"""Of a foot, by the names in `insole_core.foot.measures.DEFINITIONS`."""
PART_MEASURES = ("length", "heel_width", "forefoot_width", "arch_height")
"""Of the compared part of an insole, a mould or anything else."""


@dataclass(frozen=True, eq=False)
class Difference:
    """Heights of two surfaces on the same pixels.

    Parameters
    ----------
    grid
        In the frame of a.
    heights_a_mm, heights_b_mm : (rows, columns) float64
        NaN where nothing was seen.
    fit
        Pose of b relative to a.
    feet
        Measures of a and of b, where they are feet.
    b_is_mirrored
        Whether b is of the other foot, and was mirrored in x before.
    """

    grid: Grid
    heights_a_mm: FloatArray
    heights_b_mm: FloatArray
    fit: Fit
    feet: tuple[MeasuredFoot | None, MeasuredFoot | None] = (None, None)
    b_is_mirrored: bool = False

    @cached_property
    def signed_mm(self) -> FloatArray:
        """(rows, columns) a minus b: positive where a is higher; NaN if either is missing."""
        return np.asarray(self.heights_a_mm - self.heights_b_mm)

    @cached_property
    def statistics(self) -> dict[str, float]:
        """Statistics of the report, mm; of the absolute difference unless named signed."""
        signed = self.signed_mm[np.isfinite(self.signed_mm)]
        size = np.abs(signed)
        return {
            "mean_abs": float(size.mean()),
            "rms": float(np.sqrt((size**2).mean())),
            "median_abs": float(np.median(size)),
            "p95": float(np.percentile(size, 95)),
            "max": float(size.max()),
            "signed_mean": float(signed.mean()),
            "signed_min": float(signed.min()),
            "signed_max": float(signed.max()),
            "compared_area_mm2": float(len(signed) * self.grid.pitch_mm**2),
        }


def measure_difference(
    a: SeenMesh,
    b: SeenMesh,
    fit: Fit,
    looks_b: FloatArray,
    *,
    pitch_mm: float = PITCH_MM,
    median_pixels: int = 1,
) -> Difference:
    """Project both surfaces onto the (x, y)-plane of a and measure their heights there.

    Parameters
    ----------
    a, b : mm
        Each in its own frame.
    looks_b : (3,) float64
        Direction in which the seen side of b faces, in its own frame.
    pitch_mm
        Size of a pixel.
    median_pixels
        Kernel of the spatial median filter of both; 1 for none, 6 as in the thesis.

    Raises
    ------
    InputError
        If they do not lie over each other.
    """
    grid = grid_over(a.mesh, pitch_mm)
    sides = ((a, facing(a.mesh), np.eye(4)), (b, fit.b2a[:3, :3] @ looks_b, fit.b2a))
    heights = [
        _median_filtered(seen.heights(grid, bool(looks[2] > 0), to_a), median_pixels)
        for seen, looks, to_a in sides
    ]
    difference = Difference(grid, heights[0], heights[1], fit)
    area = np.isfinite(difference.signed_mm).sum() * pitch_mm**2
    if area < _LEAST_AREA_MM2:
        raise InputError(
            "The two surfaces lie over each other on {area_mm2:.0f} mm² only, which is too little "
            "to compare; let them be fitted, or pick points on both.",
            area_mm2=area,
        )
    return difference


@dataclass(frozen=True)
class ComparedMeasure:
    """One measure of both surfaces, mm; None where a surface has none.

    A measure of a foot has its ±; None for the compared part of something else, which is no more
    than a count of pixels.
    """

    key: str
    a: float | None
    b: float | None
    a_spread: Spread | None = None
    b_spread: Spread | None = None

    @property
    def is_within_error(self) -> bool:
        """Whether both are feet whose difference is no larger than its known error."""
        if self.a is None or self.b is None or self.a_spread is None or self.b_spread is None:
            return False
        limit = self.a_spread.beside(self.b_spread)
        return limit is not None and abs(self.a - self.b) <= limit


def table_3(difference: Difference) -> dict[str, dict[str, float]]:
    """Return the measures of both surfaces, mm, as the thesis compares them.

    Returns
    -------
    dict
        By name, for "a" and "b": of a foot those of `FOOT_MEASURES` that its scan carries, of
        anything else those of `PART_MEASURES`.
    """
    parts = _part_measures(difference)
    return {
        name: parts[name]
        if foot is None
        else {key: value for key in FOOT_MEASURES if (value := foot.values[key]) is not None}
        for name, foot in zip("ab", difference.feet, strict=True)
    }


def foot_rows(difference: Difference) -> list[ComparedMeasure]:
    """Return the measures of the feet among both surfaces; none when neither is a foot."""
    return [
        replace(row, a_spread=_spread(row.a, a, row.key), b_spread=_spread(row.b, b, row.key))
        for a, b in [difference.feet]
        for row in _rows(difference, FOOT_MEASURES, of_feet=True)
    ]


def _spread(value: float | None, foot: MeasuredFoot | None, key: str) -> Spread | None:
    return None if value is None or foot is None else foot.spread(key)


def part_rows(difference: Difference) -> list[ComparedMeasure]:
    """Return the measures of the compared part of what is no foot."""
    return _rows(difference, PART_MEASURES, of_feet=False)


def _rows(difference: Difference, keys: Sequence[str], *, of_feet: bool) -> list[ComparedMeasure]:
    table = table_3(difference)
    a, b = (
        table[name] if (foot is not None) is of_feet else {}
        for name, foot in zip("ab", difference.feet, strict=True)
    )
    return [ComparedMeasure(key, a.get(key), b.get(key)) for key in keys if key in {**a, **b}]


def _part_measures(difference: Difference) -> dict[str, dict[str, float]]:
    """Measure the compared part of both, in the frame of an insole or a foot.

    Heights count on the side that faces the ground; widths are those of the compared surface.
    """
    rows = np.flatnonzero(np.isfinite(difference.signed_mm).any(axis=1))
    first, last = rows.min(), rows.max()
    measures = {}
    for name, heights in (("a", difference.heights_a_mm), ("b", difference.heights_b_mm)):
        known = np.isfinite(heights)
        known[:first], known[last + 1 :] = False, False
        measures[name] = _shape_measures(heights, known, difference.grid)
    return measures


def _shape_measures(heights: FloatArray, known: BoolArray, grid: Grid) -> dict[str, float]:
    rows = np.flatnonzero(known.any(axis=1))
    length = len(rows) * grid.pitch_mm
    widths = known.sum(axis=1) * grid.pitch_mm
    heel, arch, ball = (
        rows[int(start * len(rows)) : max(int(end * len(rows)), int(start * len(rows)) + 1)]
        for start, end in ((0.10, 0.25), (0.35, 0.55), (0.60, 0.80))
    )
    return {
        "length": float(length),
        "heel_width": float(widths[heel].max()),
        "forefoot_width": float(widths[ball].max()),
        "arch_height": float(np.nanmax(heights[arch]) - np.nanpercentile(heights[rows], 2)),
    }


def _median_filtered(heights: FloatArray, pixels: int) -> FloatArray:
    """Return the median of square neighbourhoods; NaN where less than half of one was seen."""
    if pixels <= 1:
        return heights
    before, after = pixels // 2, (pixels - 1) // 2
    padded = np.pad(heights, (before, after), constant_values=np.nan)
    windows = np.lib.stride_tricks.sliding_window_view(padded, (pixels, pixels))
    flat = windows.reshape(*heights.shape, -1)
    count = np.isfinite(flat).sum(axis=-1)
    enough = (count * 2 >= pixels**2) & (count > 0)
    ordered = np.sort(flat[enough], axis=-1)  # what was not seen comes last
    middles = np.stack([(count[enough] - 1) // 2, count[enough] // 2], axis=-1)
    result = np.full(heights.shape, np.nan)
    result[enough] = np.take_along_axis(ordered, middles, axis=-1).mean(axis=-1)
    return np.where(np.isfinite(heights), result, np.nan)
