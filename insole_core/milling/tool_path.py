"""Tool paths: values, the joining of runs to one path, and how long a machine takes along it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Literal, TypeAlias

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.milling.machine import Cutter, Machine

_CORNER_MM = 0.01
"""GRBL's junction deviation; the tolerance that our programs give LinuxCNC (`G64 P0.01`)."""
OperationName: TypeAlias = Literal["dowels", "roughing", "finishing", "contour"]
_STRAIGHT = 1e-9
"""One minus the cosine between pieces of a straight line."""
RAMP = 0.5
"""Fall per way, 27 degrees, at which a cutter goes into what is solid."""
CLEARANCE_MM = 1.0
"""Above material that is known to be gone, down to which a rapid move goes."""
PITCH_MM = 0.5
"""Between the points of a way that is looked at point by point."""
LINK_MM = 12.0
"""Longest way within the block from one run to another that is quicker than above it."""
_STEEP = 3.0
"""Fall per way, 72 degrees, from which a cutter plunges."""
SideName: TypeAlias = Literal["foot side", "underside", "spoil board"]
"""Of the block, which is milled; or the board below it, which is bored before it lies there."""


def motion_minutes(
    points_mm: FloatArray, speed_mm_min: FloatArray, acceleration_mm_s2: FloatArray
) -> FloatArray:
    """Return the time of each piece of a path that begins and ends at rest.

    Parameters
    ----------
    points_mm : (n, 3) float64
        Along the axes of the machine.
    speed_mm_min : (n - 1,) float64
        At which each piece is ordered.
    acceleration_mm_s2 : (3,) float64
        Of the axes.

    Returns
    -------
    (n - 1,) float64, min
        0 for a piece without length.
    """
    pieces = np.diff(points_mm, axis=0)
    length_mm = np.linalg.norm(pieces, axis=1)
    minutes = np.zeros(len(length_mm))
    moves = length_mm > 0
    if moves.any():
        along = pieces[moves] / length_mm[moves, None]
        seconds = _seconds(length_mm[moves], along, speed_mm_min[moves] / 60, acceleration_mm_s2)
        minutes[moves] = seconds / 60
    return minutes


def _seconds(
    length_mm: FloatArray, along: FloatArray, speed_mm_s: FloatArray, acceleration_mm_s2: FloatArray
) -> FloatArray:
    """Return the time in s of pieces (m,) with unit directions (m, 3) and ordered speeds (m,)."""
    acceleration = _least_over_axes(acceleration_mm_s2, along)
    corner2 = _corner_speeds2(along, speed_mm_s, acceleration_mm_s2)
    ends2 = _reached(corner2, 2 * acceleration * length_mm)
    enter, leave = np.sqrt(ends2[:-1]), np.sqrt(ends2[1:])
    peak = np.minimum(np.sqrt(acceleration * length_mm + (ends2[:-1] + ends2[1:]) / 2), speed_mm_s)
    ramps_mm = (2 * peak**2 - ends2[:-1] - ends2[1:]) / (2 * acceleration)
    level_mm = np.maximum(length_mm - ramps_mm, 0)
    return np.asarray((2 * peak - enter - leave) / acceleration + level_mm / peak)


def _least_over_axes(limit: FloatArray, along: FloatArray) -> FloatArray:
    """Return the greatest value (m,) along directions (m, 3) with no axis beyond its limit."""
    share = np.maximum(np.abs(along), 1e-9)
    return np.asarray((limit / share).min(axis=1))


def _corner_speeds2(
    along: FloatArray, speed_mm_s: FloatArray, acceleration_mm_s2: FloatArray
) -> FloatArray:
    """Return the squared speeds (m + 1,), mm²/s², that corners allow; both ends are at rest."""
    before, after = along[:-1], along[1:]
    # Sine of half the angle between the pieces: 1 goes straight on, 0 turns back.
    straight = np.sqrt(np.clip((1 + (before * after).sum(axis=1)) / 2, 0, 1))
    change = after - before
    size = np.linalg.norm(change, axis=1)
    across = np.divide(change, size[:, None], out=np.ones_like(change), where=size[:, None] > 0)
    acceleration = _least_over_axes(acceleration_mm_s2, across)
    slack = np.maximum(1 - straight, 1e-12)
    allowed2 = acceleration * _CORNER_MM * straight / slack
    slower = np.minimum(speed_mm_s[:-1], speed_mm_s[1:])
    return np.concatenate([[0.0], np.minimum(allowed2, slower**2), [0.0]])


