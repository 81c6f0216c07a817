"""``insole-studio design``: build an insole from a foot, without a window."""

from __future__ import annotations

import argparse
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.formats.file_formats import SCAN_SUFFIXES, SOLID_SUFFIXES, check_solid_suffix
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_studio.cli import devices, export_arguments, foot_argument
from insole_studio.cli.path_arguments import OutputPath, side_path

if TYPE_CHECKING:
    from insole_core.foot.foot import Foot
    from insole_core.insole.build import Insole
    from insole_core.insole.prescription.design import InsoleDesign
    from insole_core.insole.prescription.outline import Shoe

NAME = "design"
HELP = "make the insole of a session or a scanned foot, for the shop"


def _add_shoe_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    group = parser.add_argument_group("shoe")
    group.add_argument(
        "--shoe", metavar="SHOE",
        help='the shoe that the insole is for: the file of its last, or a size such as "EU 42", '
        '"UK 8", "US men 9", "US women 8", "mondopoint 265"',
    )  # fmt: skip
    group.add_argument(
        "--shoe-width", metavar="WIDTH",
        help="narrow, regular, wide, extra wide, or mm inside at the ball; for a size",
    )  # fmt: skip
    group.add_argument(
        "--shoe-table", type=Path, metavar="sizes.json", help="the clinic's own table of sizes"
    )
    group.add_argument(
        "--trim-to-shoe", action="store_true", help="cut off what is wider than the shoe"
    )


def _check_shoe(arguments: argparse.Namespace) -> None:
    """Refuse options that need another one."""
    if arguments.shoe is None:
        for name in ("shoe_width", "shoe_table", "trim_to_shoe"):
            if getattr(arguments, name):
                raise UsageError(f"--{name.replace('_', '-')} needs a shoe; name it with --shoe.")
    elif arguments.shoe_width and _is_file(arguments.shoe):
        raise UsageError("--shoe-width is for a size, and a last has its own; leave it out.")


def _in_shoe(design: InsoleDesign, arguments: argparse.Namespace, *, either: bool) -> InsoleDesign:
    """Return a design for the shoe that the arguments name; without one the design itself.

    Parameters
    ----------
    either
        Whether both feet get insoles, so that the last of either foot serves.
    """
    from insole_core.workflows.shoe_choice import with_shoe

    shoe = _shoe(design.side, arguments, either=either)
    if shoe is None:
        return design
    return with_shoe(design, replace(shoe, trim=arguments.trim_to_shoe))


def _shoe(side: Side, arguments: argparse.Namespace, *, either: bool) -> Shoe | None:
    from insole_core.insole.shoes.shoe_sizes import REGULAR, read_shoe_table, said_size
    from insole_core.workflows.shoe_choice import shoe_of_last

    if arguments.shoe is None:
        return None
    if _is_file(arguments.shoe):
        return shoe_of_last(Path(arguments.shoe), side, either=either)
    table = read_shoe_table(arguments.shoe_table)
    system, size = said_size(arguments.shoe, table)
    width = arguments.shoe_width or REGULAR
    return table.shoe(system, size, width, _millimetres(width))


def _is_file(shoe: str) -> bool:
    return Path(shoe).suffix.lower() in SCAN_SUFFIXES or Path(shoe).exists()


