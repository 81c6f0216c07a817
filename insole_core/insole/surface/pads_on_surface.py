"""Pads and brush strokes on the contact base: all of them, or only where something has changed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeAlias

import cv2
import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.elements import BrushStroke, Correction, Pelott
from insole_core.insole.pads.pad_heights import pad_heights, pad_outline
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.blending import gaussian_hill
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.surface.contact import ContactBase

_PITCH = 1 / 40  # of the radius, between the points that sample the path
_SIGMA = 1 / 3  # of the radius: standard deviation of the smoothing
_HALO = 4 * _SIGMA
"""How far beyond its radius a smoothing stroke reads heights, in radii."""
_Area: TypeAlias = tuple[FloatArray, FloatArray, Callable[[FloatArray, FloatArray], FloatArray]]
"""Two opposite corners (x, y), and what returns heights or weights (ny, nx) at nodes between."""


def _stroke_weight(stroke: BrushStroke, x_mm: FloatArray, y_mm: FloatArray) -> FloatArray:
    """Compute the weight of a stroke on the nodes of a grid.

    Parameters
    ----------
    x_mm, y_mm : (nx,), (ny,) float64
        Coordinates of the columns and rows, insole frame.

    Returns
    -------
    (ny, nx) float64
        1 on the path of the stroke, falling to 0 at its radius.
    """
    way = _dense(np.array(stroke.points_mm, dtype=float), _PITCH * stroke.radius_mm)
    x, y = np.meshgrid(x_mm, y_mm)
    distance, _ = scipy.spatial.cKDTree(way).query(
        np.stack([x, y], axis=-1), distance_upper_bound=10_000.0
    )
    return gaussian_hill(np.asarray(distance) / stroke.radius_mm)


def _stroked(heights: FloatArray, weight: FloatArray, stroke: BrushStroke, step_mm: float) -> None:
    """Apply a stroke to heights in place; nothing changes where its weight is 0.

    Parameters
    ----------
    heights : (ny, nx) float64, mm
    weight : (ny, nx) float64
        From `stroke_weight`.
    step_mm
        Pitch of the grid.
    """
    if stroke.mode == "smooth":
        even = _even(heights, _SIGMA * stroke.radius_mm / step_mm)
        heights += np.where(weight > 0, weight * stroke.strength * (even - heights), 0.0)
    else:
        sign = 1.0 if stroke.mode == "push" else -1.0
        heights += sign * stroke.strength * weight


def _even(heights: FloatArray, sigma: float) -> FloatArray:
    """Smooth with a Gaussian up to 4 sigma; OpenCV needs a tenth of the time of SciPy."""
    size = 2 * int(4 * sigma + 0.5) + 1
    border = cv2.BORDER_REPLICATE
    return np.asarray(cv2.GaussianBlur(heights.copy(), (size, size), sigma, borderType=border))


def _dense(way: FloatArray, pitch_mm: float) -> FloatArray:
    """Resample a polyline, its points at most one pitch apart."""
    lengths = np.hypot(*np.diff(way, axis=0).T) if len(way) > 1 else np.zeros(0)
    pieces = [way[:1]]
    for start, end, length in zip(way[:-1], way[1:], lengths, strict=True):
        share = np.linspace(0, 1, int(np.ceil(length / pitch_mm)) + 1)[1:, None]
        pieces.append(start + share * (end - start))
    return np.concatenate(pieces)


@dataclass(frozen=True)
class Window:
    """A rectangular part of a grid's nodes; `end` is the first row or column beyond it."""

    first_row: int
    end_row: int
    first_column: int
    end_column: int

    @property
    def rows(self) -> slice:
        """Rows as a slice."""
        return slice(self.first_row, self.end_row)

    @property
    def columns(self) -> slice:
        """Columns as a slice."""
        return slice(self.first_column, self.end_column)

    @property
    def is_empty(self) -> bool:
        """Whether it holds no node."""
        return self.first_row >= self.end_row or self.first_column >= self.end_column

    def relative_to(self, other: Window) -> tuple[slice, slice]:
        """Return rows and columns counted from the first node of another window."""
        return (
            slice(self.first_row - other.first_row, self.end_row - other.first_row),
            slice(self.first_column - other.first_column, self.end_column - other.first_column),
        )

    def meets(self, other: Window) -> bool:
        """Return whether the two windows have a node in common."""
        return not self.common(other).is_empty

    def common(self, other: Window) -> Window:
        """Return the intersection of two windows."""
        return Window(
            max(self.first_row, other.first_row),
            min(self.end_row, other.end_row),
            max(self.first_column, other.first_column),
            min(self.end_column, other.end_column),
        )

    def widened(self, shape: tuple[int, ...], by: int = 1) -> Window:
        """Return the window with more nodes on each side, within a grid of this shape."""
        return Window(
            max(self.first_row - by, 0),
            min(self.end_row + by, shape[0]),
            max(self.first_column - by, 0),
            min(self.end_column + by, shape[1]),
        )

    def joined(self, other: Window) -> Window:
        """Return the smallest window around both."""
        if self.is_empty or other.is_empty:
            return other if self.is_empty else self
        return Window(
            min(self.first_row, other.first_row),
            max(self.end_row, other.end_row),
            min(self.first_column, other.first_column),
            max(self.end_column, other.end_column),
        )


