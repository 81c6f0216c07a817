"""Clearing of the block level by level: ramps into what is solid, never more than a step deep."""

from __future__ import annotations

import cv2
import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.milling.drop_cutter import tip_heights
from insole_core.milling.machine import Machine, Roughing
from insole_core.milling.rasters import Raster, Run, raster_lines, runs_of
from insole_core.milling.stock import Stock, runs_of_closed, widened
from insole_core.milling.surface import Surface
from insole_core.milling.tool_path import (
    CLEARANCE_MM,
    LINK_MM,
    RAMP,
    Operation,
    PathWriter,
    SideName,
    needed_nodes,
    without_collinear,
)
from insole_core.progress import SILENT, Progress

_LEAST_CUT_MM = 0.05
_WATERLINES = ((0.0, 0.1), (1 / 3, 2.0), (2 / 3, 2.0))
"""Shares of a level at which the cutter goes along walls, and how high may stay there, mm."""
_BEYOND = 8
"""Nodes of the grid by which it does so farther than needed."""
_SHORTEST_RAMP_MM = 1.0
"""Length of a run that a ramp needs, to and fro."""
_SAME_MM = 1e-6
_MOST_TO_AND_FRO = 12
_BACK, _FORTH = slice(None, None, -1), slice(None)


def roughing(
    surface: Surface,
    machine: Machine,
    block_height_mm: float,
    side: SideName,
    *,
    reach_mm: float,
    stock: Stock,
    progress: Progress = SILENT,
) -> Operation | None:
    """Clear the block above the surface, and round the solids.

    Parameters
    ----------
    reach_mm
        Round the solids, in which the cutter's axis moves.
    stock
        From which the cutter takes away.

    Returns
    -------
    Operation or None
        None when there is nothing to clear.
    """
    how, cutter = machine.roughing, machine.roughing.cutter
    lines, every_line = raster_lines(surface, how.step_over_mm), np.arange(len(surface.x_mm))
    tips = tip_heights(surface, cutter, every_line, how.allowance_mm)
    allowed = surface.beside_mm <= reach_mm
    on_lines = np.zeros_like(allowed)
    on_lines[lines] = allowed[lines]
    rampable = _rampable(np.where(allowed, tips, np.inf), surface.step_mm)
    # Farther out the cutter would meet what the lines have left of the block.
    near_solids = surface.beside_mm <= reach_mm - how.step_over_mm
    writer = PathWriter(block_height_mm + machine.safe_height_mm)
    lowest = float(tips[allowed].min())
    count = max(int(np.ceil((block_height_mm - lowest) / how.step_down_mm)), 1)
    for number, step in enumerate(progress.parts(count), 1):
        step.step(0.0, "Roughing, level {level} of {levels}", level=number, levels=count)
        above = block_height_mm - (number - 1) * how.step_down_mm
        level_mm = above - how.step_down_mm
        level = np.maximum(rampable, level_mm)
        active = on_lines & (rampable < above - _LEAST_CUT_MM)
        raster = Raster(surface, cutter, lines, level[lines])
        _Level(raster, active[lines], above, how).write(writer)
        stock.sweep(level, active, cutter)
        for share, terrace_mm in _WATERLINES:
            height_mm = level_mm + share * how.step_down_mm
            left = stock.meets(cutter, height_mm + terrace_mm) & near_solids
            for loop in _waterlines(allowed & (tips <= height_mm), surface, height_mm):
                node = surface.index_of(loop[:, :2])
                for way in _ways(loop, left[node], near_solids[node]):
                    wide = stock.is_wide(way, cutter, how.slot_mm, how.width_mm)
                    stock.write(way, writer, cutter, how.slot_mm if wide else how.step_down_mm)
    return None if writer.is_empty else writer.operation("roughing", side, cutter)


def _rampable(tips_mm: FloatArray, step_mm: float) -> FloatArray:
    """Raise tips (nx, ny) where they lie lower along y for a way that is too short for a ramp.

    What stays there is in the stock, and is cut with what lies beside it.
    """
    least = int(np.ceil(_SHORTEST_RAMP_MM / step_mm)) + 1
    return np.asarray(
        cv2.morphologyEx(
            tips_mm, cv2.MORPH_CLOSE, np.ones((1, least), np.uint8), borderType=cv2.BORDER_REPLICATE
        )
    )


