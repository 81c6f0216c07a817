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
    from insole_core.solids.print_presets import PrintPreset
    from insole_core.solids.print_zones import PrintPlan


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
        "--pressure-of", type=Path, metavar="CASE", help="case whose map of pressures zones follow"
    )


def check(arguments: argparse.Namespace) -> None:
    """Refuse options that contradict each other, and zones that cannot be read, before the work."""
    from insole_core.solids.export_job import require_3mf

    if arguments.printer is None:
        for name in ("zones", "print_preset", "print_presets", "pressure_of"):
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
    _plan(arguments, None)


def printing(parts: Sequence[Part], arguments: argparse.Namespace) -> Printing | None:
    """Make the zones of all parts, and print what is to be known of them; None without --printer.

    Raises
    ------
    DesignError
        If a zone cannot be made.
    """
    from insole_core.solids.export_job import Printing
    from insole_core.solids.zone_bodies import zoned_part

    if arguments.printer is None:
        return None
    maps = _maps(arguments.pressure_of)
    zoned = {}
    for part in parts:
        shell = part.insole.design.shell
        plan = _plan(arguments, None if shell is None else shell.body_weight_kg)
        zoned[part.side] = zoned_part(part, plan, maps.get(part.side))
    for note in dict.fromkeys(note for each in zoned.values() for note in each.notes):
        print(f"Note: {note}", file=sys.stderr)
    return Printing(arguments.printer, zoned)


def _plan(arguments: argparse.Namespace, weight_kg: float | None) -> PrintPlan:
    """Return the plan; the weight is that of the prescription, which the file may overrule."""
    from insole_core.solids.print_presets import read_print_presets
    from insole_core.solids.print_zones import plan_of, read_zones, require_printable

    presets = read_print_presets(arguments.print_presets)
    if arguments.zones is not None:
        plan = read_zones(arguments.zones, presets, weight_kg)
    else:
        plan = plan_of(_preset(presets, arguments.print_preset), weight_kg)
    require_printable(plan, arguments.printer)
    return plan


def _preset(presets: Sequence[PrintPreset], name: str) -> PrintPreset:
    found = next((preset for preset in presets if preset.name == name), None)
    if found is None:
        known = ", ".join(f'"{preset.name}"' for preset in presets)
        raise UsageError(
            f'--print-preset is "{name}", and the table has {known}; choose one of them.'
        )
    return found


def _maps(case: Path | None) -> dict[Side, PressureMap]:
    from insole_core.cases.case_file import read_case

    if case is None:
        return {}
    return {
        foot.side: foot.plantar.pressure
        for foot in read_case(case).feet
        if foot.plantar.pressure is not None
    }
