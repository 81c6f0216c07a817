"""What is left of the block while it is milled, on a coarse grid: how deep a move would cut."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import TypeVar

import cv2
import numpy as np
from numpy.typing import NDArray

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray, IntArray
from insole_core.geometry.height_map import disc
from insole_core.milling.machine import Cutter
from insole_core.milling.surface import Surface
from insole_core.milling.tool_path import (
    CLEARANCE_MM,
    RAMP,
    PathWriter,
    densified,
    without_collinear,
)

_Value = TypeVar("_Value", bound=np.generic)
_PITCH_MM = 0.25
_HIGH_MM = np.float32(1e6)
_SAME = 0.05
"""Share of a step that is none."""
_LONGER = 12
"""Points to either side of one where too much would be cut: a thin one has no node on each."""
_ALONG_MM = 0.25
"""Between places of a cutter that take away together what it takes along its way."""
MOST_BEYOND = 0.5
"""Steps of the grid by which a cutter may meet more than the nodes below it."""
_AIR_MM = 22.0
"""Round the grid, more than the radius of a cutter."""
_ONE_MORE = (0, 1)
"""Node of the stock after the last one of the surface, along both axes."""
_SLACK_MM = 1e-3
_TILE = (64, 512)
"""Nodes of a grid along x and y."""
_AT_ONCE = 2
"""Tiles; no result depends on it."""
_MOST_SAMPLES = 1_000_000
"""Nodes under a cutter, at all its places, that are looked at together."""
_LEAST_RAMP_MM = 0.5
"""Depth that is entered from above."""
_MOST_LEGS = 16


class Stock:
    """The block on the nodes of a surface's grid, or every few of them.

    It has a node more along x and y: those of the surface end up to a step before the block's side.

    Parameters
    ----------
    surface
    height_mm
        Of the block.
    line_mm
        Between lines of the surface's grid that must lie on nodes of the stock.
    """

    def __init__(self, surface: Surface, height_mm: float, line_mm: float) -> None:
        line = surface.steps_in(line_mm)
        coarsest = max(round(_PITCH_MM / surface.step_mm), 1)
        self.every = next(n for n in range(coarsest, 0, -1) if line % n == 0)
        self._step_mm = surface.step_mm * self.every
        self._first_mm = surface.first_mm
        self._shape = surface.inside.shape
        coarse = np.pad(surface.inside[:: self.every, :: self.every], _ONE_MORE)
        self._air = air = int(_AIR_MM / self._step_mm)
        self._all = np.pad(
            np.full(coarse.shape, height_mm, np.float32), air, constant_values=-_HIGH_MM
        )
        inner = slice(air, -air)
        self._heights: Float32Array = self._all[inner, inner]
        self._first = air * (self._all.shape[1] + 1)
        self._beyond: Float32Array | None = None

    def sweep(self, tips_mm: FloatArray, active: BoolArray, cutter: Cutter) -> None:
        """Take away what a cutter meets that goes to all active nodes of the surface.

        Parameters
        ----------
        tips_mm, active : (nx, ny)
            Of the surface's grid.
        """
        self._swept, self._sweeper = np.where(active, np.float32(tips_mm), _HIGH_MM), cutter
        tips = np.pad(
            self._swept[:: self.every, :: self.every], _ONE_MORE, constant_values=_HIGH_MM
        )
        if cutter.shape == "flat":
            swept = cv2.erode(
                tips, disc(cutter.radius_mm, self._step_mm),
                borderType=cv2.BORDER_CONSTANT, borderValue=(float(_HIGH_MM),),
            )  # fmt: skip
            np.minimum(self._heights, swept, out=self._heights)
            return
        i, j, above = _under(cutter, self._step_mm)
        # Every other node will do: what is left in the end is looked at again, see `last_swept`.
        few = (i % 2 == 0) & (j % 2 == 0)
        _gather(np.minimum, tips, (i[few], j[few], above[few]), self._heights, _HIGH_MM)

    @property
    def heights_mm(self) -> Float32Array:
        """What is left at every few nodes of the surface's grid, above the block's bottom."""
        return self._heights[:-1, :-1]

    def last_swept(self) -> Float32Array:
        """Return what the last sweep alone has left, at the same nodes as `heights_mm`.

        Other than there with all that the cutter has gone along, between those nodes too.
        """
        left = np.full(self.heights_mm.shape, _HIGH_MM)
        under = _under(self._sweeper, self._step_mm / self.every)
        _gather(np.minimum, self._swept, under, left, _HIGH_MM, every=self.every)
        return left

    def is_wide(self, way_mm: FloatArray, cutter: Cutter, depth_mm: float, width_mm: float) -> bool:
        """Tell whether a cutter cuts deeper than that on a way (n, 3), and somewhere wider."""
        i, j, above = _under(cutter, self._step_mm)
        along = np.diff(way_mm[:, :2], axis=0)
        along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
        most, least = np.full(len(along), -np.inf), np.full(len(along), np.inf)
        for ends in (way_mm[:-1], way_mm[1:]):
            for part in _parts(len(ends), len(i)):
                nodes, low = self._met(ends[part], (i, j, above))
                deep = self._all.reshape(-1)[nodes] - low > depth_mm
                across = along[part, :1] * j - along[part, 1:] * i
                most[part] = across.max(axis=1, where=deep, initial=-np.inf).clip(most[part])
                least[part] = across.min(axis=1, where=deep, initial=np.inf).clip(max=least[part])
        return bool(((most - least + 1) * self._step_mm > width_mm).any())

    def cut(self, path_mm: FloatArray, cutter: Cutter) -> None:
        """Take away what a cutter meets on a path (n, 3) of its tip."""
        path, heights = densified(path_mm, _ALONG_MM), self._all.reshape(-1)
        for way, under in self._newly_under(path, cutter):
            for part in _parts(len(way), len(under[0])):
                nodes, low = self._met(way[part], under)
                np.minimum.at(heights, nodes.ravel(), low.ravel().astype(np.float32))

    def _newly_under(
        self, path_mm: FloatArray, cutter: Cutter
    ) -> Iterator[tuple[FloatArray, tuple[IntArray, IntArray, FloatArray]]]:
        """Yield all places (n, 3) of a path, with those offsets under a cutter that are new there.

        A flat one that goes on to the next node at the same height is over most of them already.
        """
        i, j, above = _under(cutter, self._step_mm)
        here = np.pad(disc(cutter.radius_mm, self._step_mm), 1)
        middle, nodes = len(here) // 2, self._nodes(path_mm)
        steps = np.diff(nodes, axis=0, prepend=nodes[:1])
        goes_on = np.diff(path_mm[:, 2], prepend=np.inf) == 0
        goes_on &= (np.abs(steps).max(axis=1) <= 1) & (cutter.shape == "flat")
        yield path_mm[~goes_on], (i, j, above)
        for step in np.argwhere(np.ones((3, 3))) - 1:
            new = here[middle + i + step[0], middle + j + step[1]] == 0
            way = path_mm[goes_on & (steps == step).all(axis=1)]
            yield way, (i[new], j[new], above[new])

    def over(self, places_mm: FloatArray, cutter: Cutter, beside: float = 0.0) -> FloatArray:
        """Return the lowest tip (n,) of a cutter at places (n, 2 or 3) that meets nothing.

        Parameters
        ----------
        beside
            Steps of the grid by which the cutter is taken wider: with 1 it also meets what lies
            between two nodes.
        """
        under = _under(_wider(cutter, beside * self._step_mm), self._step_mm)
        flat, tips = np.pad(places_mm[:, :2], ((0, 0), (0, 1))), np.empty(len(places_mm))
        for part in _parts(len(flat), len(under[0])):
            nodes, above = self._met(flat[part], under)
            tips[part] = (self._all.reshape(-1).take(nodes) - above).max(axis=1)
        return tips

    def go_along_walls(self, beyond: Float32Array) -> None:
        """Take what is written from now on as beside the walls of a piece.

        Parameters
        ----------
        beyond : (nx, ny) float32
            Steps of the stock's grid by which the cutter meets more than the nodes below it, at the
            nodes of the surface's grid: at most `MOST_BEYOND`, and -inf at those of the piece.
        """
        self._beyond = np.full(self._all.shape, -np.inf, np.float32)
        inner = slice(self._air, -self._air)
        self._beyond[inner, inner] = np.pad(
            beyond[:: self.every, :: self.every], _ONE_MORE, mode="edge"
        )

    def depths(self, way_mm: FloatArray, cutter: Cutter) -> FloatArray:
        """Return how deep (n,) a cutter cuts at points (n, 3) of its tip."""
        if self._beyond is None:
            return self.over(way_mm, cutter) - way_mm[:, 2]
        i, j, above = _under(_wider(cutter, MOST_BEYOND * self._step_mm), self._step_mm)
        across = np.hypot(i, j) - cutter.radius_mm / self._step_mm
        heights, beyond = self._all.reshape(-1), self._beyond.reshape(-1)
        depths = np.empty(len(way_mm))
        for part in _parts(len(way_mm), len(i)):
            nodes, low = self._met(way_mm[part], (i, j, above))
            met = across <= beyond.take(nodes)
            depths[part] = (heights.take(nodes) - low).max(axis=1, where=met, initial=0.0)
        return depths

    def meets(self, cutter: Cutter, tip_mm: float) -> BoolArray:
        """Find the nodes (nx, ny) of the surface's grid where a tip so low meets something."""
        if cutter.shape != "flat":
            return np.asarray(self.free_tips(cutter) > tip_mm)
        higher = np.asarray(self._heights > tip_mm, np.uint8)
        met = cv2.dilate(higher, disc(cutter.radius_mm, self._step_mm))
        return self._on_surface(met) > 0

    def free_tips(self, cutter: Cutter) -> Float32Array:
        """Return the lowest tips (nx, ny) that meet nothing, at the nodes of the surface's grid."""
        if cutter.shape == "flat":
            tips = cv2.dilate(self._heights, disc(cutter.radius_mm, self._step_mm))
        else:
            i, j, above = _under(cutter, self._step_mm)
            tips = np.full(self._heights.shape, -_HIGH_MM, np.float32)
            _gather(np.maximum, self._heights, (i, j, -above), tips, -_HIGH_MM)
        return np.asarray(self._on_surface(tips), np.float32)

    def _on_surface(self, values: NDArray[_Value]) -> NDArray[_Value]:
        """Return values of the stock's nodes at those (nx, ny) of the surface's grid."""
        if self.every > 1:
            values = values.repeat(self.every, axis=0).repeat(self.every, axis=1)
        return values[: self._shape[0], : self._shape[1]]

    def write(
        self,
        way_mm: FloatArray,
        writer: PathWriter,
        cutter: Cutter,
        step_down_mm: float,
    ) -> None:
        """Write a way (n, 3) of the tip after what leads to it, and take away what it meets."""
        depth_mm = self.depths(way_mm, cutter)
        ways = _layers(way_mm, depth_mm, step_down_mm)
        for way in ways:
            own_mm = depth_mm if len(ways) == 1 else self.depths(way, cutter)
            whole = entered(way, way[:, 2] + own_mm)
            clear_mm = self._clear_mm(way[0], cutter) + 2 * CLEARANCE_MM
            writer.start(without_collinear(whole), clear_mm)
            self.cut(way, cutter)

    def _clear_mm(self, place_mm: FloatArray, cutter: Cutter) -> float:
        """Return the lowest tip of a cutter at a place (3,) that meets nothing, nor does beside it.

        A finished wall, which the cutter goes along, is met nowhere but below it.
        """
        if self._beyond is None:
            return float(self.over(place_mm[None], cutter, 1.0)[0])
        place = (place_mm[:2] - self._first_mm) / self._step_mm
        radius = (cutter.radius_mm + _SLACK_MM) / self._step_mm
        low = np.floor(place - radius - 1).astype(int)
        around = tuple(slice(n + self._air, n + self._air + int(2 * radius) + 4) for n in low)
        heights, more = self._all[around], np.ceil(self._beyond[around])
        x, y = np.ogrid[: heights.shape[0], : heights.shape[1]]
        across = np.hypot(low[0] + x - place[0], low[1] + y - place[1])
        return float(heights[across <= radius + more].max(initial=0.0))

    def _met(
        self, path_mm: FloatArray, under: tuple[IntArray, IntArray, FloatArray]
    ) -> tuple[IntArray, FloatArray]:
        """Return the nodes (n, k) under a cutter along a path, and its heights over them."""
        i, j, above = under
        x, y = self._nodes(path_mm).T
        row = self._all.shape[1]
        return (self._first + x * row + y)[:, None] + (i * row + j), path_mm[:, 2:] + above

    def _nodes(self, path_mm: FloatArray) -> IntArray:
        """Return the nodes (n, 2) nearest to the axis of a cutter along a path."""
        middle = np.rint((path_mm[:, :2] - self._first_mm) / self._step_mm).astype(int)
        return np.asarray(np.clip(middle, 0, np.array(self._heights.shape) - 1))