def _reached(corner2: FloatArray, gained2: FloatArray) -> FloatArray:
    """Return the squared speeds (m + 1,), mm²/s², at the ends of pieces.

    Parameters
    ----------
    corner2 : (m + 1,) float64, mm²/s²
        Allowed at the ends.
    gained2 : (m,) float64, mm²/s²
        By which the squared speed may grow, or fall, along each piece.

    u[i] = min(corner2[i], u[i - 1] + gained2[i - 1]), then the same from the end: the least, over
    all corners passed before, of what that corner allowed and all that was gained since.
    """

    def onwards(limit2: FloatArray, gain2: FloatArray) -> FloatArray:
        total = np.concatenate([[0.0], np.cumsum(gain2)])
        return np.asarray(np.minimum.accumulate(limit2 - total) + total)

    forth = onwards(corner2, gained2)
    back = onwards(forth[::-1], gained2[::-1])[::-1]
    return np.asarray(np.clip(back, 0, None))


class Motion(IntEnum):
    """How the machine moves to a point."""

    RAPID = 0
    PLUNGE = 1
    FEED = 2


@dataclass(frozen=True, eq=False)
class Operation:
    """What one cutter does without interruption.

    Parameters
    ----------
    side
        Of the piece, which lies up.
    points_mm : (n, 3) float64
        Of the tip, in the frame of the block as it lies. The first is at safe height.
    motion : (n,) int64
        `Motion` to each point.
    """

    name: OperationName
    side: SideName
    cutter: Cutter
    points_mm: FloatArray
    motion: IntArray

    def lengths_mm(self, motion: Motion) -> float:
        """Return the length of the path of one kind of motion."""
        length = np.linalg.norm(np.diff(self.points_mm, axis=0), axis=1)
        return float(length[self.motion[1:] == motion].sum())

    def minutes(self, machine: Machine) -> float:
        """Return the time of the path, with what the machine needs to change its speed."""
        speed = np.zeros(len(Motion))
        speed[Motion.RAPID] = machine.rapid_mm_min
        speed[Motion.PLUNGE] = self.cutter.plunge_mm_min
        speed[Motion.FEED] = self.cutter.feed_mm_min
        order = [1, 0, 2] if machine.length_along == "x" else [0, 1, 2]
        acceleration = np.array(machine.acceleration_mm_s2)[order]
        return float(motion_minutes(self.points_mm, speed[self.motion[1:]], acceleration).sum())


