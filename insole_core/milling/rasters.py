"""Lines along the block's length, and finishing in them, with more lines where ridges stay."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.milling.drop_cutter import finishing_heights
from insole_core.milling.machine import Cutter, Finishing, Machine
from insole_core.milling.stock import Stock
from insole_core.milling.surface import Surface
from insole_core.milling.tool_path import (
    CLEARANCE_MM,
    LINK_MM,
    Operation,
    PathWriter,
    SideName,
    needed_nodes,
    without_collinear,
)

_GAP_MM = 0.02
"""By which the cutter may be farther from the surface between two lines than on them."""
_RIDGES = 2.0
"""Height of ridges on a slope, of those on the level."""
_JOINED_MM = 6.0
_LONGER_MM = 0.75
"""By which pieces begin before the place that needs them."""
_RIM_MM = 0.4
_CLOSE_MM = 0.003
"""By which straight pieces may leave a finishing path."""
OVER_RIM = 0.95
"""Share of the radius by which a ball goes over the rim: it touches edges that fall by 70°."""
_SHARE = 0.75
"""Of the step-down of roughing, that finishing takes away at most."""
_MORE = 2
"""Nodes round one where more stays, which may be missed on single ones."""
_LINK_LINES = 1
_GONE = 10**6
"""Node of pieces that have been followed, far from all."""


def _added_lines(surface: Surface, tips: FloatArray, how: Finishing) -> BoolArray:
    """Find the nodes (nx, ny) between the lines of a raster to which the cutter must go too.

    Parameters
    ----------
    tips : (nx, ny) float64, mm
        Lowest tips of the cutter at all nodes. The raster takes every few lines.
    """
    every = surface.steps_in(how.step_over_mm)
    needed = np.zeros(tips.shape, bool)
    touched = _touches(surface, tips, how.cutter.radius_mm)
    spans = [(0, every)]
    while spans:
        first, last = spans.pop()
        middle = (first + last) // 2
        if middle == first:
            continue
        spans += [(first, middle), (middle, last)]
        lines = np.arange(0, tips.shape[0] - last, every)
        share = (middle - first) / (last - first)
        below, above = tips[lines + first], tips[lines + last]
        across = (above - below) / ((last - first) * surface.step_mm)
        along = np.gradient(tips[lines + middle], surface.step_mm, axis=1)
        gap = below * (1 - share) + above * share - tips[lines + middle]
        too_far = gap > _GAP_MM * np.sqrt(1 + across**2 + along**2)
        wide = ((last - first) / every) ** 2 * (1 + across**2) > _RIDGES
        needed[lines + middle] = (too_far | wide) & touched[lines + middle]
    return _joined(needed, surface.step_mm)


def _touches(surface: Surface, tips: FloatArray, radius_mm: float) -> BoolArray:
    """Find the nodes at which the ball touches the solids off their rim."""
    size = 2 * int(np.ceil(_RIM_MM / surface.step_mm)) + 1
    within = cv2.erode(surface.inside.astype(np.uint8), np.ones((size, size), np.uint8)) > 0
    slopes = np.gradient(tips, surface.step_mm)
    steep = radius_mm / surface.step_mm / np.sqrt(1 + slopes[0] ** 2 + slopes[1] ** 2)
    nodes = np.indices(tips.shape)
    places = [
        np.clip(np.rint(node + slope * steep).astype(int), 0, size - 1)
        for node, slope, size in zip(nodes, slopes, tips.shape, strict=True)
    ]
    return np.asarray(within[places[0], places[1]])


def _joined(needed: BoolArray, step_mm: float) -> BoolArray:
    """Return pieces along the lines that are longer, and joined where little is between them."""
    longer, gap = (2 * int(size / step_mm) + 1 for size in (_LONGER_MM, _JOINED_MM / 2))
    grown = cv2.dilate(needed.astype(np.uint8), np.ones((1, longer), np.uint8))
    closed = cv2.morphologyEx(grown, cv2.MORPH_CLOSE, np.ones((1, gap), np.uint8))
    return np.asarray(closed > 0)


@dataclass(frozen=True, eq=False)
class Run:
    """A piece of a line of a raster: its index, and its first and last node."""

    line: int
    start: int
    end: int


@dataclass(frozen=True, eq=False)
class Raster:
    """Tips of a cutter along lines; the nodes where it may be, and those that are needed."""

    surface: Surface
    cutter: Cutter
    lines: IntArray
    tips_mm: FloatArray

    def at(self, line: int, nodes: IntArray) -> FloatArray:
        """Return the tips (n, 3) at nodes of a line."""
        points = np.empty((len(nodes), 3))
        points[:, 0] = self.surface.x_mm[self.lines[line]]
        points[:, 1] = self.surface.y_mm[nodes]
        points[:, 2] = self.tips_mm[line, nodes]
        return points

    def points(self, run: Run, needed: BoolArray) -> FloatArray:
        """Return the points (n, 3) of a run, along y."""
        nodes = run.start + np.flatnonzero(needed[run.line, run.start : run.end + 1])
        return without_collinear(self.at(run.line, nodes))

    def link_height(self, line: int, other: int, nodes: tuple[int, int]) -> float:
        """Return the height at which the cutter may go from one line to the next."""
        low, high = min(nodes), max(nodes) + 1
        highest = self.tips_mm[[line, other], low:high].max()
        half = (self.lines[other] - self.lines[line]) * self.surface.step_mm / 2
        radius = self.cutter.radius_mm
        between = 0.0 if self.cutter.shape == "flat" else radius - np.sqrt(radius**2 - half**2)
        return float(highest + between)


def finishing(
    surface: Surface, machine: Machine, block_height_mm: float, side: SideName, stock: Stock
) -> Operation:
    """Leave the surface in lines, a little over its rim, and take away from the stock.

    Where evenly spaced lines would leave more than their ridges (in a crease between two of them,
    or on a slope across them), pieces of lines are added between them.
    """
    how = machine.finishing
    lines = raster_lines(surface, how.step_over_mm)
    tips = np.minimum(finishing_heights(surface, how.cutter), block_height_mm)
    allowed = surface.beside_mm <= how.cutter.radius_mm * OVER_RIM
    top, most_mm = stock.free_tips(how.cutter), _SHARE * machine.roughing.step_down_mm
    # Beside a wall the ball would meet all that stays along it, which the contour cuts.
    near = cv2.dilate(top, np.ones((2 * _MORE + 1, 2 * _MORE + 1)))
    tips = np.where(surface.inside, tips, np.maximum(tips, near - most_mm))
    writer = PathWriter(block_height_mm + machine.safe_height_mm)
    raster = Raster(surface, how.cutter, lines, tips[lines])
    deep = allowed & (top > tips + most_mm)
    for run in _longer(deep[lines], allowed[lines]):
        way = raster.at(run.line, np.arange(run.start, run.end + 1))
        stock.write(way, writer, how.cutter, most_mm)
    _follow(raster, allowed[lines], writer)
    added = _added_lines(surface, tips, how) & allowed
    whole = Raster(surface, how.cutter, np.arange(len(tips)), tips)
    _follow_pieces(whole, added, allowed, writer)
    on_lines = added.copy()
    on_lines[lines] |= allowed[lines]
    stock.sweep(tips, on_lines, how.cutter)
    return writer.operation("finishing", side, how.cutter)


def _longer(nodes: BoolArray, allowed: BoolArray) -> list[Run]:
    """Return the pieces of the nodes, with some more before and after them."""
    grown = cv2.dilate(nodes.astype(np.uint8), np.ones((1, 2 * _MORE + 1), np.uint8)) > 0
    return [run for run in runs_of(grown & allowed) if run.end > run.start]


def _follow_pieces(
    raster: Raster, added: BoolArray, allowed: BoolArray, writer: PathWriter
) -> None:
    """Write pieces of lines, after the whole lines, always the nearest one next.

    From one to the next the cutter stays above all tips of the rectangle that both span, where the
    lines have been.
    """
    runs = runs_of(added)
    if not runs:
        return
    tips, step = raster.tips_mm, raster.surface.step_mm
    needed = needed_nodes(tips, added, _CLOSE_MM)
    ends = np.array([[[run.line, run.start], [run.line, run.end]] for run in runs])
    waiting = ends.copy()
    here: IntArray | None = None
    for _ in runs:
        number, turned = _nearest(waiting, here)
        waiting[number] = _GONE
        start, end = ends[number][::-1] if turned else ends[number]
        points = raster.points(runs[number], needed)
        points = points[::-1] if turned else points
        link = None if here is None else _link(tips, allowed, here, start, step)
        if link is None:
            reach = int(raster.cutter.radius_mm / step)
            round_it = tuple(slice(max(node - reach, 0), node + reach + 1) for node in start)
            writer.start(points, float(tips[round_it].max()) + CLEARANCE_MM)
        else:
            across = np.stack([writer.last_mm, points[0]])
            across[:, 2] = link
            writer.go_on(np.concatenate([across, points]))
        here = end


def _nearest(ends: IntArray, here: IntArray | None) -> tuple[int, bool]:
    """Return the piece (n, 2, 2: its ends) that begins next to a node, and whether at its end."""
    if here is None:
        return 0, False
    distance = np.abs(ends[:, :, 0] - here[0])
    distance += np.abs(ends[:, :, 1] - here[1])
    number, end = divmod(int(distance.argmin()), 2)
    return number, bool(end)


def _link(
    tips: FloatArray, allowed: BoolArray, here: IntArray, there: IntArray, step_mm: float
) -> float | None:
    """Return the height of a way from one node to another; None where the cutter lifts."""
    low, high = np.minimum(here, there), np.maximum(here, there) + 1
    if (high - low).max() * step_mm > LINK_MM:
        return None
    spanned = slice(low[0], high[0]), slice(low[1], high[1])
    return float(tips[spanned].max()) + _CLOSE_MM if allowed[spanned].all() else None


def raster_lines(surface: Surface, step_over_mm: float) -> IntArray:
    """Return the lines of the grid that a raster takes, at most the step-over apart."""
    return np.arange(0, len(surface.x_mm), surface.steps_in(step_over_mm))


def _follow(raster: Raster, active: BoolArray, writer: PathWriter) -> None:
    """Write all runs, to and fro where the next one begins beside the last one's end."""
    needed = needed_nodes(raster.tips_mm, active, _CLOSE_MM)
    waiting = runs_of(active)
    while waiting:
        run, forward = waiting.pop(0), True
        points = raster.points(run, needed)
        writer.start(points)
        while (found := _next(raster, waiting, run, forward, active)) is not None:
            here = run.end if forward else run.start
            waiting.remove(found)
            there = found.end if forward else found.start
            height = raster.link_height(run.line, found.line, (here, there))
            last, forward, run = points[-1], not forward, found
            points = raster.points(run, needed)
            points = points if forward else points[::-1]
            height = max(height, last[2], points[0, 2])
            across = np.array([[last[0], last[1], height], [points[0, 0], points[0, 1], height]])
            writer.go_on(np.concatenate([across, points]))


def _next(
    raster: Raster, waiting: list[Run], run: Run, forward: bool, active: BoolArray
) -> Run | None:
    """Return the run on the next line that can be reached without leaving the active nodes."""
    here = run.end if forward else run.start
    for other in waiting:
        if other.line > run.line + _LINK_LINES:
            return None
        there = other.end if forward else other.start
        low, high = min(here, there), max(here, there) + 1
        if other.line == run.line + _LINK_LINES and bool(
            (active[run.line, low:high] | active[other.line, low:high]).all()
        ):
            return other
    return None


def runs_of(active: BoolArray) -> list[Run]:
    """Return the pieces of consecutive active nodes, line by line."""
    edges = np.diff(np.pad(active.astype(np.int8), ((0, 0), (1, 1))), axis=1)
    start, end = np.argwhere(edges == 1), np.argwhere(edges == -1)
    return [
        Run(int(line), int(first), int(last) - 1)
        for (line, first), last in zip(start, end[:, 1], strict=True)
    ]
