"""What the operator of a router is told about a program: one sheet, in the order of the work."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Final, TypeAlias

import numpy as np

from insole_core.export.setup_paper import (
    LyingPiece,
    SetupPlan,
    SetupSheet,
    write_setup_paper,
)
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.height_map import HeightMap
from insole_core.geometry.mesh import TriangleMesh
from insole_core.given_file import sha256_of
from insole_core.insole.elements.words import duration_message, number_message
from insole_core.messages import Message, Translate, joined
from insole_core.milling.contours import dowel_places
from insole_core.milling.gcode import in_machine, origin_mm
from insole_core.milling.machine import Cutter
from insole_core.milling.plan import FootInBlock, MillingPlan
from insole_core.milling.tool_path import Motion, Operation
from insole_core.solids.checks import survey_heights
from insole_core.solids.shop import Block

_CLAMP_MM: Final = 15.0
"""Width of a border on which a clamp finds room."""
_END_MM: Final = 14.0
"""From heel and toes of a piece to their words."""
_SHAPES: Final = {"flat": "flat", "ball": "ball nose"}
_WORK: Final = {
    "dowels": "holes for the dowels", "roughing": "clearing", "finishing": "finishing",
    "contour": "contour",
}  # fmt: skip
_ZEROS: Final = {
    ("corner", "top"): "the corner of the block with least x and y, its upper side",
    ("corner", "bottom"): "the corner of the block with least x and y, the surface of the board",
    ("middle", "top"): "the middle of the block, its upper side",
    ("middle", "bottom"): "the middle of the block, the surface of the board",
}
_EDGES: Final = (("left", "right"), ("front", "back"))
"""As the operator and the picture see them: x to the right, y away."""
_FLIPS: Final = {
    "length": "its middle line along its length",
    "width": "its middle line along its width",
}
_Place: TypeAlias = tuple[FootInBlock, FloatArray, FloatArray]


@dataclass(frozen=True, eq=False)
class RouterFile:
    """A file that the router runs.

    Parameters
    ----------
    name
        As the shop gets it.
    path
        Where it is written; it may be a temporary name.
    operations
        What it does, one after the other.
    """

    name: str
    path: Path
    operations: tuple[Operation, ...]


def write_setup_sheet(
    plan: MillingPlan,
    files: Sequence[RouterFile],
    path: Path,
    *,
    block: Block,
    identification: Mapping[str, str],
    pin_holes: RouterFile | None = None,
    translate: Translate = str,
) -> None:
    """Write the set-up sheet of the programs of a plan.

    Parameters
    ----------
    files
        In the order in which they are run.
    block
        Of the shop's list, from which `plan` was made.
    identification
        Order number and so on; never the patient's name.
    pin_holes
        The program for the spoil board, of a block that is turned.
    translate
        Into the language of the paper.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    programs: dict[str, str] = {file.name: _program_words(file) for file in files}
    if pin_holes is not None:
        programs = {pin_holes.name: _board_words(pin_holes), **programs}
    sections: dict[str, dict[str, str]] = {
        "identification": {**identification, **_machine_facts(plan)},
        "programs": programs,
        "block": _block_facts(plan, block),
        "cutters": _cutter_facts(plan),
        "holding": _holding_facts(plan),
    }
    worded = {
        key: {
            translate(name) if isinstance(name, Message) else name: translate(text)
            for name, text in facts.items()
        }
        for key, facts in sections.items()
    }
    steps = [translate(step) for step in _steps(plan, files, pin_holes)]
    notes = [translate(note) for note in plan.notes]
    sheet = SetupSheet(worded, steps, _picture(plan, translate), notes)
    write_setup_paper(sheet, path, translate)


def _machine_facts(plan: MillingPlan) -> dict[str, str]:
    machine = plan.machine
    return {
        "machine": machine.name,
        "milling time": duration_message(plan.minutes),
    }


def _program_words(file: RouterFile) -> Message:
    if not file.operations:
        return Message("nothing has to be milled with this cutter: do not run it")
    works = dict.fromkeys(
        Message("{side}: {work}", side=Message(each.side), work=Message(_WORK[each.name]))
        for each in file.operations
    )
    return _with_digest(joined(works, "; "), file)


def _board_words(file: RouterFile) -> Message:
    return _with_digest(Message("spoil board: holes for the dowels"), file)


def _with_digest(works: Message, file: RouterFile) -> Message:
    return Message("{works} (SHA-256 {digest})", works=works, digest=sha256_of(file.path)[:16])


def _block_facts(plan: MillingPlan, block: Block) -> dict[str, str]:
    machine = plan.machine
    along, across = ("x", "y") if machine.length_along == "x" else ("y", "x")
    length, width, _ = block.sides_mm
    facts: dict[str, str] = {
        "stock": block.words,
        "orientation": Message(
            "its length of {length:g} mm along {along}, its width of {width:g} mm along {across}",
            length=length,
            along=along,
            width=width,
            across=across,
        ),
        "zero": _zero(plan),
    }
    for number, (foot, low, high) in enumerate(_places(plan), 1):
        facts[_name(foot, number)] = Message(
            "x {x:.1f} – {x_end:.1f}, y {y:.1f} – {y_end:.1f} mm from the zero; its toes towards "
            "{direction}",
            x=low[0],
            x_end=high[0],
            y=low[1],
            y_end=high[1],
            direction=f"{'−' if foot.is_turned else '+'}{along}",
        )
    return facts


