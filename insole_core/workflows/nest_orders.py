"""The pieces of a day's orders on one block or sheet, for a router, a cutter or a printer."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from insole_core.errors import DesignError, InputError, OutputError
from insole_core.export.order_verification import (
    MOST_BYTES_OF_A_PAPER,
    ordered_content,
    side_in_name,
    verify_order,
)
from insole_core.export.sheet_terms import SheetTerms, terms_in
from insole_core.export.shop_order import MOST_PAIRS, ORDER_FILE, OrderItem
from insole_core.files.transaction import Transaction
from insole_core.files.write_errors import is_there
from insole_core.formats.dxf import DxfOutline, DxfText, write_dxf
from insole_core.formats.file_formats import (
    JOB_SHEET,
    NEST_SHEET,
    OUTLINES,
    PIN_HOLES,
    PROGRAM,
    SETUP_SHEET,
    role_of,
)
from insole_core.formats.reading import read_raw
from insole_core.formats.scan_content import ScanContent
from insole_core.formats.slicer_3mf import is_for_slicer
from insole_core.formats.solid_content import SolidPart, write_solids
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.packing import Packed, Turn, pack
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.given_file import read_given
from insole_core.messages import Message, Translate, joined
from insole_core.milling.plan import HEIGHT_TOLERANCE_MM, FootInBlock, MillingPlan, plan_milling
from insole_core.progress import SILENT, Progress
from insole_core.regular_file import is_folder
from insole_core.scans.cleaning import merged
from insole_core.solids.checks import survey_heights
from insole_core.solids.export_job import ExportPaths, standing
from insole_core.solids.marking import mark
from insole_core.solids.order import MARK_AT, MARK_ROOM
from insole_core.solids.shop import Block
from insole_core.solids.silhouette import block_outline, mark_text, silhouette
from insole_core.workflows.mill import (
    MillingChoice,
    earlier_programs,
    program_paths,
    require_no_other_program,
    write_milling,
)
from insole_core.zip_archive import ZipArchive

if TYPE_CHECKING:
    from insole_core.export.paper import Nesting

GAP_MM: Final = 12.0
"""Between two pieces: twice the cutter of our machine files."""
MARGIN_MM: Final = 4.0
MOST_GAP_MM: Final = 100.0
"""Between two pieces, and to the sides of the block."""
MOST_SIDE_MM: Final = 3000.0
"""Of the block."""
_MOST_PIECES: Final = 500
_MOST_TOLD: Final = 5
"""Problems of an order in one sentence."""
_MOST_BYTES: Final = 512 * 2**20
_ALONG: Final[tuple[Turn, ...]] = (0, 180)
_ACROSS: Final[tuple[Turn, ...]] = (90, 270)
_PROGRAM: Final = "program "
_PLACES_OF_MARKS: Final = ((MARK_AT, MARK_ROOM[1]), (0.74, 0.25))
"""Middle and length as shares of the piece: under the heel, as the marks of orders; under the ball,
where one is there already."""
_BOTTOM_MM: Final = 0.05
_RELIEF_MM, _LETTERS_MM = 1.0, 10.0
"""Above the bottom, and to the sides of its middle line: within them lies part of each mark."""


@dataclass(frozen=True, eq=False)
class OrderedPiece:
    """A solid of an order, in the number in which it is ordered.

    Parameters
    ----------
    number
        Of the order.
    solid : mm
        Standing on z = 0, toes towards +y.
    quantity
        None where its files do not say it; it then lies on the block once.
    pseudonym
        Of the patient, never a name; empty where the number stands in its place.
    """

    number: str
    side: Side
    solid: TriangleMesh
    material: str = ""
    quantity: int | None = 1
    pseudonym: str = ""

    @property
    def order(self) -> str:
        """What the piece is known to the shop by: the order's number, and the pseudonym."""
        if self.pseudonym.startswith(self.number):
            return self.pseudonym
        return f"{self.number} {self.pseudonym}".rstrip()

    @property
    def name(self) -> str:
        """Order and side."""
        return f"{self.order} {self.side}"