@dataclass(frozen=True, eq=False)
class SurfaceChange:
    """A surface and the part of it that differs from the previous one.

    Parameters
    ----------
    window
        Contains every node whose height or normal differs; may be empty.
    """

    surface: HeightField
    window: Window


def apply_pads(base: ContactBase, design: InsoleDesign) -> HeightField:
    """Add the design's pads, arch raises and strokes to the base, in the design's order.

    Parameters
    ----------
    base
        Of this design: see `base_key`.

    Returns
    -------
    HeightField
        Insole frame, mm; equal to the base to the bit outside the outlines of the corrections.
    """
    heights = base.surface.heights_mm.copy()
    for correction in design.of_stage("pad"):
        _apply(heights, base, correction, _whole(base.surface))
    return replace(base.surface, heights_mm=heights)


def moved_pad(
    base: ContactBase, previous: HeightField, old: InsoleDesign, new: InsoleDesign
) -> SurfaceChange:
    """Compute what `apply_pads` returns for the new design, but only where it differs.

    Parameters
    ----------
    base
        The base of both designs: their `base_key` must be equal.
    previous
        `apply_pads(base, old)`.

    Returns
    -------
    SurfaceChange
        The new surface, and the window in which it differs from `previous`.
    """
    before, after = old.of_stage("pad"), new.of_stage("pad")
    window = _changed_window(base, before, after)
    window = _with_smoothed(base, (*before, *after), window)
    if window.is_empty:
        return SurfaceChange(previous, window)
    heights = previous.heights_mm.copy()
    part = base.surface.heights_mm[window.rows, window.columns].copy()
    for correction in after:
        _apply(part, base, correction, window)
    heights[window.rows, window.columns] = part
    return SurfaceChange(replace(base.surface, heights_mm=heights), window.widened(heights.shape))


def _changed_window(
    base: ContactBase, before: Sequence[Correction], after: Sequence[Correction]
) -> Window:
    """Return the window of new, removed and edited corrections; all if the order has changed."""
    old, new = {c.id: c for c in before}, {c.id: c for c in after}
    if [i for i in old if i in new] != [i for i in new if i in old]:
        return _whole(base.surface)
    window = Window(0, 0, 0, 0)
    for correction in [c for c in before if new.get(c.id) != c] + [
        c for c in after if old.get(c.id) != c
    ]:
        window = window.joined(_reach(base, correction))
    return window


