"""The options of `insole-studio design` for the shoe that the insole is to lie in."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.formats.file_formats import SCAN_SUFFIXES

if TYPE_CHECKING:
    from insole_core.geometry.side import Side
    from insole_core.insole.prescription.design import InsoleDesign
    from insole_core.insole.prescription.shoe import Shoe


def add_arguments(parser: argparse.ArgumentParser) -> None:
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


def check(arguments: argparse.Namespace) -> None:
    """Refuse options that need another one."""
    if arguments.shoe is None:
        for name in ("shoe_width", "shoe_table", "trim_to_shoe"):
            if getattr(arguments, name):
                raise UsageError(f"--{name.replace('_', '-')} needs a shoe; name it with --shoe.")
    elif arguments.shoe_width and _is_file(arguments.shoe):
        raise UsageError("--shoe-width is for a size, and a last has its own; leave it out.")


def in_shoe(design: InsoleDesign, arguments: argparse.Namespace, *, either: bool) -> InsoleDesign:
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