@dataclass(frozen=True, eq=False)
class NestedPiece:
    """A piece where it lies: its frame to that of the block, a corner of which is the origin."""

    piece: OrderedPiece
    packed: Packed
    piece2block: FloatArray
    own_outlines: tuple[FloatArray, ...]
    """From above, in the frame of the piece, mm."""

    @property
    def outlines(self) -> list[FloatArray]:
        """The outlines (n, 2) in the block, mm; holes turn clockwise."""
        return [self.packed.applied(outline) for outline in self.own_outlines]

    @property
    def solid(self) -> TriangleMesh:
        """The solid in the block, mm."""
        return self.piece.solid.transformed(self.piece2block)


@dataclass(frozen=True, eq=False)
class DayNest:
    """All pieces on one block; width along x, length along y."""

    block: Block
    pieces: tuple[NestedPiece, ...]
    notes: tuple[Message, ...] = ()

    @property
    def block_mm(self) -> tuple[float, float, float]:
        """Width, length, height."""
        length, width, height = self.block.sides_mm
        return width, length, height


@dataclass(frozen=True)
class WrittenNest:
    """The files of a nest, and what there is to say of it and of its program."""

    paths: tuple[Path, ...]
    notes: tuple[Message, ...]


def gathered(orders: Iterable[Iterable[OrderedPiece]]) -> list[OrderedPiece]:
    """Return the pieces of all orders, which are read no further than a nest can take them.

    Raises
    ------
    InputError
        When there are too many, or an order comes again, perhaps in an earlier revision; also what
        reading the orders raises.
    """
    pieces: list[OrderedPiece] = []
    for order in orders:
        before = {piece.number for piece in pieces}
        for piece in order:
            if piece.number in before:
                raise InputError(
                    "Order {number} is among them twice; name its last revision alone.",
                    number=piece.number,
                )
            pieces.append(piece)
            _check_number(pieces)
    return pieces


def pieces_of_order(path: Path) -> Iterator[OrderedPiece]:
    """Yield the pieces of an order: a folder, or a zip archive, with its `order.json`.

    Raises
    ------
    InputError
        When it is no order, is not as it was written, or a file of it holds no piece alone.
    """
    verification = verify_order(path)
    if verification.problems:
        raise InputError(
            "{order} is not as it was written: {problems}",
            order=path,
            problems=_listed(verification.problems),
        )
    order = verification.order
    for item in order.items:
        yield from _pieces_of_item(path, item, order.release.number)


def _listed(problems: Sequence[Message]) -> Message:
    """Return the first problems in a row."""
    told = joined(problems[:_MOST_TOLD], " ")
    more = len(problems) - _MOST_TOLD
    if more <= 0:
        return told
    return Message("{told} And {more} more; verify the order.", told=told, more=more)


def has_pieces(files: Sequence[Path]) -> bool:
    """Tell whether `pieces_of_files` finds a piece among the files of an order."""
    return any(
        path.name == ORDER_FILE or _is_order(path) or role_of(path.name) == "solid"
        for path in files
    )


def _is_order(path: Path) -> bool:
    return path.suffix.lower() == ".zip" or is_folder(path)


def pieces_of_files(files: Sequence[Path], number: str) -> Iterator[OrderedPiece]:
    """Yield the pieces of an order that was written as single files, or of an archive among them.

    Of single files the job sheets say quantity and material.

    Raises
    ------
    InputError
        When there is none, or a file holds no piece alone.
    """
    found = False
    folder = next((path.parent for path in files if path.name == ORDER_FILE), None)
    for path in (folder,) if folder is not None else files:
        if _is_order(path):
            found = True
            yield from pieces_of_order(path)
        elif role_of(path.name) == "solid":
            found = True
            yield _piece_of_file(path, _terms_beside(path, files), number)
    if not found:
        raise InputError(_without_solids(number))


def _without_solids(number: str) -> Message:
    return Message("Order {number} was written without solids; export it again.", number=number)


def _piece_of_file(path: Path, terms: SheetTerms, number: str) -> OrderedPiece:
    side = _only_side(path.name, (side_in_name(path.name),))
    solid = _solid(path, read_given(path, _MOST_BYTES))
    material = str(terms.get(f"material, {side}", ""))
    return OrderedPiece(number, side, solid, material, _quantity_in(terms))


def _terms_beside(path: Path, files: Sequence[Path]) -> SheetTerms:
    """Return the terms on the job sheet of a single file; empty where there is none."""
    sheet = path.with_name(path.stem + JOB_SHEET.ending)
    if sheet not in files:
        return {}
    return terms_in(read_given(sheet, MOST_BYTES_OF_A_PAPER)) or {}