def _zero(plan: MillingPlan) -> Message:
    machine = plan.machine
    place = Message(_ZEROS[machine.origin.at, machine.origin.height])
    x, y = machine.origin.offset_mm
    if (x, y) == (0, 0):
        return Message("{offset}: {place}", offset=machine.work_offset, place=place)
    return Message(
        "{offset}: {place}, and from there x {x:g} mm, y {y:g} mm",
        offset=machine.work_offset,
        place=place,
        x=x,
        y=y,
    )


def _cutter_facts(plan: MillingPlan) -> dict[str, str]:
    """Return each cutter in the order in which it is first needed."""
    first = dict.fromkeys(operation.cutter for operation in plan.operations)
    return {_tool(cutter): _cutter_words(plan, cutter) for cutter in first}


def _cutter_words(plan: MillingPlan, cutter: Cutter) -> Message:
    own = [each for each in plan.operations if each.cutter == cutter]
    deepest = plan.block_mm[2] - min(float(each.points_mm[:, 2].min()) for each in own)
    return Message(
        "{shape}, diameter {diameter} mm, flutes {flute} mm, length {reach} mm to the collet, of "
        "which {free} mm are needed; {rpm:.0f} rpm, {time}",
        shape=Message(_SHAPES[cutter.shape]),
        diameter=number_message(cutter.diameter_mm),
        flute=number_message(cutter.flute_mm),
        reach=number_message(cutter.reach_mm),
        free=number_message(float(np.ceil(deepest))),
        rpm=cutter.spindle_rpm,
        time=duration_message(sum(each.minutes(plan.machine) for each in own)),
    )


def _holding_facts(plan: MillingPlan) -> dict[str, str]:
    facts: dict[str, str] = {"clamps": _clamps(plan)}
    if not plan.is_turned:
        return facts
    how = plan.machine.both_sides
    places = dowels_in_machine(plan)
    axis, at = ("y", places[0, 0]) if _is_level(places[:, 0]) else ("x", places[0, 1])
    facts["turning axis"] = Message(
        "{line}: {across} = {at:.1f} mm, along {axis}",
        line=Message(_FLIPS[how.flip]),
        across="x" if axis == "y" else "y",
        at=float(at),
        axis=axis,
    )
    facts["dowels"] = Message(
        "diameter {diameter} mm, at {places}",
        diameter=number_message(how.dowel_diameter_mm),
        places=joined((_at(place) for place in places), " / "),
    )
    return facts


def _at(place_mm: FloatArray) -> Message:
    return Message("X{x:.1f} Y{y:.1f}", x=float(place_mm[0]), y=float(place_mm[1]))


def _is_level(values: FloatArray) -> bool:
    return float(np.ptp(values)) < 1e-6


def dowels_in_machine(plan: MillingPlan) -> FloatArray:
    """Return the places (2, 2) of the dowels along x and y of the machine, from the zero."""
    places = np.array(dowel_places(plan.machine, plan.block_mm))
    return in_machine(np.pad(places, ((0, 0), (0, 1))), plan)[:, :2]


def _clamps(plan: MillingPlan) -> Message:
    """Say where on the block there is room for clamps: beside all that is cut, but for dowels."""
    low, high = _cut_mm(plan)
    (left, near, right, far) = _block_mm(plan)
    room = ((low[0] - left, right - high[0]), (low[1] - near, far - high[1]))
    free = [
        Message("{edge} {room:.0f} mm", edge=Message(_EDGES[axis][end]), room=float(width))
        for axis, ends in enumerate(room)
        for end, width in enumerate(ends)
        if width >= _CLAMP_MM
    ]
    if not free:
        return Message(
            "no edge has {room:g} mm free: hold the block from its sides or from below, such as "
            "by vacuum or tape",
            room=_CLAMP_MM,
        )
    edges, safe = joined(free), number_message(plan.machine.safe_height_mm)
    if any(each.name == "dowels" for each in plan.operations):
        return Message(
            "on free edges alone ({edges}), beside the dowels, and no higher than {safe} mm above "
            "the block",
            edges=edges,
            safe=safe,
        )
    return Message(
        "on free edges alone ({edges}), and no higher than {safe} mm above the block",
        edges=edges,
        safe=safe,
    )


def _cut_mm(plan: MillingPlan) -> tuple[FloatArray, FloatArray]:
    """Return least and greatest x and y that a cutter reaches within the block, but for dowels."""
    lows, highs = [], []
    for each in plan.operations:
        if each.name == "dowels":
            continue
        at = in_machine(each.points_mm[each.motion != Motion.RAPID], plan)[:, :2]
        lows.append(at.min(axis=0) - each.cutter.radius_mm)
        highs.append(at.max(axis=0) + each.cutter.radius_mm)
    return np.min(lows, axis=0), np.max(highs, axis=0)


