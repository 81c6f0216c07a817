"""G-code of a plan: metric, absolute, G0 and G1 only."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import groupby

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.milling.machine import Cutter, Machine
from insole_core.milling.plan import MillingPlan
from insole_core.milling.tool_path import Motion, Operation, SideName
from insole_core.progress import SILENT, Progress

_DECIMALS = 3
_FILE = "File"
_NUMBERS = 2**17
"""That are kept as written: heights and places on lines recur."""
_PREAMBLE = "G17 G21 G40 G49 G80 G90 G94"
"""Plane xy, mm, no compensation of radius or length, no cycle, absolute, feed in mm/min."""


_LIES = {
    "foot side": "the block foot side up",
    "underside": "the block turned onto its dowels, foot side down",
    "spoil board": "the spoil board, without a block",
}


@dataclass(frozen=True, eq=False)
class ProgramFile:
    """The text of a file, and what it does."""

    text: str
    operations: tuple[Operation, ...]


@dataclass(frozen=True)
class Station:
    """What lies up, and the cutter that is in the spindle."""

    side: SideName
    cutter: Cutter


def stations(machine: Machine, *, both_sides: bool) -> list[Station]:
    """Return the cutters of a program in their order."""
    of_side = [machine.roughing.cutter, machine.finishing.cutter, machine.contour.cutter]
    found = [Station("foot side", cutter) for cutter in of_side]
    if both_sides:
        dowels = Station("foot side", machine.contour.cutter)
        found = [dowels, *found, *(Station("underside", cutter) for cutter in of_side)]
    return [station for station, _ in groupby(found)]


def programs(
    plan: MillingPlan, in_order: Sequence[Station], job: str = "", progress: Progress = SILENT
) -> list[ProgramFile]:
    """Return the files of a plan: one, or one for each station, as the machine needs it.

    Parameters
    ----------
    in_order
        The stations of the plan.
    job
        Names the order, in a comment; never the patient.
    """
    if plan.machine.program_files == "one":
        return [ProgramFile(gcode(plan, job, progress), plan.operations)]
    waiting, files = list(plan.operations), []
    for number, (station, step) in enumerate(
        zip(in_order, progress.parts(len(in_order)), strict=True), 1
    ):
        step.step(0.0, "Writing the program")
        own = []
        while waiting and Station(waiting[0].side, waiting[0].cutter) == station:
            own.append(waiting.pop(0))
        title = (
            "Dowels" if station.side == "spoil board" else f"{_FILE} {number} of {len(in_order)}"
        )
        text = "\n".join(_file_lines(plan, station, own, title, job)) + "\n"
        files.append(ProgramFile(text, tuple(own)))
    return files


def _file_lines(
    plan: MillingPlan, station: Station, own: Sequence[Operation], title: str, job: str
) -> Iterator[str]:
    """Yield the lines of a file for one cutter, with what has to be set up in its head."""
    machine, cutter = plan.machine, station.cutter
    words = _words(plan, job) | _tool(cutter.number, cutter.name, cutter.spindle_rpm)
    width, length, height = (_number(size) for size in plan.block_mm)
    at, level = machine.origin.at, str(machine.origin.height)
    yield from _filled(machine.texts.header, words)
    yield f"({title}: {_LIES[station.side]})"
    yield (
        f"(Put in tool {cutter.number}: {_comment(cutter.name)}, flutes {cutter.flute_mm:g} mm, "
        f"{cutter.reach_mm:g} mm to the collet, and set its height)"
    )
    x_mm, y_mm = machine.origin.offset_mm
    if station.side == "spoil board":
        level = f"{level} of the board"
    else:
        yield f"(Block {width} x {length} x {height} mm, its length along {machine.length_along})"
    yield f"(Zero {machine.work_offset}: {at} of the block, X{x_mm:g} Y{y_mm:g} from it, {level})"
    yield f"{_PREAMBLE} {machine.work_offset}"
    yield from _filled(machine.texts.start, words)
    if not own:
        yield "(With this cutter nothing has to be milled)"
    for operation in own:
        yield f"({operation.name}, {operation.side}, {_comment(cutter.name)})"
        yield from _moves(operation, in_machine(operation.points_mm, plan), is_parked=False)
    yield from _filled((*machine.texts.parking, *machine.texts.footer), words)


def _words(plan: MillingPlan, job: str) -> dict[str, object]:
    """Return what stands for the placeholders that do not depend on the cutter."""
    return {
        "job": _comment(job) or "-",
        "safe_mm": _number(_safe_mm(plan)),
        "park_mm": _number(_park_mm(plan)),
    }


def gcode(plan: MillingPlan, job: str = "", progress: Progress = SILENT) -> str:
    """Return one program of a plan, with stops.

    Parameters
    ----------
    job
        Names the order, in a comment; never the patient.
    """
    return "\n".join(_lines(plan, job, progress)) + "\n"


def _lines(plan: MillingPlan, job: str, progress: Progress) -> Iterator[str]:
    machine = plan.machine
    words = _words(plan, job)
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


def head_of(text: str) -> str:
    """Return the lines of a program in which its machine's header may name the job."""
    return text.partition(_PREAMBLE)[0].partition(f"({_FILE} ")[0]


def is_named_in(head: str, job: str) -> bool:
    """Tell whether the head of a program names a job, as a whole and not as part of another."""
    named = re.escape(_comment(job) or "-")
    return re.search(rf"(?<![\w-]){named}(?![\w-])", head) is not None


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


@lru_cache(_NUMBERS)
def _number(value: float) -> str:
    return f"{value:.{_DECIMALS}f}".rstrip("0").rstrip(".")