def _quantity_in(terms: SheetTerms) -> int | None:
    said = str(terms.get("quantity", ""))
    return int(said) if said.isdecimal() and 1 <= int(said) <= MOST_PAIRS else None


def _pieces_of_item(path: Path, item: OrderItem, number: str) -> Iterator[OrderedPiece]:
    for file in item.files:
        if file.role == "solid":
            side = _only_side(file.name, file.sides)
            solid = _solid(Path(file.name), ordered_content(path, file))
            yield OrderedPiece(
                number, side, solid, item.materials[side], item.terms.quantity, item.pseudonym
            )


def _only_side(name: str, sides: Sequence[Side | None]) -> Side:
    if len(sides) != 1 or sides[0] is None:
        raise InputError(
            "{file} holds both sides, which lie in their own block; export the order without a "
            "block to nest it with others.",
            file=name,
        )
    return sides[0]


def _solid(path: Path, content: bytes) -> TriangleMesh:
    suffix = path.suffix.lower()
    if suffix == ".3mf" and is_for_slicer(ZipArchive(path.name, content)):
        raise InputError(
            "{file} has settings and zones for a slicer, which a nest cannot keep; export the "
            "order for any machine to nest it.",
            file=path.name,
        )
    raw = read_raw(ScanContent(path, suffix, content, lambda _name, _most: None))
    solid = merged(TriangleMesh(raw.vertices, raw.triangles))
    return solid.transformed(standing(solid))


def nest_pieces(
    pieces: Sequence[OrderedPiece],
    block: Block,
    *,
    gap_mm: float = GAP_MM,
    margin_mm: float = MARGIN_MM,
    across: bool = True,
    marked: bool = False,
    missing: Sequence[str] = (),
    progress: Progress = SILENT,
) -> DayNest:
    """Place the pieces of several orders on one block.

    Parameters
    ----------
    gap_mm, margin_mm
        Between two pieces, and to the sides of the block, at least: where there is room, a cutter
        finds its way between piece and side too, and something stays there for the tabs.
    across
        Whether pieces may lie across the block too; a router's notes need them along it.
    marked
        Whether order and side are engraved into the underside of each.
    missing
        Numbers of orders that were asked for too, and have no pieces yet.

    Raises
    ------
    InputError
        When there is no piece, or there are too many, or gap, margin or block are out of range.
    DesignError
        When a piece is not closed or too high, or not all find room.
    Cancelled
    """
    _check_sizes(block, gap_mm, margin_mm)
    if missing and not pieces:
        raise InputError(joined(map(_without_solids, missing), " "))
    _check_number(pieces)
    _check_heights(pieces, block)
    notes = [*_missing_notes(missing), *_quantity_notes(pieces), *_material_notes(pieces)]
    if marked:
        pieces, failed = _marked(pieces, progress.part(0.0, 0.3))
        notes += failed
    lying = [(piece, _outlines(piece)) for piece in pieces]
    every = [each for each in lying for _ in range(each[0].quantity or 1)]
    outlines = [max(own, key=_extent) for _, own in every]
    length, width, _ = block.sides_mm
    ways = (_ALONG, _ACROSS, _ALONG + _ACROSS) if across else (_ALONG,)
    steps = progress.part(0.3, 1.0).parts(len(ways))
    tries = [
        pack(
            outlines, (width, length),
            gap_mm=gap_mm, margin_mm=margin_mm, turns=turns, progress=step,
        )
        for turns, step in zip(ways, steps, strict=True)
    ]  # fmt: skip
    best = max(tries, key=lambda found: _worth(found, outlines))
    _require_all(best, block)
    lie = [packed for packed in best if packed is not None]
    step_mm = _step_off_sides(lie, outlines, (width, length), margin_mm)
    nested = tuple(
        NestedPiece(piece, packed, _piece2block(packed), own)
        for (piece, own), packed in zip(every, (one.moved(step_mm) for one in lie), strict=True)
    )
    return DayNest(block, nested, tuple(notes))