def _gather(
    least: np.ufunc,
    heights: Float32Array,
    under: tuple[IntArray, IntArray, FloatArray],
    into: Float32Array,
    beyond: np.float32,
    *,
    every: int = 1,
) -> None:
    """Take the least, or greatest, of heights round each node, each with what is added.

    In tiles, which a processor keeps at hand. Where all heights are the same, they are least and
    greatest as well: in the middle nothing is added.

    Parameters
    ----------
    into : (nx, ny)
        At every few nodes of `heights`.
    """
    reach = int(max(np.abs(under[0]).max(), np.abs(under[1]).max()))
    ring = np.pad(heights, reach, constant_values=beyond)
    offsets = [(int(i), int(j), np.float32(more)) for i, j, more in zip(*under, strict=True)]

    def take(tile: tuple[slice, slice]) -> None:
        own = into[tile]
        x, y = (every * side.start for side in tile)
        nx, ny = (every * size for size in own.shape)
        around = ring[x : x + nx + 2 * reach, y : y + ny + 2 * reach]
        if (around == around[0, 0]).all():
            least(own, around[0, 0], out=own)
            return
        level = np.empty_like(own)
        for i, j, more in offsets:
            row, column = reach + i, reach + j
            near = around[row : row + nx : every, column : column + ny : every]
            np.add(near, more, out=level)
            least(own, level, out=own)

    with ThreadPoolExecutor(_AT_ONCE) as pool:
        for _ in pool.map(take, _tiles(into.shape)):
            pass


