"""``insole-studio order nest``: the pieces of several orders on one block or sheet."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.messages import counted
from insole_core.progress import Progress
from insole_core.visible_text import visible_line
from insole_studio.cli.argument_parser import Step, check_within, number
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.records.arguments import add_language, wording_of

if TYPE_CHECKING:
    from insole_core.solids.shop import Block
    from insole_core.workflows.mill import MillingChoice
    from insole_core.workflows.nest_orders import OrderedPiece

_SIZE = re.compile(r"(\d+(?:\.\d+)?)[x×](\d+(?:\.\d+)?)[x×](\d+(?:\.\d+)?)")


def _size(text: str) -> tuple[float, float, float]:
    found = _SIZE.fullmatch(text)
    if found is None or min(map(float, found.groups())) <= 0:
        raise argparse.ArgumentTypeError(
            f'"{text}" is no size; write length, width and height in mm as 1000x600x30'
        )
    length, width, height = map(float, found.groups())
    return length, width, height


def _add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("orders", type=Path, nargs="+", metavar="FOLDER|ORDER.zip")
    parser.add_argument(
        "--out", action=OutputPath, required=True, metavar="nest.3mf",
        help="the solids; outlines (.dxf), sheet (.pdf) and program are written beside it",
    )  # fmt: skip
    place = parser.add_mutually_exclusive_group(required=True)
    place.add_argument("--block", metavar="NAME", help="of the shop's list")
    place.add_argument(
        "--size", type=_size, metavar="1000x600x30", help="length, width and height in mm"
    )
    parser.add_argument(
        "--gap", type=number, default=12.0, metavar="MM", help="between pieces (default: 12)"
    )
    parser.add_argument(
        "--margin", type=number, default=4.0, metavar="MM", help="to the sides (default: 4)"
    )
    parser.add_argument(
        "--mark", action="store_true", help="engrave order and side into the undersides"
    )
    parser.add_argument(
        "--machine", metavar="NAME", help="write the program of this router too; or a machine file"
    )
    parser.add_argument("--both-sides", action="store_true", help="turn the block, on two dowels")
    parser.add_argument("--title", metavar="TEXT", help="of the nest (default: the name of --out)")
    add_language(parser)
    parser.add_argument("--shop", type=Path, metavar="shop.json", help="its blocks")


def _run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the orders, nest their pieces, and write everything."""
    from insole_core.formats.file_formats import check_solid_suffix
    from insole_core.workflows import nest_orders
    from insole_core.workflows.overwriting import check_overwriting

    check_solid_suffix(arguments.out, "the nest")
    check_within("--gap", arguments.gap, 0, nest_orders.MOST_GAP_MM, "mm")
    check_within("--margin", arguments.margin, 0, nest_orders.MOST_GAP_MM, "mm")
    milling = _milling(arguments)
    block = _block(arguments)
    check_overwriting(nest_orders.places_of_nest(arguments.out, milling).values(), arguments.orders)
    title = arguments.title or arguments.out.stem
    nest_orders.require_no_other_nest(arguments.out, title, milling)
    pieces = nest_orders.gathered(_read(arguments.orders, progress.part(0.0, 0.2)))
    nest = nest_orders.nest_pieces(
        pieces, block,
        gap_mm=arguments.gap, margin_mm=arguments.margin,
        across=milling is None, marked=arguments.mark, progress=progress.part(0.2, 0.6),
    )  # fmt: skip
    written = nest_orders.write_nest(
        nest, arguments.out,
        title=title, milling=milling,
        translate=wording_of(arguments).translate, progress=progress.part(0.6, 1.0),
    )  # fmt: skip
    for note in written.notes:
        print(visible_line(f"Warning: {note}"), file=sys.stderr)
    names = ", ".join(path.name for path in written.paths)
    nested = counted(len(nest.pieces), "1 piece", "{count} pieces")
    progress.step(1.0, f"Done: {nested} on {block.words}: {names}")


def _read(paths: Sequence[Path], progress: Progress) -> Iterator[Iterator[OrderedPiece]]:
    from insole_core.workflows.nest_orders import pieces_of_order

    for path, step in zip(paths, progress.parts(len(paths)), strict=True):
        step.step(0.0, f"Reading {path.name}")
        yield pieces_of_order(path)


def _milling(arguments: argparse.Namespace) -> MillingChoice | None:
    from insole_core.workflows.mill import MillingChoice, find_machine
    from insole_studio.user_paths import UserPaths

    if arguments.machine is None:
        if arguments.both_sides:
            raise UsageError("--both-sides is for a router; name it with --machine.")
        return None
    machine = find_machine(arguments.machine, UserPaths.of_user().settings_folder)
    return MillingChoice(machine, arguments.both_sides)


def _block(arguments: argparse.Namespace) -> Block:
    from insole_core.solids.shop import Block, read_shop
    from insole_studio.cli.export_arguments import find_block

    if arguments.size is not None:
        return Block("sheet", arguments.size)
    return find_block(read_shop(arguments.shop), arguments.block)


NEST = Step(
    "nest",
    "lay the pieces of one or more orders on one block or sheet, for a router, cutter or printer",
    _add_arguments,
    _run,
)