def _with_smoothed(base: ContactBase, corrections: Iterable[Correction], window: Window) -> Window:
    """Widen a window by the smoothing strokes that reach into it: they propagate changes."""
    reaches = [_reach(base, c) for c in corrections if c.spreads]
    grown = True
    while grown and not window.is_empty:
        joined = window
        for reach in reaches:
            if reach.meets(joined):
                joined = joined.joined(reach)
        window, grown = joined, joined != window
    return window


def _apply(part: FloatArray, base: ContactBase, correction: Correction, window: Window) -> None:
    """Change the heights of a window in place."""
    reach, shape = _shape(correction, base)
    common = reach.common(window)
    if common.is_empty:
        return
    here = common.relative_to(window)
    own = shape[common.relative_to(reach)]
    if isinstance(correction, BrushStroke):
        _stroked(part[here], own, correction, base.surface.step_mm)
    else:
        part[here] += own


def _reach(base: ContactBase, correction: Correction) -> Window:
    """Return the window that a correction may change, or that its smoothing reads."""
    return _shape(correction, base)[0]


@dataclass(frozen=True)
class _Grid:
    """Position of the nodes of a height field."""

    x0_mm: float
    y0_mm: float
    step_mm: float
    rows: int
    columns: int

    @classmethod
    def of(cls, field: HeightField) -> _Grid:
        return cls(field.x0_mm, field.y0_mm, field.step_mm, *field.heights_mm.shape)

    def window(self, low: FloatArray, high: FloatArray) -> Window:
        """Return the nodes between two opposite corners (x, y)."""
        first = np.ceil((low - [self.x0_mm, self.y0_mm]) / self.step_mm).astype(int)
        end = np.floor((high - [self.x0_mm, self.y0_mm]) / self.step_mm).astype(int) + 1
        (first_column, first_row), (end_column, end_row) = first.tolist(), end.tolist()
        return Window(first_row, end_row, first_column, end_column).common(
            Window(0, self.rows, 0, self.columns)
        )


def _shape(correction: Correction, base: ContactBase) -> tuple[Window, FloatArray]:
    """Return a correction's window and its height or stroke weight there; cached by the base."""
    # By the pad that it is here: bases of one foot share the cache, and their surfaces differ.
    laid = correction.laid(base.surface, base.arch_apex_mm)
    return base.shapes.get("shape", laid, lambda: _laid_on(_Grid.of(base.surface), laid))


def _laid_on(grid: _Grid, laid: Correction) -> tuple[Window, FloatArray]:
    low, high, weight = _area(laid)
    window = grid.window(low, high)
    if window.is_empty:
        return window, np.empty((0, 0))
    columns = np.arange(window.first_column, window.end_column, dtype=np.float64)
    rows = np.arange(window.first_row, window.end_row, dtype=np.float64)
    x, y = grid.x0_mm + grid.step_mm * columns, grid.y0_mm + grid.step_mm * rows
    return window, weight(x, y)


def _area(laid: Correction) -> _Area:
    if isinstance(laid, BrushStroke):
        return _stroke_area(laid)
    assert isinstance(laid, Pelott), 'a correction of the stage "pad" is laid as one of the two'
    return _pad_area(laid)


def _stroke_area(stroke: BrushStroke) -> _Area:
    radius = stroke.radius_mm * (1 + (_HALO if stroke.spreads else 0.0))
    points = np.array(stroke.points_mm)
    low, high = points.min(axis=0) - radius, points.max(axis=0) + radius
    return low, high, partial(_stroke_weight, stroke)


def _pad_area(pad: Pelott) -> _Area:
    def heights(x: FloatArray, y: FloatArray) -> FloatArray:
        return pad_heights(pad, np.stack(np.meshgrid(x, y), axis=-1))

    outline = pad_outline(pad)
    return outline.min(axis=0), outline.max(axis=0), heights


def _whole(field: HeightField) -> Window:
    rows, columns = field.heights_mm.shape
    return Window(0, rows, 0, columns)