def _tiles(shape: tuple[int, ...]) -> list[tuple[slice, slice]]:
    """Return the parts of a grid (nx, ny) that are looked at one by one."""
    rows, columns = (range(0, size, tile) for size, tile in zip(shape, _TILE, strict=True))
    return [(slice(i, i + _TILE[0]), slice(j, j + _TILE[1])) for i in rows for j in columns]


def _wider(cutter: Cutter, by_mm: float) -> Cutter:
    return replace(cutter, diameter_mm=cutter.diameter_mm + 2 * by_mm)


def _parts(places: int, under: int) -> Iterator[slice]:
    """Yield the places of a cutter, with so many nodes under it, that are looked at together."""
    step = max(_MOST_SAMPLES // max(under, 1), 1)
    return (slice(begin, begin + step) for begin in range(0, places, step))


def _under(cutter: Cutter, step_mm: float) -> tuple[IntArray, IntArray, FloatArray]:
    """Return the offsets (k,) of nodes under a cutter, and its heights there above its tip."""
    i, j = np.nonzero(disc(cutter.radius_mm, step_mm))
    reach = int(cutter.radius_mm / step_mm)
    i, j = i - reach, j - reach
    if cutter.shape == "flat":
        return i, j, np.zeros(len(i))
    across2 = (i * i + j * j) * step_mm**2
    return i, j, cutter.radius_mm - np.sqrt(np.maximum(cutter.radius_mm**2 - across2, 0))


def _layers(way_mm: FloatArray, depth_mm: FloatArray, step_down_mm: float) -> list[FloatArray]:
    """Return ways (n, 3) that lead to a way of the tip with no cut deeper than a step.

    Those before the last one lie above it, where there is more than a step to take away.

    Parameters
    ----------
    depth_mm : (n,) float64
        That is cut.
    """
    count = int(np.ceil(depth_mm.max() / step_down_mm - _SAME))
    ways: list[FloatArray] = []
    for above in range(count - 1, 0, -1):
        raised = way_mm + np.array([0.0, 0.0, above * step_down_mm])
        ways += pieces_of(raised, widened(depth_mm > (above + _SAME) * step_down_mm, _LONGER))
    return [*ways, way_mm]


def widened(kept: BoolArray, by: int) -> BoolArray:
    """Return points (n,) of a way with those that are next to them."""
    return np.asarray(cv2.dilate(kept.astype(np.uint8)[None], np.ones((1, 2 * by + 1)))[0] > 0)


def pieces_of(way_mm: FloatArray, kept: BoolArray) -> list[FloatArray]:
    """Return the pieces of a way (n, d) with more than one of the points that are kept."""
    edges = np.diff(np.pad(kept.astype(np.int8), 1))
    starts, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return [way_mm[a:b] for a, b in zip(starts, ends, strict=True) if b - a > 1]


def runs_of_closed(ring_mm: FloatArray, kept: BoolArray) -> list[FloatArray]:
    """Return the pieces of a closed way (n, d), whose last point is not the first one again.

    Where all of it is kept, it is returned with its first point at the end.
    """
    if kept.all():
        return [np.concatenate([ring_mm, ring_mm[:1]])]
    gap = int(np.flatnonzero(~kept)[0])
    return pieces_of(np.roll(ring_mm, -gap, axis=0), np.roll(kept, -gap))


def entered(way_mm: FloatArray, top_mm: FloatArray) -> FloatArray:
    """Return a way (n, 3) that goes down on ramps to what it meets, to and fro at its beginning.

    On ways that are too short for that it plunges.

    Parameters
    ----------
    top_mm : (n,) float64
        Lowest tip that meets nothing.
    """
    along = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(way_mm[:, :2], axis=0), axis=1)))
    from_mm = float(top_mm[along <= (top_mm[0] - way_mm[0, 2]) / RAMP].max(initial=top_mm[0]))
    depth_mm = from_mm - float(way_mm[0, 2])
    if depth_mm < _LEAST_RAMP_MM:
        return way_mm
    needed_mm = depth_mm / RAMP
    end = min(int(np.searchsorted(along, needed_mm)), len(way_mm) - 1)
    legs = int(np.ceil(needed_mm / along[end] - _SAME)) if along[end] > 0 else _MOST_LEGS + 1
    if legs > _MOST_LEGS:
        return way_mm
    forth = np.arange(end + 1)
    nodes = np.concatenate([forth[:: -1 if leg % 2 else 1] for leg in range(legs)])
    fallen = np.cumsum(np.abs(np.diff(along[nodes], prepend=0.0))) * RAMP
    ramp = way_mm[nodes].copy()
    ramp[:, 2] = np.maximum(ramp[:, 2], from_mm - fallen)
    back = way_mm[end::-1] if legs % 2 else way_mm[:0]
    return np.concatenate([ramp, back, way_mm])