def _waterlines(within: BoolArray, surface: Surface, height_mm: float) -> list[FloatArray]:
    """Return the closed lines (n, 3) round the nodes (nx, ny) where the cutter may go so low."""
    found, _ = cv2.findContours(within.astype(np.uint8), cv2.RETR_LIST, cv2.CHAIN_APPROX_NONE)
    loops = []
    for contour in found:
        places = contour[:, 0, ::-1] * surface.step_mm + surface.first_mm
        loops.append(np.column_stack([places, np.full(len(places), height_mm)]))
    return loops


def _ways(loop: FloatArray, left: BoolArray, near: BoolArray) -> list[FloatArray]:
    """Return the smoothed pieces of a closed line (n, 3) where something is left."""
    if not left.any():
        return []
    kept = near & widened(np.pad(left, _BEYOND, mode="wrap"), _BEYOND)[_BEYOND:-_BEYOND]
    return runs_of_closed(loop, kept)


class _Level:
    """One level of the block, which is free above `above_mm` where it is active.

    Parameters
    ----------
    raster
        Its tips are those of the level.
    """

    def __init__(self, raster: Raster, active: BoolArray, above_mm: float, how: Roughing) -> None:
        self._raster = raster
        self._above_mm = above_mm
        step_mm, radius_mm = raster.surface.step_mm, raster.cutter.radius_mm
        self._wide = 2 * int(radius_mm / step_mm) + 1
        self._slot_depth_mm = how.slot_mm
        self._slot_mm = above_mm - how.slot_mm
        # With a line more on either side, which is not cut.
        self._reached_mm = np.full((len(active) + 2, active.shape[1]), above_mm)
        self._needed = needed_nodes(raster.tips_mm, active, how.allowance_mm / 10)
        self._waiting = runs_of(active)
        self._link_nodes = int(LINK_MM / step_mm)
        self._shortest = int(np.ceil(_SHORTEST_RAMP_MM / step_mm))
        spacing_mm = float(np.diff(raster.lines).max(initial=1)) * step_mm
        inset_mm = radius_mm - np.sqrt(max(radius_mm**2 - (spacing_mm / 2) ** 2, 0.0))
        # Nodes before the ends of two lines, where what lies between is in reach of both.
        self._inset = int(np.ceil(inset_mm / step_mm)) + 1

    def write(self, writer: PathWriter) -> None:
        """Write all runs, to and fro where the next one lies beside the last one."""
        while self._waiting:
            run, forward = self._waiting.pop(0), True
            way = self._ramped(run.line, _ordered(run.start, run.end), self._above_mm)
            writer.start(without_collinear(way), self._above_mm + CLEARANCE_MM)
            while (found := self._beside(run, forward)) is not None:
                other, node = found
                self._waiting.remove(other)
                way = self._crossing(run, other, node, forward)
                writer.go_on(without_collinear(way))
                run, forward = other, not forward

    def _beside(self, run: Run, forward: bool) -> tuple[Run, int] | None:
        """Return the run of the next line that begins near here, and the node to cross at."""
        here = run.end if forward else run.start
        for other in self._waiting:
            if other.line > run.line + 1:
                return None
            low = max(run.start, other.start) + self._inset
            high = min(run.end, other.end) - self._inset
            node = high if forward else low
            if other.line == run.line + 1 and low <= high and abs(here - node) <= self._link_nodes:
                return other, node
        return None

    def _crossing(self, run: Run, other: Run, node: int, forward: bool) -> FloatArray:
        """Return the way back to a node, across, out to the end of the other run, and along it.

        Across beyond the end of a line the cutter would meet what no level above has cleared.
        """
        here, there = (run.end, other.end) if forward else (run.start, other.start)
        far = other.start if forward else other.end
        nodes = _ordered(here, node)
        back = self._way(run.line, nodes, self._raster.tips_mm[run.line, nodes])
        across_mm = max(
            self._raster.link_height(run.line, other.line, (node - 1, node + 1)),
            back[-1, 2],
            self._slot_mm,
        )
        across = np.stack([back[-1], self._raster.at(other.line, np.array([node]))[0]])
        across[:, 2] = across_mm
        nodes = _ordered(node, there)
        out = self._way(other.line, nodes, self._sunk(other.line, nodes, across_mm))
        whole = self._ramped(other.line, _ordered(there, far), float(out[-1, 2]))
        return np.concatenate([back, across, out, whole])

    def _way(self, line: int, nodes: IntArray, heights_mm: FloatArray) -> FloatArray:
        """Return those points (n, 3) of a way along nodes, on the level or above, that it needs."""
        points = self._raster.at(line, nodes)
        is_above = heights_mm > points[:, 2] + _SAME_MM
        points[:, 2] = heights_mm
        changes = is_above[1:] != is_above[:-1]
        kept = self._needed[line, nodes]
        kept[1:] |= changes
        kept[:-1] |= changes
        kept[1:-1] |= is_above[1:-1] & (np.abs(np.diff(heights_mm, 2)) > _SAME_MM)
        kept[[0, -1]] = True
        return without_collinear(points[kept])

    def _ramped(self, line: int, nodes: IntArray, from_mm: float) -> FloatArray:
        """Return a way (n, 3) along nodes, from a height in the block down to the level.

        It sinks no steeper than the ramp, and no deeper than a slot where nothing is cut beside it.
        Where it stays above the level, it goes back and forth there until it has sunk.
        """
        level = self._raster.tips_mm[line, nodes]
        sunk = self._sunk(line, nodes, from_mm)
        self._reached_mm[line + 1, nodes] = level
        pieces, begin = [], 0
        for above in runs_of((sunk > level + _LEAST_CUT_MM)[None]):
            first, last = above.start, min(above.end + 1, len(nodes) - 1)
            pieces.append(self._way(line, nodes[begin : last + 1], sunk[begin : last + 1]))
            stretch = slice(max(min(first, last - self._shortest), 0), last + 1)
            pieces += self._to_and_fro(line, nodes[stretch], level[stretch], sunk[stretch])
            begin = last + 1
        if begin < len(nodes):
            pieces.append(self._way(line, nodes[begin:], sunk[begin:]))
        return np.concatenate(pieces)

    def _sunk(self, line: int, nodes: IntArray, from_mm: float) -> FloatArray:
        """Return the heights (n,) of a first way along nodes."""
        level, reached = self._raster.tips_mm[line, nodes], self._reached_mm[line + 1, nodes]
        first = max(int(nodes.min()) - self._inset, 0)
        near = self._reached_mm[line : line + 3 : 2, first : int(nodes.max()) + self._inset + 1]
        beside = scipy.ndimage.maximum_filter1d(near, 2 * self._inset + 1, axis=1)
        around = np.minimum(reached, beside[:, nodes - first].min(axis=0))
        sunk = self._sinking(np.maximum(level, around - self._slot_depth_mm), from_mm)
        self._reached_mm[line + 1, nodes] = np.minimum(reached, sunk)
        return sunk

    def _to_and_fro(
        self, line: int, nodes: IntArray, level_mm: FloatArray, reached_mm: FloatArray
    ) -> list[FloatArray]:
        """Return the ways from the last of the nodes back and forth, down to the level there.

        Parameters
        ----------
        reached_mm : (n,) float64
            Where the cutter has been; it goes deeper by what a slot allows at most. Where the
            nodes are too few for ramps, the last ways plunge.
        """
        pieces: list[FloatArray] = []
        for _ in range(_MOST_TO_AND_FRO):
            for way in (_BACK, _FORTH):
                beside_mm = scipy.ndimage.maximum_filter1d(reached_mm, self._wide, mode="nearest")
                allowed = np.maximum(level_mm, beside_mm - self._slot_depth_mm)
                sunk = self._sinking(allowed[way], float(reached_mm[way][0]))
                pieces.append(self._way(line, nodes[way], sunk))
                reached_mm = np.minimum(reached_mm, sunk[way])
            if (reached_mm <= level_mm + _LEAST_CUT_MM).all():
                return pieces
        return [*pieces, *(self._way(line, nodes[way], level_mm[way]) for way in (_BACK, _FORTH))]

    def _sinking(self, level_mm: FloatArray, from_mm: float) -> FloatArray:
        """Return the heights (n,) of a way from one in the block down to the level, on a ramp."""
        fallen_mm = RAMP * self._raster.surface.step_mm * np.arange(len(level_mm))
        lifted = level_mm + fallen_mm
        lifted[0] = max(lifted[0], from_mm)
        return np.asarray(np.maximum.accumulate(lifted) - fallen_mm)


def _ordered(first: int, last: int) -> IntArray:
    """Return the nodes from one to another, both included."""
    return np.arange(first, last + 1) if last >= first else np.arange(first, last - 1, -1)
