"""The options of `insole-studio design` for a certain slicer: settings, and zones of the infill."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError

if TYPE_CHECKING:
    from insole_core.geometry.side import Side
    from insole_core.pressure.laid_map import PressureMap
    from insole_core.solids.export_job import Printing
    from insole_core.solids.order import Part
    from insole_core.workflows.print_order import PrintChoice


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    group = parser.add_argument_group("print")
    group.add_argument(
        "--printer", choices=["prusaslicer", "orca", "cura"],
        help="write the 3MF with zones for this program (orca: Bambu Studio, too)",
    )  # fmt: skip
    group.add_argument(
        "--zones", type=Path, metavar="zones.json", help="densities by zone, for --printer"
    )
    group.add_argument(
        "--print-preset", metavar="NAME", help="densities of the table, in place of --zones"
    )
    group.add_argument(
        "--print-presets", type=Path, metavar="presets.json", help="the clinic's own table"
    )
    group.add_argument(
        "--graded", action="store_true", default=None,
        help="change the density in steps at the borders of zones",
    )  # fmt: skip
    group.add_argument(
        "--pressure-of", type=Path, metavar="CASE", help="case whose map of pressures zones follow"
    )


def check(arguments: argparse.Namespace) -> None:
    """Refuse options that contradict each other, and zones that cannot be read, before the work."""
    from insole_core.solids.export_job import require_3mf

    if arguments.printer is None:
        for name in ("zones", "print_preset", "print_presets", "graded", "pressure_of"):
            if getattr(arguments, name) is not None:
                option = f"--{name.replace('_', '-')}"
                raise UsageError(f"{option} is for a print; name the program with --printer.")
        return
    require_3mf(arguments.out)
    if (arguments.zones is None) == (arguments.print_preset is None):
        raise UsageError("--printer needs either --zones or --print-preset; give one of them.")
    if arguments.layers:
        raise UsageError(
            "--layers makes objects of the layers, and with --printer they are zones; leave out "
            "--layers and name the layers in --zones."
        )
    from insole_core.solids.print_presets import read_print_presets
    from insole_core.workflows.print_order import plan_print

    plan_print(_choice(arguments), read_print_presets(arguments.print_presets))


def printing(parts: Sequence[Part], arguments: argparse.Namespace) -> Printing | None:
    """Make the zones of all parts, and print what is to be known of them; None without --printer.

    Raises
    ------
    DesignError
        If a zone cannot be made.
    """
    from insole_core.solids.print_presets import read_print_presets
    from insole_core.workflows.print_order import zoned_print

    if arguments.printer is None:
        return None
    made = zoned_print(
        parts,
        _choice(arguments),
        read_print_presets(arguments.print_presets),
        _maps(arguments.pressure_of),
    )
    for note in made.notes:
        print(f"Note: {note}", file=sys.stderr)
    return made


def _choice(arguments: argparse.Namespace) -> PrintChoice:
    from insole_core.workflows.print_order import PrintChoice

    graded = bool(arguments.graded)
    if arguments.zones is None:
        return PrintChoice(arguments.printer, arguments.print_preset, graded=graded)
    file = str(arguments.zones)
    return PrintChoice(arguments.printer, zones="file", file=file, graded=graded)


def _maps(case: Path | None) -> dict[Side, PressureMap]:
    from insole_core.cases.case_file import read_case
    from insole_core.workflows.print_order import pressure_maps

    return {} if case is None else pressure_maps(read_case(case).feet)
