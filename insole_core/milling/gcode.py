"""G-code of a plan: metric, absolute, G0 and G1 only."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.milling.machine import Machine
from insole_core.milling.plan import MillingPlan
from insole_core.milling.tool_path import Motion, Operation
from insole_core.progress import SILENT, Progress

_DECIMALS = 3
_PREAMBLE = "G17 G21 G40 G49 G80 G90 G94"
"""Plane xy, mm, no compensation of radius or length, no cycle, absolute, feed in mm/min."""


def gcode(plan: MillingPlan, job: str = "", progress: Progress = SILENT) -> str:
    """Return the program of a plan.

    Parameters
    ----------
    job
        Names the order, in a comment; never the patient.
    """
    return "\n".join(_lines(plan, job, progress)) + "\n"


def _lines(plan: MillingPlan, job: str, progress: Progress) -> Iterator[str]:
    machine = plan.machine
    words: dict[str, object] = {
        "job": _comment(job) or "-",
        "safe_mm": _number(_safe_mm(plan)),
        "park_mm": _number(_park_mm(plan)),
    }
    first = plan.operations[0].cutter
    yield from _filled(machine.texts.header, words | _tool(first.number, first.name, 0))
    yield f"{_PREAMBLE} {machine.work_offset}"
    side, tool = plan.operations[0].side, 0
    for operation, step in zip(plan.operations, progress.parts(len(plan.operations)), strict=True):
        step.step(0.0, "Writing the program")
        cutter = operation.cutter
        words |= _tool(cutter.number, cutter.name, cutter.spindle_rpm)
        stops = [
            *(machine.texts.turn if operation.side != side else ()),
            *(machine.texts.tool_change if cutter.number != tool else ()),
        ]
        is_parked = bool(stops) and tool != 0
        yield from _filled(((*machine.texts.parking, *stops) if is_parked else stops), words)
        side, tool = operation.side, cutter.number
        yield f"({operation.name}, {operation.side}, {_comment(cutter.name)})"
        yield from _moves(operation, in_machine(operation.points_mm, plan), is_parked)
    yield from _filled((*machine.texts.parking, *machine.texts.footer), words)


def _tool(number: int, name: str, spindle_rpm: float) -> dict[str, object]:
    return {"tool": number, "cutter": _comment(name), "spindle_rpm": f"{spindle_rpm:.0f}"}


def _filled(lines: Sequence[str], words: dict[str, object]) -> Iterator[str]:
    return (line.format(**words) for line in lines)


def _comment(text: str) -> str:
    """Return a text that may stand in a comment: ASCII without brackets."""
    plain = text.encode("ascii", "replace").decode()
    return "".join(" " if letter in "()%;{}\n\r" else letter for letter in plain).strip()


def origin_mm(machine: Machine, block_mm: tuple[float, float, float]) -> FloatArray:
    """Return the program's zero (3,) on the block, along the machine's axes from its corner."""
    width, length, height = block_mm
    size = np.array([length, width] if machine.length_along == "x" else [width, length])
    start = np.zeros(2) if machine.origin.at == "corner" else size / 2
    z = height if machine.origin.height == "top" else 0.0
    return np.array([*(start + machine.origin.offset_mm), z])


def in_machine(points_mm: FloatArray, plan: MillingPlan) -> FloatArray:
    """Return points (n, 3) of the block along the machine's axes, from the program's zero."""
    x, y, z = points_mm.T
    if plan.machine.length_along == "x":
        x, y = y, plan.block_mm[0] - x
    return np.column_stack([x, y, z]) - origin_mm(plan.machine, plan.block_mm)


def _safe_mm(plan: MillingPlan) -> float:
    top_mm = plan.block_mm[2] - origin_mm(plan.machine, plan.block_mm)[2]
    return float(top_mm + plan.machine.safe_height_mm)


def _park_mm(plan: MillingPlan) -> float:
    """Return the height from which a block can be lifted off its dowels below the cutter.

    The travel of the machine is counted from the bottom of the block.
    """
    high_mm = plan.machine.travel_mm[2] - origin_mm(plan.machine, plan.block_mm)[2]
    return float(max(min(_safe_mm(plan) + plan.block_mm[2], high_mm), _safe_mm(plan)))


def _moves(operation: Operation, points_mm: FloatArray, is_parked: bool) -> Iterator[str]:
    """Yield one line for each move, with the words that change.

    From anywhere the cutter first goes up, then across; from the parking place, which is higher,
    first across.
    """
    feeds = {
        Motion.PLUNGE: f"F{operation.cutter.plunge_mm_min:.0f}",
        Motion.FEED: f"F{operation.cutter.feed_mm_min:.0f}",
    }
    rounded = np.round(points_mm, _DECIMALS) + 0.0
    x_mm, y_mm, z_mm = rounded[0].tolist()
    if is_parked:
        yield f"G0 X{_number(x_mm)} Y{_number(y_mm)}"
    yield f"G0 Z{_number(z_mm)}"
    last: tuple[float, float, float] | None = None
    last_feed = ""
    for (x, y, z), kind in zip(rounded.tolist(), operation.motion.tolist(), strict=True):
        words = []
        if last is None or x != last[0]:
            words.append(f"X{_number(x)}")
        if last is None or y != last[1]:
            words.append(f"Y{_number(y)}")
        if last is None or z != last[2]:
            words.append(f"Z{_number(z)}")
        last = (x, y, z)
        if not words:
            continue
        if kind == Motion.RAPID:
            yield f"G0 {' '.join(words)}"
            continue
        feed = feeds[Motion(kind)]
        if feed != last_feed:
            words.append(feed)
            last_feed = feed
        yield f"G1 {' '.join(words)}"


def _number(value: float) -> str:
    return f"{value:.{_DECIMALS}f}".rstrip("0").rstrip(".")