def _block_mm(plan: MillingPlan) -> tuple[float, float, float, float]:
    corners = in_machine(np.array([(0.0, 0, 0), plan.block_mm]), plan)[:, :2]
    (left, low), (right, high) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    return left, low, right, high


def _steps(
    plan: MillingPlan, files: Sequence[RouterFile], pin_holes: RouterFile | None
) -> Iterator[Message]:
    """Say what is done at the machine, one after the other."""
    if pin_holes is not None:
        how = plan.machine.both_sides
        yield Message(
            "Once for all blocks of these sides: put in cutter {cutter}, set the zero as for the "
            "block, but z = 0 on the surface of the spoil board, and run {file}: it bores two "
            "holes of {diameter} mm, {depth} mm deep.",
            cutter=_tool(pin_holes.operations[0].cutter),
            file=pin_holes.name,
            diameter=number_message(how.dowel_diameter_mm),
            depth=number_message(how.board_depth_mm),
        )
    yield Message("Lay the block as in the picture, clamp it, and set the zero.")
    before: Operation | None = None
    for file in filter(lambda file: file.operations, files):
        first = file.operations[0]
        if before is not None and before.side != first.side:
            yield _turning(plan)
        yield Message("Put in cutter {cutter}, and run {file}.", cutter=_tool(first.cutter),
                      file=file.name)  # fmt: skip
        for earlier, later in pairwise(file.operations):
            if later.side != earlier.side:
                yield Message("The cutter parks. {step}", step=_turning(plan))
            if later.cutter != earlier.cutter:
                yield Message(
                    "The cutter parks. Put in cutter {cutter}, set its height again, and go on.",
                    cutter=_tool(later.cutter),
                )
        before = file.operations[-1]
    if plan.machine.contour.tabs:
        yield Message("Cut the tabs, and take the pieces out.")
    else:
        yield Message(
            "No tabs hold the pieces, and the last cut has set them free: wait till the cutter "
            "stands still, and take them out."
        )


def _turning(plan: MillingPlan) -> Message:
    return Message(
        "Put the dowels into the board, turn the block about {line}, foot side down, and lay it on "
        "them; the zero stays.",
        line=Message(_FLIPS[plan.machine.both_sides.flip]),
    )


def _tool(cutter: Cutter) -> str:
    return f"{cutter.number} ({cutter.name})"


def _places(plan: MillingPlan) -> Iterator[_Place]:
    """Yield each foot, and least and greatest x and y of its solid from the zero."""
    for foot, solid in zip(plan.feet, plan.solids, strict=True):
        corners = in_machine(solid.bounds_mm, plan)[:, :2]
        yield foot, corners.min(axis=0), corners.max(axis=0)


def _name(foot: FootInBlock, number: int) -> str:
    """Return what a piece is called; those of several orders are numbered as on the picture."""
    if not foot.order:
        return str(foot.side)
    return Message(
        "{number}: {mark}, {side}", number=number, mark=foot.order, side=Message(str(foot.side))
    )


def _picture(plan: MillingPlan, translate: Translate) -> SetupPlan:
    dowels = dowels_in_machine(plan).tolist() if plan.is_turned else []
    pieces = tuple(
        LyingPiece(_heights(plan, solid), _labels(plan, place, number, translate))
        for number, (solid, place) in enumerate(zip(plan.solids, _places(plan), strict=True), 1)
    )
    return SetupPlan(
        _block_mm(plan), plan.block_mm[2], pieces,
        tuple((x, y) for x, y in dowels), plan.machine.both_sides.dowel_diameter_mm,
    )  # fmt: skip


def _heights(plan: MillingPlan, solid: TriangleMesh) -> HeightMap:
    lying = in_machine(solid.vertices, plan)
    lying[:, 2] += origin_mm(plan.machine, plan.block_mm)[2]
    return survey_heights(TriangleMesh(lying, solid.triangles))


def _labels(
    plan: MillingPlan, place: _Place, number: int, translate: Translate
) -> tuple[tuple[float, float, str], ...]:
    """Return what stands on a piece: heel, side and toes; of many its number alone."""
    foot, low, high = place
    axis = 0 if plan.machine.length_along == "x" else 1
    middle = (low + high) / 2
    if foot.order:
        return ((float(middle[0]), float(middle[1]), str(number)),)
    ends = (high, low) if foot.is_turned else (low, high)
    inside = _END_MM if ends[0][axis] < ends[1][axis] else -_END_MM
    named = (
        (ends[0][axis] + inside, "heel"),
        (middle[axis], str(foot.side)),
        (ends[1][axis] - inside, "toes"),
    )
    labels = []
    for along, word in named:
        at = middle.copy()
        at[axis] = along
        labels.append((float(at[0]), float(at[1]), translate(Message(word))))
    return tuple(labels)
