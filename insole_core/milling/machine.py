"""A three-axis router with its cutters: resources/milling, or a file of the clinic."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, fields
from pathlib import Path
from string import Formatter
from typing import Any, Literal, TypeAlias, get_args

from insole_core.files.atomic import write_text
from insole_core.json_object import JsonObject

FORMAT, VERSION = "insole-milling-machine", 1
Shape: TypeAlias = Literal["flat", "ball"]
OriginAt: TypeAlias = Literal["corner", "middle"]
OriginHeight: TypeAlias = Literal["top", "bottom"]
Axis: TypeAlias = Literal["x", "y"]
FlipAxis: TypeAlias = Literal["length", "width"]
ProgramFiles: TypeAlias = Literal["one", "each cutter"]
WorkOffset: TypeAlias = Literal["G54", "G55", "G56", "G57", "G58", "G59"]

PLACEHOLDERS = ("job", "tool", "cutter", "spindle_rpm", "safe_mm", "park_mm")
"""Words in braces that a text of the machine may hold."""
_KNOWN_NUMBERS = {
    "G": {"0", "1", "4", "17", "21", "28", "40", "43", "49", "53", "54", "55", "56", "57", "58",
          "59", "61", "61.1", "64", "80", "90", "91.1", "94"},
    "M": {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "30"},
}  # fmt: skip
_KNOWN_LETTERS = "DFHNPQSTXYZ"
_USUAL_OFFSET: WorkOffset = "G54"
_USUAL_PARKING = ("G0 Z{park_mm}",)
_USUAL_START = ("S{spindle_rpm} M3", "G4 P3")
_USUAL_ACCELERATION_MM_S2 = (500.0, 500.0, 200.0)
"""Of machine files from before they named these."""
_USUAL_DEPTH_MM = 10.0
"""Of holes in the spoil board, where the machine file does not say."""
_CHANGING = ("G20", "G91")
"""Inches and relative places; programs are in millimetres and absolute."""
_COMMENT = re.compile(r"\([^()]*\)|;.*$")
_OFFSETS = re.compile(r"G5[4-9](?![\d.])")
_WORD = re.compile(r"([A-Z])(-?\d+(?:\.\d*)?|-?\.\d+)")


@dataclass(frozen=True)
class Cutter:
    """A cutter with its cutting data.

    Parameters
    ----------
    number
        Of the tool, in the program.
    reach_mm
        From the tip to the collet.
    flute_mm
        Length of the cutting edges; above them nothing may be cut.
    shank_mm
        Diameter above them.
    """

    number: int
    name: str
    shape: Shape
    diameter_mm: float
    reach_mm: float
    flute_mm: float
    shank_mm: float
    spindle_rpm: float
    feed_mm_min: float
    plunge_mm_min: float

    @property
    def radius_mm(self) -> float:
        """Half the diameter."""
        return self.diameter_mm / 2


@dataclass(frozen=True)
class Roughing:
    """Clearing of the block level by level; `allowance_mm` stays on the surface.

    Parameters
    ----------
    width_mm
        Widest cut of a whole step-down. Wider ones take as much away in more passes.
    """

    cutter: Cutter
    step_down_mm: float
    step_over_mm: float
    width_mm: float
    allowance_mm: float

    @property
    def slot_mm(self) -> float:
        """Depth to which the cutter may go where it cuts as wide as it is."""
        return self.step_down_mm * self.width_mm / self.cutter.diameter_mm


@dataclass(frozen=True)
class Finishing:
    """The raster that leaves the surface."""

    cutter: Cutter
    step_over_mm: float


@dataclass(frozen=True)
class Contour:
    """Cutting of the walls, leaving tabs that hold the piece in the block."""

    cutter: Cutter
    step_down_mm: float
    tabs: int
    tab_length_mm: float
    tab_height_mm: float


@dataclass(frozen=True)
class BothSides:
    """Turning of the block.

    Parameters
    ----------
    flip
        About which middle line of the block it is turned; two dowels sit on that line.
    dowel_inset_mm
        From the ends of the block to the middle of a dowel.
    skin_mm
        Of the block below the piece.
    board_depth_mm
        Of the holes for the dowels in the spoil board.
    """

    flip: FlipAxis
    dowel_diameter_mm: float
    dowel_inset_mm: float
    skin_mm: float
    board_depth_mm: float


@dataclass(frozen=True)
class Origin:
    """Where the program has its zero on the block, seen along the machine's axes.

    Parameters
    ----------
    offset_mm
        From the corner or the middle, along x and y of the machine.
    """

    at: OriginAt
    height: OriginHeight
    offset_mm: tuple[float, float]


@dataclass(frozen=True)
class Texts:
    """Lines of the program that depend on the machine, with `PLACEHOLDERS` in braces.

    Parameters
    ----------
    parking
        Where the cutter goes before each stop, and at the end.
    start
        Of a file that is for one cutter, which has been put in.
    """

    header: tuple[str, ...]
    start: tuple[str, ...]
    parking: tuple[str, ...]
    tool_change: tuple[str, ...]
    turn: tuple[str, ...]
    footer: tuple[str, ...]


@dataclass(frozen=True)
class Machine:
    """A router.

    Parameters
    ----------
    travel_mm
        Along x, y and z.
    acceleration_mm_s2
        Of the axes x, y and z.
    length_along
        Axis along which the block's length lies.
    work_offset
        Of the controller's offsets the one that holds the program's zero.
    program_files
        One with stops, or one for each cutter and side: for controllers that cannot be moved by
        hand while they hold.
    """

    name: str
    travel_mm: tuple[float, float, float]
    rapid_mm_min: float
    acceleration_mm_s2: tuple[float, float, float]
    safe_height_mm: float
    length_along: Axis
    work_offset: WorkOffset
    program_files: ProgramFiles
    origin: Origin
    cutters: tuple[Cutter, ...]
    roughing: Roughing
    finishing: Finishing
    contour: Contour
    both_sides: BothSides
    texts: Texts


def read_machine(path: Path) -> Machine:
    """Read a machine file.

    Raises
    ------
    InputError
        Naming the file and the key that is missing or wrong.
    """
    root = JsonObject.read(path)
    root.check_format(FORMAT, VERSION)
    cutters = tuple(map(_cutter, root.objects("cutters")))
    numbers = [cutter.number for cutter in cutters]
    if len(set(numbers)) < len(numbers):
        raise root.fail("cutters", "has two cutters of one number; number them differently")
    travel = root.numbers("travel_mm", 3, 10, 10_000)
    return Machine(
        name=root.text("name"),
        travel_mm=(travel[0], travel[1], travel[2]),
        rapid_mm_min=root.number("rapid_mm_min", 100, 100_000),
        acceleration_mm_s2=_acceleration(root),
        safe_height_mm=root.number("safe_height_mm", 1, 200),
        length_along=root.choice("length_along", get_args(Axis)),
        work_offset=_work_offset(root),
        program_files=root.choice("program_files", get_args(ProgramFiles))
        if root.has("program_files")
        else "one",
        origin=_origin(root.object("origin")),
        cutters=cutters,
        roughing=_roughing(root.object("roughing"), cutters),
        finishing=_finishing(root.object("finishing"), cutters),
        contour=_contour(root.object("contour"), cutters),
        both_sides=_both_sides(root.object("both_sides")),
        texts=_texts(root.object("texts")),
    )


def write_machine(machine: Machine, path: Path) -> None:
    """Write a machine in the format of `read_machine`.

    Raises
    ------
    OutputError
        If the path cannot be written.
    """
    content = {"format": FORMAT, "version": VERSION, **_as_json(machine)}
    write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", path)


def _as_json(value: Any) -> dict[str, Any]:
    """Return the fields of a dataclass; cutters outside the table of cutters by their number."""

    def plain(item: Any) -> Any:
        if isinstance(item, Cutter):
            return item.number
        return _as_json(item) if hasattr(item, "__dataclass_fields__") else item

    return {
        field.name: [_as_json(cutter) for cutter in value.cutters]
        if field.name == "cutters"
        else plain(getattr(value, field.name))
        for field in fields(value)
    }


def _work_offset(root: JsonObject) -> WorkOffset:
    """Return the offset that the file names; from before it could, the one of its header.

    A line that selects another one is refused: the program would be milled at another place.
    """
    texts = root.object("texts")
    selected = [
        (field.name, word)
        for field in fields(Texts)
        if texts.has(field.name)
        for line in texts.texts(field.name)
        for word in _OFFSETS.findall(_COMMENT.sub("", line))
    ]
    of_header = [word for key, word in selected if key == "header"]
    chosen: WorkOffset = _USUAL_OFFSET
    if root.has("work_offset"):
        chosen = root.choice("work_offset", get_args(WorkOffset))
    elif of_header:
        chosen = of_header[0]
    for key, word in selected:
        if word != chosen:
            raise texts.fail(
                key,
                "selects {word}, and the program is made for {chosen}; take that word out, or set "
                "work_offset",
                word=word,
                chosen=chosen,
            )
    return chosen


def _acceleration(root: JsonObject) -> tuple[float, float, float]:
    if not root.has("acceleration_mm_s2"):
        return _USUAL_ACCELERATION_MM_S2
    x, y, z = root.numbers("acceleration_mm_s2", 3, 1, 100_000)
    return x, y, z


def _positive(item: JsonObject, key: str, most: float) -> float:
    number = item.number(key, 0, most)
    if number == 0:
        raise item.fail(key, "is 0, so that the cutter would stand still; put in the real value")
    return number


def _cutter(item: JsonObject) -> Cutter:
    reach_mm, diameter_mm = item.number("reach_mm", 1, 300), item.number("diameter_mm", 1, 40)
    return Cutter(
        number=item.integer("number", 1, 999),
        name=item.text("name"),
        shape=item.choice("shape", get_args(Shape)),
        diameter_mm=diameter_mm,
        reach_mm=reach_mm,
        flute_mm=item.number("flute_mm", 1, reach_mm) if item.has("flute_mm") else reach_mm,
        shank_mm=item.number("shank_mm", 1, 40) if item.has("shank_mm") else diameter_mm,
        spindle_rpm=_positive(item, "spindle_rpm", 100_000),
        feed_mm_min=_positive(item, "feed_mm_min", 50_000),
        plunge_mm_min=_positive(item, "plunge_mm_min", 50_000),
    )


def _used(item: JsonObject, cutters: tuple[Cutter, ...], shape: Shape | None) -> Cutter:
    number = item.integer("cutter", 1, 999)
    cutter = next((cutter for cutter in cutters if cutter.number == number), None)
    if cutter is None:
        raise item.fail(
            "cutter", "is {number}, and no cutter has that number; add it", number=number
        )
    if shape is not None and cutter.shape != shape:
        raise item.fail(
            "cutter",
            "is {number}, a {is_shape} one, and must be a {shape} one; choose another",
            number=number,
            is_shape=cutter.shape,
            shape=shape,
        )
    return cutter


def _roughing(item: JsonObject, cutters: tuple[Cutter, ...]) -> Roughing:
    cutter = _used(item, cutters, None)
    step_over_mm = item.number("step_over_mm", 0.2, cutter.radius_mm * 1.6)
    least_mm = max(step_over_mm, cutter.radius_mm)
    width_mm = cutter.diameter_mm
    if item.has("width_mm"):
        width_mm = item.number("width_mm", least_mm, cutter.diameter_mm)
    return Roughing(
        cutter,
        item.number("step_down_mm", 0.2, min(50, cutter.flute_mm)),
        step_over_mm,
        width_mm,
        item.number("allowance_mm", 0.3, 5),
    )


def _finishing(item: JsonObject, cutters: tuple[Cutter, ...]) -> Finishing:
    cutter = _used(item, cutters, "ball")
    return Finishing(cutter, item.number("step_over_mm", 0.1, cutter.radius_mm))


def _contour(item: JsonObject, cutters: tuple[Cutter, ...]) -> Contour:
    cutter = _used(item, cutters, "flat")
    return Contour(
        cutter,
        item.number("step_down_mm", 0.2, min(20, cutter.flute_mm)),
        item.integer("tabs", 0, 100),
        item.number("tab_length_mm", 1, 50),
        item.number("tab_height_mm", 0.5, 20),
    )


def _both_sides(item: JsonObject) -> BothSides:
    return BothSides(
        item.choice("flip", get_args(FlipAxis)),
        item.number("dowel_diameter_mm", 2, 30),
        item.number("dowel_inset_mm", 2, 100),
        item.number("skin_mm", 0.5, 50),
        item.number("board_depth_mm", 1, 50) if item.has("board_depth_mm") else _USUAL_DEPTH_MM,
    )


def _origin(item: JsonObject) -> Origin:
    return Origin(
        item.choice("at", get_args(OriginAt)),
        item.choice("height", get_args(OriginHeight)),
        item.pair("offset_mm", 10_000),
    )


def _texts(item: JsonObject) -> Texts:
    return Texts(
        header=_text(item, "header"),
        start=_text(item, "start") if item.has("start") else _USUAL_START,
        parking=_text(item, "parking") if item.has("parking") else _USUAL_PARKING,
        tool_change=_text(item, "tool_change"),
        turn=_text(item, "turn"),
        footer=_text(item, "footer"),
    )


def _text(item: JsonObject, key: str) -> tuple[str, ...]:
    """Return the lines of a text, when a controller knows every word of them."""
    lines = item.texts(key)
    for line in lines:
        _check_line(item, key, line)
    return tuple(lines)


def _check_line(item: JsonObject, key: str, line: str) -> None:
    try:
        names = [name for _, name, _, _ in Formatter().parse(line) if name is not None]
        filled = line.format(**dict.fromkeys(PLACEHOLDERS, "1"))
    except (ValueError, KeyError, IndexError, AttributeError):
        names = [*re.findall(r"\{([^{}]*)\}?", line), line]
        filled = ""
    unknown = [name for name in names if name not in PLACEHOLDERS]
    if not unknown and not filled.isascii():
        unknown = [line]
    if not unknown and filled != "%":
        unknown = _unknown_words(_COMMENT.sub("", filled).upper())
    if unknown and unknown[0] in _CHANGING:
        raise item.fail(
            key,
            'has the word "{word}", which changes the units or the way of counting; '
            'correct the line "{line}"',
            word=unknown[0],
            line=line,
        )
    if unknown:
        raise item.fail(
            key,
            'has the word "{word}", which no controller knows; correct the line "{line}"',
            word=unknown[0],
            line=line,
        )


def _unknown_words(line: str) -> list[str]:
    code = line.replace(" ", "")
    if _WORD.sub("", code):
        pieces = re.sub(r"([A-Z]) +(?=[-.\d])", r"\1", line).split()
        return [piece for piece in pieces if _WORD.sub("", piece)] or [code]
    return [
        letter + number
        for letter, number in _WORD.findall(code)
        if letter not in _KNOWN_LETTERS
        and re.sub(r"^0+(?=\d)", "", number) not in _KNOWN_NUMBERS.get(letter, ())
    ]
