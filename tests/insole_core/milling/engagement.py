"""How deep every move of a plan cuts: the block as a height field, from which moves take away."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from insole_core.milling.machine import Machine
from insole_core.milling.plan import MillingPlan
from insole_core.milling.tool_path import Motion, Operation
from tests.insole_core.milling.removal import along

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
_PITCH_MM, _SAMPLE_MM, _SAMPLES = 0.5, 0.25, 20_000


@dataclass(frozen=True, eq=False)
class Moves:
    """The moves (n,) of an operation: what each takes away at its deepest, and where it goes.

    Its width is that across its way, of what it cuts deeper than a slot may be.
    """

    operation: Operation
    machine: Machine
    depth_mm: FloatArray
    width_mm: FloatArray
    way_mm: FloatArray

    @property
    def cuts(self) -> npt.NDArray[np.bool_]:
        """Whether a move may take something away."""
        return self.operation.motion[1:] != Motion.RAPID

    @property
    def plunges(self) -> npt.NDArray[np.bool_]:
        """Whether a move goes down into solid by more than 1 mm, steeper than 3 in 1."""
        x, y, z = self.way_mm.T
        return self.cuts & (self.depth_mm > 1) & (z < -1) & (-z > 3 * np.hypot(x, y))

    @property
    def fast_plunges(self) -> npt.NDArray[np.bool_]:
        """Whether it does so at cutting feed."""
        return self.plunges & (self.operation.motion[1:] == Motion.FEED)

    @property
    def too_deep(self) -> npt.NDArray[np.bool_]:
        """Whether a move cuts deeper than a step, but for what a pixel may be off."""
        how = self.machine.contour if self.operation.name == "contour" else self.machine.roughing
        return self.cuts & (self.depth_mm >= how.step_down_mm + 0.1)

    @property
    def too_wide(self) -> npt.NDArray[np.bool_]:
        """Whether it cuts wider than it may, but for what a pixel may be off."""
        return self.cuts & (self.width_mm > self.machine.roughing.width_mm + _PITCH_MM)

    @property
    def above_flutes(self) -> npt.NDArray[np.bool_]:
        """Whether the shank cuts."""
        return self.depth_mm > self.operation.cutter.flute_mm


def moves_of(plan: MillingPlan) -> list[Moves]:
    counts = [round(size / _PITCH_MM) for size in plan.block_mm[:2]]
    left, void = np.full(counts, plan.block_mm[2]), np.zeros(counts)
    found: list[Moves] = []
    for operation in plan.operations:
        if found and operation.side != found[-1].operation.side:
            axis = 0 if plan.machine.both_sides.flip == "length" else 1
            void = np.flip(plan.block_mm[2] - left, axis)
            left = np.full(counts, plan.block_mm[2])
        found.append(_cut(operation, plan.machine, left, void))
    return found


def _cut(
    operation: Operation, machine: Machine, heights_mm: FloatArray, void_mm: FloatArray
) -> Moves:
    way = np.diff(operation.points_mm, axis=0)
    points = operation.points_mm
    move, samples = along(points[:-1], points[1:], np.linalg.norm(way, axis=1) / _SAMPLE_MM)
    depth, sides = np.zeros(len(way)), np.full((2, len(way)), -np.inf)
    for part in _whole_moves(move):
        of, place, taken = _take(operation, heights_mm, void_mm, samples[part], move[part])
        np.maximum.at(depth, of, taken)
        deep = taken > machine.roughing.slot_mm + 0.1
        of, off = of[deep], place[deep] - points[of[deep], :2]
        size = np.maximum(np.hypot(way[of, 0], way[of, 1]), 1e-9)
        across = (off[:, 1] * way[of, 0] - off[:, 0] * way[of, 1]) / size
        np.maximum.at(sides[0], of, across)
        np.maximum.at(sides[1], of, -across)
    return Moves(operation, machine, depth, sides.sum(axis=0) + _PITCH_MM, way)


def _whole_moves(move: IntArray) -> Iterator[slice]:
    begin = 0
    while begin < len(move):
        last = move[min(begin + _SAMPLES, len(move)) - 1]
        end = int(np.searchsorted(move, last, "right"))
        yield slice(begin, end)
        begin = end


def _take(
    operation: Operation,
    heights_mm: FloatArray,
    void_mm: FloatArray,
    samples: FloatArray,
    move: IntArray,
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Lower the heights (nx, ny); return the moves (n,), places and depths of what was taken."""
    radius, reach = operation.cutter.radius_mm, int(operation.cutter.radius_mm / _PITCH_MM) + 1
    i, j = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    x, y = (np.floor(samples[:, axis] / _PITCH_MM).astype(int) for axis in (0, 1))
    a, b = x[:, None, None] + i, y[:, None, None] + j
    distance2 = ((a + 0.5) * _PITCH_MM - samples[:, 0, None, None]) ** 2
    distance2 += ((b + 0.5) * _PITCH_MM - samples[:, 1, None, None]) ** 2
    hit = (distance2 <= radius**2) & (a >= 0) & (b >= 0)
    hit &= (a < heights_mm.shape[0]) & (b < heights_mm.shape[1])
    above = 0.0
    if operation.cutter.shape == "ball":
        above = radius - np.sqrt(np.maximum(radius**2 - distance2, 0))
    low = np.broadcast_to(samples[:, 2, None, None] + above, hit.shape)[hit]
    pixel, of = (a * heights_mm.shape[1] + b)[hit], np.broadcast_to(move[:, None, None], hit.shape)
    of = of[hit]
    order = np.argsort(pixel, kind="stable")  # the moves of each pixel stay in their order
    pixel, low, of = pixel[order], low[order], of[order]
    begins = np.ones(len(pixel), bool)
    begins[1:] = (pixel[1:] != pixel[:-1]) | (of[1:] != of[:-1])
    begins = np.flatnonzero(begins)
    pixel, low, of = pixel[begins], np.minimum.reduceat(low, begins), of[begins]
    first = np.append(True, pixel[1:] != pixel[:-1])
    block = np.cumsum(first) * 1e4  # keeps the minimum within one pixel
    running = np.minimum.accumulate(low - block) + block
    flat = heights_mm.ravel()
    before = np.where(first, np.inf, np.append(np.inf, running[:-1]))
    taken = np.minimum(before, flat[pixel]) - np.maximum(low, void_mm.ravel()[pixel])
    ends = np.append(first[1:], True)
    flat[pixel[ends]] = np.minimum(flat[pixel[ends]], running[ends])
    place = (np.column_stack(np.divmod(pixel, heights_mm.shape[1])) + 0.5) * _PITCH_MM
    return of, place, taken