def _step_off_sides(
    lie: Sequence[Packed],
    outlines: Sequence[FloatArray],
    size_mm: tuple[float, float],
    margin_mm: float,
) -> FloatArray:
    """Return by how much (2,) pieces in a corner go further in, mm.

    Half the room that is free, until `GAP_MM` lie between them and the sides.
    """
    ends = [one.applied(outline).max(axis=0) for one, outline in zip(lie, outlines, strict=True)]
    free_mm = np.array(size_mm) - margin_mm - np.max(ends, axis=0)
    return np.asarray(np.clip(free_mm / 2, 0.0, max(GAP_MM - margin_mm, 0.0)))


def _check_sizes(block: Block, gap_mm: float, margin_mm: float) -> None:
    if not (0 <= gap_mm <= MOST_GAP_MM and 0 <= margin_mm <= MOST_GAP_MM):
        raise InputError(
            "The pieces are to lie {gap:g} mm apart and {margin:g} mm from the sides, and both "
            "must be 0 to {most:g} mm; correct them.",
            gap=gap_mm,
            margin=margin_mm,
            most=MOST_GAP_MM,
        )
    if not max(block.sides_mm) <= MOST_SIDE_MM:
        raise InputError(
            "A side of {block} is longer than the {most:g} mm that a nest takes; take a smaller "
            "block.",
            block=block.words,
            most=MOST_SIDE_MM,
        )


def _check_number(pieces: Sequence[OrderedPiece]) -> None:
    if not pieces:
        raise InputError("There is nothing to nest; name at least one order.")
    count = sum(piece.quantity or 1 for piece in pieces)
    if count > _MOST_PIECES:
        raise InputError(
            "The orders have {count} pieces, and a nest takes at most {most}; nest fewer orders.",
            count=count,
            most=_MOST_PIECES,
        )


def _check_heights(pieces: Sequence[OrderedPiece], block: Block) -> None:
    highest = max(pieces, key=lambda piece: float(np.ptp(piece.solid.vertices[:, 2])))
    need = float(np.ptp(highest.solid.vertices[:, 2]))
    if need > block.sides_mm[2] + HEIGHT_TOLERANCE_MM:
        raise DesignError(
            "{piece} is {need:.1f} mm high, and the block has {there:g} mm; take a higher block.",
            piece=highest.name,
            need=need,
            there=block.sides_mm[2],
        )


def _missing_notes(numbers: Sequence[str]) -> Iterator[Message]:
    for number in numbers:
        yield Message(
            "Order {number} has no solids and does not lie here; export it, and nest it with the "
            "next ones.",
            number=number,
        )


def _quantity_notes(pieces: Sequence[OrderedPiece]) -> Iterator[Message]:
    for piece in pieces:
        if piece.quantity is None:
            yield Message(
                "{piece} was written without its quantity, and lies here once; compare it with "
                "the order.",
                piece=piece.name,
            )


def _material_notes(pieces: Sequence[OrderedPiece]) -> Iterator[Message]:
    materials = dict.fromkeys(piece.material for piece in pieces if piece.material)
    if len(materials) > 1:
        yield Message(
            "The orders ask for {materials}, and a block is of one material; nest them apart.",
            materials=joined(materials),
        )


def _outlines(piece: OrderedPiece) -> tuple[FloatArray, ...]:
    """Return the outlines (n, 2) of a piece from above, mm."""
    try:
        outlines = silhouette(piece.solid)
    except DesignError:
        outlines = ()
    if not outlines:
        raise DesignError(
            "{piece} is no closed solid: it is open, crosses itself, or is made of layers; export "
            "the order again in one piece.",
            piece=piece.name,
        )
    return outlines


def _extent(outline: FloatArray) -> float:
    return float(np.ptp(outline, axis=0).prod())


def _worth(found: Sequence[Packed | None], outlines: Sequence[FloatArray]) -> tuple[int, float]:
    """Return what makes a nest better: more pieces, then less of the block's length."""
    tops = [
        float(packed.applied(outline)[:, 1].max())
        for packed, outline in zip(found, outlines, strict=True)
        if packed is not None
    ]
    return len(tops), -max(tops, default=0.0)


def _require_all(found: Sequence[Packed | None], block: Block) -> None:
    placed = sum(packed is not None for packed in found)
    if placed < len(found) == 1:
        raise DesignError(
            "The piece finds no room on {block}; take a larger block.", block=block.words
        )
    if placed < len(found):
        raise DesignError(
            "{placed} of {count} pieces find room on {block}; take a larger block, less room "
            "beside the pieces, or fewer orders.",
            placed=placed,
            count=len(found),
            block=block.words,
        )