class PathWriter:
    """Puts runs of a cutter together, above the block between them.

    Parameters
    ----------
    safe_mm
        Height of rapid moves across.
    """

    def __init__(self, safe_mm: float) -> None:
        self._safe_mm = safe_mm
        self._points: list[FloatArray] = []
        self._motion: list[IntArray] = []

    @property
    def is_empty(self) -> bool:
        """Whether there is no run yet."""
        return not self._points

    @property
    def last_mm(self) -> FloatArray:
        """(3,) where the cutter is."""
        return np.asarray(self._points[-1][-1])

    def start(self, run_mm: FloatArray, clear_mm: float | None = None) -> None:
        """Go to a run (n, 3) above the block, and follow it.

        Parameters
        ----------
        clear_mm
            Down to this height the place of its start is known to be free.
        """
        if not self.is_empty:
            self._leave()
        above = run_mm[0].copy()
        above[2] = self._safe_mm
        self._add(above[None], Motion.RAPID)
        if clear_mm is not None and run_mm[0, 2] < clear_mm < self._safe_mm:
            above[2] = clear_mm
            self._add(above[None], Motion.RAPID)
        self._add(run_mm[:1], Motion.PLUNGE)
        self._add(run_mm[1:], Motion.FEED)

    def go_on(self, run_mm: FloatArray) -> None:
        """Follow a run (n, 3) from where the cutter is."""
        self._add(run_mm, Motion.FEED)

    def _leave(self) -> None:
        up = self._points[-1][-1].copy()
        up[2] = self._safe_mm
        self._add(up[None], Motion.RAPID)

    def _add(self, points_mm: FloatArray, motion: Motion) -> None:
        kinds = np.full(len(points_mm), int(motion))
        if motion is Motion.FEED:
            way = np.diff(np.concatenate([self._points[-1][-1:], points_mm]), axis=0)
            kinds[-way[:, 2] > _STEEP * np.hypot(way[:, 0], way[:, 1])] = Motion.PLUNGE
            moves = way.any(axis=1)
            points_mm, kinds = points_mm[moves], kinds[moves]
        if len(points_mm):
            self._points.append(np.array(points_mm, float))
            self._motion.append(kinds)

    def operation(self, name: OperationName, side: SideName, cutter: Cutter) -> Operation:
        """Return what was written, ending above the block."""
        self._leave()
        return Operation(
            name, side, cutter, np.concatenate(self._points), np.concatenate(self._motion)
        )


def needed_nodes(heights_mm: FloatArray, active: BoolArray, most_mm: float) -> BoolArray:
    """Find the nodes of rasters that straight pieces between them follow closely enough.

    Parameters
    ----------
    heights_mm : (k, n) float64
        At evenly spaced nodes of each line.
    active : (k, n) bool
        The nodes of the path; the ends of its runs are needed.
    most_mm
        By which a straight piece may leave the nodes it passes.

    Returns
    -------
    (k, n) bool
    """
    nodes = np.where(active, heights_mm, np.nan)
    needed = active.copy()
    span = 2
    while span < nodes.shape[1]:
        blocks = (nodes.shape[1] - 1) // span
        if not blocks:
            break
        starts = span * np.arange(blocks)
        inner = np.arange(1, span)
        first, last = nodes[:, starts, None], nodes[:, starts + span, None]
        passed = nodes[:, : blocks * span].reshape(len(nodes), blocks, span)[:, :, 1:]
        straight = first + (last - first) * (inner / span)
        close = (np.abs(passed - straight) <= most_mm).all(axis=2)
        if not close.any():
            break
        line, block = np.nonzero(close)
        needed[line[:, None], starts[block][:, None] + inner] = False
        span *= 2
    return needed


def densified(line_mm: FloatArray, pitch_mm: float = PITCH_MM) -> FloatArray:
    """Return a polyline (n, d) with points at most a pitch apart."""
    pieces = np.ceil(np.linalg.norm(np.diff(line_mm, axis=0), axis=1) / pitch_mm).astype(int)
    edge = np.repeat(np.arange(len(pieces)), pieces)
    within = np.arange(len(edge)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    share = (within / pieces[edge])[:, None]
    return np.concatenate([line_mm[edge] * (1 - share) + line_mm[edge + 1] * share, line_mm[-1:]])


def without_collinear(points_mm: FloatArray) -> FloatArray:
    """Leave out points (n, d) of a polyline that lie on the straight line of their neighbours."""
    points_mm = points_mm[np.append(True, np.diff(points_mm, axis=0).any(axis=1))]
    if len(points_mm) < 3:
        return points_mm
    pieces = points_mm[1:] - points_mm[:-1]
    before, after = pieces[:-1], pieces[1:]
    length2 = np.einsum("ij,ij->i", pieces, pieces)
    turn = np.einsum("ij,ij->i", before, after)
    kept = np.ones(len(points_mm), bool)
    kept[1:-1] = turn < (1 - _STRAIGHT) * np.sqrt(length2[:-1] * length2[1:])
    return np.asarray(points_mm[kept])