def _millimetres(width: str) -> float | None:
    """Return a width in mm; None for a word."""
    try:
        return float(width.replace(",", "."))
    except ValueError:
        return None


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "foot", type=Path, metavar="FOOT", help=f"a session, or {foot_argument.A_MESH}"
    )
    parser.add_argument(
        "--out",
        action=OutputPath,
        required=True,
        metavar="insole.stl",
        help=f"{' '.join(SOLID_SUFFIXES)}; of a session of both feet insole_left.stl and "
        "insole_right.stl",
    )
    parser.add_argument("--prescription", type=Path, metavar="design.json")
    parser.add_argument(
        "--pair", type=Path, metavar="FOOT", help="the other foot, nested into one --block"
    )
    parser.add_argument("--pair-prescription", type=Path, metavar="design.json")
    parser.add_argument(
        "--kind", choices=["insole", "block", "positive"], default="insole",
        help="the insole (default), the contact surface in a block, or the foot as a mould",
    )  # fmt: skip
    devices.add_prescription_arguments(parser)
    _add_shoe_arguments(parser)
    foot_argument.add_arguments(parser, reads_both=True)
    export_arguments.add_arguments(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the foot, build the insole and write it."""
    check_solid_suffix(arguments.out)
    _check_shoe(arguments)
    if arguments.pair is not None and arguments.block is None:
        raise UsageError("--pair nests two insoles into one block; name it with --block.")
    feet = _feet(arguments)
    if len(feet) == 1 or arguments.block is not None:
        orders = [(arguments, feet)]
    else:
        arguments.pseudonym = export_arguments.pseudonym(arguments)  # one for the pair
        orders = [(_of_side(arguments, foot.side), [foot]) for foot in feet]
    with ExitStack() as opened:
        beside = [opened.enter_context(export_arguments.outputs(one)) for one, _ in orders]
        read: dict[Side, Foot] = {}
        if len(feet) == 2 and arguments.pair is None:
            reading, progress = progress.part(0.0, 0.5), progress.part(0.5, 1.0)
            read = foot_argument.read_feet(arguments.foot, arguments, reading)
        parts = progress.parts(len(orders))
        for (one, wanted), places, part in zip(orders, beside, parts, strict=True):
            insoles: list[Insole] = []
            for foot, step in zip(wanted, part.part(0.0, 0.8).parts(len(wanted)), strict=True):
                other = insoles[0].design.side.other if insoles else foot.side
                side = _agreed_side(other, foot.prescription)
                known = None if side is None else read.get(side)
                insoles.append(_insole(replace(foot, side=side), known, one, step))
            insoles.sort(key=lambda insole: insole.design.side is Side.RIGHT)
            export_arguments.deliver(tuple(insoles), one, places, part.part(0.8, 1.0))
    progress.step(1.0, f"Done: {' '.join(str(one.out) for one, _ in orders)}")


@dataclass(frozen=True)
class _Wanted:
    """A foot that gets an insole.

    Parameters
    ----------
    side
        None for what the scan says, or for the other one of the first foot.
    is_one_of_two
        Whether both feet get insoles.
    """

    path: Path
    side: Side | None
    prescription: InsoleDesign | None
    is_one_of_two: bool = False


def _feet(arguments: argparse.Namespace) -> list[_Wanted]:
    """Return the feet of the call: one, one and its pair, or both of a session."""
    given = _read_prescription(arguments.prescription)
    side = _agreed_side(None if arguments.side is None else Side(arguments.side), given)
    first = _Wanted(arguments.foot, side, given)
    if arguments.pair is not None:
        other = _read_prescription(arguments.pair_prescription)
        second = _Wanted(arguments.pair, None, other, is_one_of_two=True)
        return [replace(first, is_one_of_two=True), second]
    if side is not None:
        return [first]
    sides = foot_argument.recorded_sides(arguments.foot)
    if len(sides) < 2:
        return [first]
    return [replace(first, side=one, is_one_of_two=True) for one in sides]


def _of_side(arguments: argparse.Namespace, side: Side | None) -> argparse.Namespace:
    """Return the call with the names of its results saying the side."""
    assert side is not None, "of two feet the sides are known"
    results = ("out", "checks", "job_sheet", "prescription_paper")
    named = {key: path for key in results if (path := getattr(arguments, key)) is not None}
    paths = {key: side_path(path, side, tuple(Side)) for key, path in named.items()}
    return argparse.Namespace(**{**vars(arguments), **paths})


def _insole(
    wanted: _Wanted, foot: Foot | None, arguments: argparse.Namespace, progress: Progress
) -> Insole:
    """Read a foot, unless it is read, and build its insole, printing what the scan warns of."""
    from insole_core.insole.build import build_insole

    if foot is None:
        reading = progress.part(0.0, 0.8)
        foot = foot_argument.read_foot(wanted.path, wanted.side, arguments, reading)
    design = devices.prescribed(foot, wanted.prescription, arguments)
    design = _in_shoe(design, arguments, either=wanted.is_one_of_two)
    return build_insole(foot, design, progress.part(0.8, 1.0))


def _read_prescription(path: Path | None) -> InsoleDesign | None:
    from insole_core.insole.prescription.design_json import read_design

    return None if path is None else read_design(path)


def _agreed_side(side: Side | None, design: InsoleDesign | None) -> Side | None:
    """Return the side that the arguments and the prescription agree on, if they name one."""
    if design is None:
        return side
    if side not in (None, design.side):
        raise UsageError(
            f"--side is {side}, but the prescription is for the {design.side} foot; "
            "correct one of the two."
        )
    return design.side