def _piece2block(packed: Packed) -> FloatArray:
    turn = rotation_about(np.array([0.0, 0, 1]), packed.turn_deg)
    return rigid(turn, np.array([*packed.shift_mm, 0.0]))


def _marked(
    pieces: Sequence[OrderedPiece], progress: Progress
) -> tuple[list[OrderedPiece], list[Message]]:
    """Engrave order and side into the undersides; say where that is impossible."""
    marked, notes = [], []
    for piece, step in zip(pieces, progress.parts(len(pieces)), strict=True):
        step.step(0.0, "Writing the identification")
        try:
            marked.append(replace(piece, solid=_engraved(piece)))
        except DesignError as error:
            marked.append(piece)
            notes.append(
                Message("{piece} carries no mark: {reason}", piece=piece.name, reason=str(error))
            )
    return marked, notes


def _engraved(piece: OrderedPiece) -> TriangleMesh:
    for share, room in _PLACES_OF_MARKS:
        middle = _plain_place(piece.solid, share, room)
        if middle is not None:
            length = float(np.ptp(piece.solid.vertices[:, 1]))
            return mark(
                piece.solid, (piece.order, str(piece.side)),
                centre_mm=middle, room_mm=(MARK_ROOM[0], room * length),
            )  # fmt: skip
    raise DesignError("The underside has other lettering already, or is not flat.")


def _plain_place(solid: TriangleMesh, share: float, room: float) -> tuple[float, float] | None:
    """Return the middle of a place for a mark, mm; None where the underside is not plain there."""
    low, high = solid.bounds_mm
    length = float(high[1] - low[1])
    at = float(low[1]) + share * length
    near = solid.vertices[np.abs(solid.vertices[:, 1] - at) < room / 2 * length]
    above = near[:, 2] - low[2]
    under = near[above < _BOTTOM_MM]
    across = under[:, 0] if len(under) else np.array([low[0], high[0]])
    middle = float(across.min() + across.max()) / 2
    is_relief = (above >= _BOTTOM_MM) & (above < _RELIEF_MM)
    is_relief &= np.abs(near[:, 0] - middle) < _LETTERS_MM
    return None if is_relief.any() else (middle, at)


def places_of_nest(out: Path, milling: MillingChoice | None) -> dict[str, Path]:
    """Return all files that `write_nest` writes, by what they are.

    Those of a program are numbered in their order.
    """
    endings = {"solid": out.suffix, "outlines": OUTLINES.ending, "sheet": NEST_SHEET.ending}
    if milling is not None:
        endings |= {"setup_sheet": SETUP_SHEET.ending}
        if milling.both_sides:
            endings["pin_holes"] = PIN_HOLES.ending
    places = {what: out.with_name(out.stem + ending) for what, ending in endings.items()}
    if milling is not None:
        files = program_paths(_program(out), milling)
        places |= {f"{_PROGRAM}{number}": file for number, file in enumerate(files, 1)}
    return places


def _program(out: Path) -> Path:
    return out.with_name(out.stem + PROGRAM.ending)


def require_no_other_nest(out: Path, title: str, milling: MillingChoice | None) -> None:
    """Check that no files of an earlier program of the same nest lie beside the new ones.

    Also not beside a nest without a program: a shop would run them on the new one.

    Parameters
    ----------
    out, title, milling
        As for `write_nest`.

    Raises
    ------
    OutputError
        Naming those files.
    """
    if milling is not None:
        require_no_other_program(_program(out), milling, title)
        return
    earlier = earlier_programs(_program(out), title)
    sheet = out.with_name(out.stem + SETUP_SHEET.ending)
    if is_there(sheet):
        earlier.append(sheet.name)
    if earlier:
        raise OutputError(
            "Files of an earlier program ({files}) would lie beside {path}, which has none, and a "
            "shop could run them; remove them, or give the nest another name.",
            files=", ".join(earlier),
            path=out.name,
        )


