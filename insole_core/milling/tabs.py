"""Tabs: where material stays between a piece and its block, until it is taken out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray
from insole_core.geometry.height_map import disc
from insole_core.milling.machine import Contour, Machine
from insole_core.milling.surface import Surface
from insole_core.milling.tool_path import PITCH_MM, densified

_RIM_MM = 0.75
"""From the outline to the top of a wall."""
_BELOW_RIM_MM = 0.6
"""By which a tab stays below that, so that the ball leaves an edge clean that slopes down."""
_PER_MM = 0.005
"""Thickness for which a tab is moved by a millimetre."""
_FLANK = 0.15
"""By which a tab grows along the wall on either side, per way down."""
_FRAME_MM = 1.0
"""Of the block that holds a tab."""
OFF_EDGE_MM = 0.3
"""By which a tab begins off the edge of the underside, so that the ball leaves the edge clean."""


@dataclass(frozen=True, eq=False)
class Tabs:
    """Where a cutter leaves material between the pieces and the block.

    Parameters
    ----------
    places_mm : (n, 2) float64
        On the way of the contour cutter's axis.
    heights_mm : (nx, ny) float32
        To which a cutter may go down there, on the nodes of the surface, above the block's bottom.
    thickness_mm : (n,) float64
        Of what stays of each in the end.
    """

    places_mm: FloatArray
    heights_mm: Float32Array
    how: Contour
    thickness_mm: FloatArray

    def begun_at(self, edge_mm: Float32Array) -> Tabs:
        """Return the tabs as the turned block leaves them: a little below the edge (nx, ny)."""
        return replace(self, heights_mm=edge_mm - np.float32(OFF_EDGE_MM))

    def over(self, surface: Surface, floor_mm: float | Float32Array) -> Float32Array:
        """Return heights (nx, ny) beside the solids, raised where a tab stays."""
        floor = np.full(surface.inside.shape, floor_mm, np.float32)
        within = self._near(
            surface, np.hypot(self.how.tab_length_mm / 2, self.how.cutter.radius_mm)
        )
        floor[within] = np.maximum(floor, self.heights_mm)[within]
        return floor

    def axis_heights(self, surface: Surface) -> Float32Array:
        """Return the lowest heights (nx, ny) of the contour cutter's axis; -inf off the tabs."""
        within = self._near(surface, self.how.tab_length_mm / 2 + self.how.cutter.radius_mm)
        return np.where(within, self.heights_mm, np.float32(-np.inf))

    def over_way(self, line_mm: FloatArray, level_mm: float, surface: Surface) -> FloatArray:
        """Return a way (n, 2) of the contour cutter's axis at a height, and over the tabs (m, 3).

        It rises and falls upright, lower down a little farther from a tab, so that there no level
        meets what those above it have left.
        """
        away = np.asarray(scipy.spatial.cKDTree(self.places_mm).query(line_mm)[0])
        high = np.maximum(self.heights_mm[surface.index_of(line_mm)], level_mm)
        reach = self.how.tab_length_mm / 2 + self.how.cutter.radius_mm
        beyond = away - reach - _FLANK * (high - level_mm)
        at = np.flatnonzero((beyond[1:] < 0) != (beyond[:-1] < 0))
        share = (beyond[at] / (beyond[at] - beyond[at + 1]))[:, None]
        ends = line_mm[at] * (1 - share) + line_mm[at + 1] * share
        heights = np.where(beyond < 0, high, level_mm)
        foot_and_top = np.stack([heights[at], heights[at + 1]], axis=1).ravel()
        twice = np.repeat(at + 1, 2)
        return np.insert(
            np.column_stack([line_mm, heights]), twice,
            np.column_stack([np.repeat(ends, 2, axis=0), foot_and_top]), axis=0,
        )  # fmt: skip

    def _near(self, surface: Surface, reach_mm: float) -> BoolArray:
        marked = np.zeros(surface.inside.shape, np.uint8)
        for i, j in zip(*surface.index_of(self.places_mm), strict=True):
            cv2.circle(marked, (int(j), int(i)), round(reach_mm / surface.step_mm), 1, cv2.FILLED)
        return marked > 0


