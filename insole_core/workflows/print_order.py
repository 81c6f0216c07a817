"""From ordered parts to a print: which printer, which preset, and where its zones come from."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, TypeAlias

from insole_core.cases.case_record import FootRecord
from insole_core.errors import UsageError
from insole_core.formats.slicer_3mf import Infill, Printer
from insole_core.geometry.side import Side
from insole_core.pressure.laid_map import PressureMap
from insole_core.progress import SILENT, Progress
from insole_core.solids.export_job import Printing
from insole_core.solids.order import Part
from insole_core.solids.print_density import printed_densities
from insole_core.solids.print_presets import PrintPreset
from insole_core.solids.print_zones import (
    PrintPlan,
    Zone,
    plan_of,
    read_zones,
    require_printable,
)
from insole_core.solids.zone_bodies import zoned_part

ZoneSource: TypeAlias = Literal["table", "pressure", "file"]


@dataclass(frozen=True)
class PrintChoice:
    """What is chosen for a print.

    Parameters
    ----------
    preset
        Name in the table of presets; a file of zones names its own.
    zones
        Heel, arch and forefoot by the table; these, and another density where the pressure is
        high; or a file of zones.
    file
        The file of zones; empty while none is chosen.
    above_kpa, pressed_percent
        From which pressure on another density is printed, and which.
    weight_kg
        In place of the body weight of the prescription; None for that one.
    graded
        Whether the density changes in steps at the borders of zones, also where a file of zones
        does not say so.
    """

    printer: Printer = "prusaslicer"
    preset: str = "TPU, Shore 85"
    zones: ZoneSource = "table"
    file: str = ""
    above_kpa: float = 200.0
    pressed_percent: float = 10.0
    weight_kg: float | None = None
    graded: bool = False


def plan_print(
    choice: PrintChoice, presets: Sequence[PrintPreset], prescribed_kg: float | None = None
) -> PrintPlan:
    """Return the plan of a print.

    Parameters
    ----------
    presets
        The table.
    prescribed_kg
        Body weight of the prescription; None if it states none.

    Raises
    ------
    InputError
        If the file of zones cannot be used.
    UsageError
        If no file is chosen, the table lacks the preset, or the printer a pattern.
    """
    weight_kg = prescribed_kg if choice.weight_kg is None else choice.weight_kg
    if choice.zones == "file":
        if not choice.file:
            raise UsageError("No file of zones is chosen; choose one, or take the table.")
        plan = read_zones(Path(choice.file), presets, weight_kg)
    else:
        preset = _named(presets, choice.preset)
        pressed = Zone(
            "pressure",
            Infill(choice.pressed_percent, preset.pattern),
            kpa=(choice.above_kpa, math.inf),
        )
        plan = plan_of(preset, weight_kg, (pressed,) if choice.zones == "pressure" else ())
    require_printable(plan, choice.printer)
    return replace(plan, graded=plan.graded or choice.graded)


def zoned_print(
    parts: Sequence[Part],
    choice: PrintChoice,
    presets: Sequence[PrintPreset],
    maps: Mapping[Side, PressureMap],
    progress: Progress = SILENT,
) -> Printing:
    """Make the zones of all parts.

    Parameters
    ----------
    maps
        Pressures under the feet, for zones of pressure.

    Raises
    ------
    DesignError
        If a zone cannot be made.
    InputError, UsageError
        As for `plan_print`.
    Cancelled
    """
    zoned, densities = {}, {}
    for number, part in enumerate(parts):
        progress.step(number / len(parts), "Making the zones")
        shell = part.insole.design.shell
        plan = plan_print(choice, presets, None if shell is None else shell.body_weight_kg)
        made = zoned_part(part, plan, maps.get(part.side))
        progress.step((number + 0.5) / len(parts), "Weighing the print")
        zoned[part.side] = made
        densities[part.side] = printed_densities(made.printed, plan.layer_mm, plan.g_per_cm3)
    return Printing(choice.printer, zoned, densities)


def pressure_maps(feet: Sequence[FootRecord]) -> dict[Side, PressureMap]:
    """Return the maps that lie under the feet of a case."""
    return {foot.side: foot.plantar.pressure for foot in feet if foot.plantar.pressure is not None}


def _named(presets: Sequence[PrintPreset], name: str) -> PrintPreset:
    found = next((preset for preset in presets if preset.name == name), None)
    if found is None:
        raise UsageError(
            'The table of presets has no "{name}"; choose one of {known}.',
            name=name,
            known=", ".join(f'"{preset.name}"' for preset in presets),
        )
    return found