def write_nest(
    nest: DayNest,
    out: Path,
    *,
    title: str,
    milling: MillingChoice | None = None,
    translate: Translate = str,
    progress: Progress = SILENT,
) -> WrittenNest:
    """Write solids, outlines and sheet of a nest, and the program of a router: all or nothing.

    Parameters
    ----------
    out
        File of the solids; its name is that of the others.
    title
        Names the nest on papers and in the program; never a patient.
    milling
        None for no router.
    translate
        Into the language of the papers.

    Raises
    ------
    UsageError
        When the suffix is no format of solids.
    DesignError
        When block, machine or a cutter is too small.
    OutputError
        When a place cannot be written, or files of an earlier program lie beside it.
    Cancelled
    """
    from insole_core.export.paper import write_nest_sheet

    require_no_other_nest(out, title, milling)
    places = places_of_nest(out, milling)
    plan = None if milling is None else _plan(nest, milling, progress.part(0.0, 0.6))
    notes = nest.notes if plan is None else (*nest.notes, *plan.notes)
    progress = progress if plan is None else progress.part(0.6, 1.0)
    with Transaction() as transaction:
        beside = {what: transaction.file(path) for what, path in places.items()}
        progress.step(0.0, "Writing the file")
        write_solids(
            [SolidPart(each.solid, each.piece.name) for each in nest.pieces],
            beside["solid"], label=title,
        )  # fmt: skip
        progress.step(0.1, "Writing the outlines")
        _write_outlines(nest, beside["outlines"])
        progress.step(0.2, "Writing the nest sheet")
        write_nest_sheet(
            _nesting(nest, translate), _facts(nest, title, places, translate), beside["sheet"],
            notes=[translate(note) for note in notes], translate=translate,
        )  # fmt: skip
        if plan is not None:
            write_milling(
                plan, nest.block, _export_paths(places), _export_paths(beside),
                identification={"pseudonym": title, "date": date.today().isoformat()},
                translate=translate, progress=progress.part(0.3, 1.0),
            )  # fmt: skip
    return WrittenNest(tuple(places.values()), notes)


def _write_outlines(nest: DayNest, path: Path) -> None:
    outlines: list[DxfOutline] = []
    marks: list[DxfText] = []
    for each in nest.pieces:
        lines = [DxfOutline("INSOLE", polygon) for polygon in each.outlines]
        outlines += lines
        marks.append(mark_text(each.piece.name, lines))
    width, length, _ = nest.block_mm
    outlines.append(block_outline(nest.block, (width / 2, length / 2)))
    write_dxf(outlines, marks, path)


def _facts(
    nest: DayNest, title: str, places: Mapping[str, Path], translate: Translate
) -> dict[str, str]:
    programs = (what for what in places if what.startswith(_PROGRAM))
    shown = ("solid", "outlines", "pin_holes", *programs, "setup_sheet")
    return {
        "nest": title,
        "date": date.today().isoformat(),
        "stock": translate(nest.block.words),
        "pieces": str(len(nest.pieces)),
        "files": ", ".join(places[what].name for what in shown if what in places),
    }


def _nesting(nest: DayNest, translate: Translate) -> Nesting:
    from insole_core.export.paper import NestedPart, Nesting

    parts = []
    for number, each in enumerate(nest.pieces, 1):
        solid, piece = each.solid, each.piece
        name = translate(
            Message(
                "{number}: {mark}, {side}",
                number=number,
                mark=piece.order,
                side=Message(str(piece.side)),
            )
        )
        parts.append(
            NestedPart(
                name=name,
                heights=survey_heights(solid),
                bounds_mm=solid.bounds_mm,
                turn_deg=each.packed.turn_deg,
                material=translate(Message(piece.material)) if piece.material else "",
                label=str(number),
            )
        )
    return Nesting(nest.block.words, nest.block_mm, tuple(parts))


def _plan(nest: DayNest, milling: MillingChoice, progress: Progress) -> MillingPlan:
    return plan_milling(
        [each.solid for each in nest.pieces], nest.block_mm, milling.machine,
        both_sides=milling.both_sides,
        feet=[
            FootInBlock(each.piece.side, each.packed.turn_deg == 180, each.piece.order)
            for each in nest.pieces
        ],
        progress=progress,
    )  # fmt: skip


def _export_paths(places: Mapping[str, Path]) -> ExportPaths:
    return ExportPaths(
        places["solid"],
        programs=tuple(path for what, path in places.items() if what.startswith(_PROGRAM)),
        setup_sheet=places.get("setup_sheet"),
        pin_holes=places.get("pin_holes"),
    )