def tabs_of_foot_side(
    surface: Surface,
    outlines_mm: Sequence[FloatArray],
    begin_mm: Float32Array,
    machine: Machine,
) -> Tabs:
    """Return tabs as thick as the machine asks for, and no higher than the piece.

    They are spread evenly along each outline, but for moves to where they are thicker.

    Parameters
    ----------
    outlines_mm : (n, 2) float64 each
        Ways of the contour cutter's axis round the solids.
    begin_mm : (nx, ny) float32
        Height at which a tab begins beside each node.
    """
    high = _tab_tops(surface, begin_mm, machine)
    chosen = [_places(each, surface, begin_mm, high, machine) for each in outlines_mm]
    places, thickness = (np.concatenate(each) for each in zip(*chosen, strict=True))
    return Tabs(places, high, machine.contour, thickness)


def _tab_tops(surface: Surface, begin_mm: Float32Array, machine: Machine) -> Float32Array:
    """Return the heights (nx, ny) to which tabs go.

    A flat cutter that follows an edge up and down takes away from both ends of a tab, above and
    below; it goes as much higher there, below the rim.
    """
    inside = np.where(surface.inside, surface.heights_mm, np.float32(0))
    rim = surface.beyond_rim(
        np.asarray(cv2.dilate(inside, disc(_RIM_MM, surface.step_mm)), np.float32)
    )
    beside = np.where(surface.inside, np.float32(0), begin_mm)
    around = cv2.dilate(beside, disc(machine.contour.cutter.diameter_mm, surface.step_mm))
    below_rim = np.maximum(rim - np.float32(_BELOW_RIM_MM), (begin_mm + rim) / 2)
    high = np.minimum(around + np.float32(machine.contour.tab_height_mm), below_rim)
    return np.asarray(high, np.float32)


def _held(line_mm: FloatArray, surface: Surface, machine: Machine) -> BoolArray:
    """Find the points (n,) of a way round a solid beyond which some of the block stays.

    A tab between a piece and the side of the block, or another piece, would hold nothing.
    """
    cutter = machine.contour.cutter
    along = np.roll(line_mm, -1, axis=0) - np.roll(line_mm, 1, axis=0)
    outwards = np.column_stack([along[:, 1], -along[:, 0]])
    outwards /= np.maximum(np.linalg.norm(outwards, axis=1, keepdims=True), 1e-9)
    beyond = line_mm + (cutter.radius_mm + _FRAME_MM) * outwards
    node = (beyond - surface.first_mm) / surface.step_mm
    within = ((node >= 0) & (node <= np.array(surface.inside.shape) - 1)).all(axis=1)
    free_mm = surface.beside_mm[surface.index_of(beyond)]
    return np.asarray(within & (free_mm > cutter.diameter_mm))


def _places(
    outline_mm: FloatArray,
    surface: Surface,
    begin_mm: Float32Array,
    high_mm: Float32Array,
    machine: Machine,
) -> tuple[FloatArray, FloatArray]:
    """Return places (n, 2) of tabs along an outline, and how thick (n,) they stay."""
    how = machine.contour
    line = densified(outline_mm)[:-1]
    along = np.append(0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1)))
    count = min(how.tabs, int(along[-1] / (2 * (how.tab_length_mm + how.cutter.diameter_mm))))
    if not count:
        return np.empty((0, 2)), np.empty(0)
    apart_mm = along[-1] / count
    most_mm = (apart_mm - how.tab_length_mm - how.cutter.diameter_mm) / 2
    node = surface.index_of(line)
    width = 2 * round(how.cutter.radius_mm / PITCH_MM) + 1
    top = scipy.ndimage.minimum_filter1d(high_mm[node], width, mode="wrap")
    bottom = scipy.ndimage.maximum_filter1d(begin_mm[node], width, mode="wrap")
    thickness = np.clip(top - bottom, 0, how.tab_height_mm).astype(float)
    thickness *= scipy.ndimage.minimum_filter1d(_held(line, surface, machine), width, mode="wrap")
    chosen = []
    for middle in apart_mm * (np.arange(count) + 0.5):
        off = np.abs(along - middle)
        worth = np.where(off <= most_mm, thickness - _PER_MM * off, -np.inf)
        chosen.append(int(worth.argmax()))
    return line[chosen], thickness[chosen]
