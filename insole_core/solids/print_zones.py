"""What is printed how: the plan of a print with its zones, and its file zones.json.

The format is described in docs/formats/zones.md.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, TypeAlias, get_args

from insole_core.errors import UsageError
from insole_core.formats.slicer_3mf import (
    PATTERNS,
    PRINTER_NAMES,
    Infill,
    Pattern,
    Printer,
    can_print,
)
from insole_core.geometry.side import Side
from insole_core.insole.prescription.materials import WEIGHT
from insole_core.json_object import JsonObject
from insole_core.messages import Message
from insole_core.solids.print_presets import (
    LEAST_PERCENT,
    MOST_PERCENT,
    MOST_WALLS,
    REGIONS,
    USUAL_G_PER_CM3,
    USUAL_LAYER_MM,
    USUAL_WEIGHT_KG,
    PrintPreset,
    read_print_presets,
    require_keys,
)

FORMAT, VERSION = "insole-zones", 1
ZoneKind: TypeAlias = Literal[
    "heel", "arch", "forefoot", "cover", "shell", "base", "pad", "pressure"
]
ZONE_KINDS: tuple[ZoneKind, ...] = get_args(ZoneKind)
_MOST_KPA = 5000.0
_MOST_ZONES = 50
"""Graded, the borders of so many have some thousands of strips."""


@dataclass(frozen=True)
class Zone:
    """A part of the insole that is printed at another density.

    Parameters
    ----------
    kind
        A third of the foot, a layer of the design, a pad, or where the pressure lies in a range.
    pad
        Name of the pad, as the window has it in English; empty for every pad.
    kpa
        Least and greatest pressure of a zone of pressure.
    side
        Of which foot; None for both.
    """

    kind: ZoneKind
    infill: Infill
    pad: str = ""
    kpa: tuple[float, float] = (0.0, math.inf)
    side: Side | None = None

    @property
    def name(self) -> str:
        """What the zone is called in sentences and in the file; English, to be translated."""
        if self.kind == "pad":
            return self.pad or "pads"
        if self.kind == "pressure":
            low, high = self.kpa
            if math.isinf(high):
                return Message("from {low:g} kPa", low=low)
            return Message("{low:g} to {high:g} kPa", low=low, high=high)
        return self.kind


@dataclass(frozen=True)
class PrintPlan:
    """Settings of a print: shell, density of the rest, and zones.

    Parameters
    ----------
    zones
        Where two overlap, the later one is obeyed.
    layer_mm, g_per_cm3
        Height of the layers and mass of the material, for what is told of the print.
    graded
        Whether the density changes in steps at the borders of zones.
    """

    walls: int
    top_layers: int
    bottom_layers: int
    rest: Infill
    zones: tuple[Zone, ...]
    layer_mm: float = USUAL_LAYER_MM
    g_per_cm3: float = USUAL_G_PER_CM3
    graded: bool = False


def plan_of(
    preset: PrintPreset,
    weight_kg: float | None = None,
    zones: Sequence[Zone] = (),
    *,
    walls: int | None = None,
    rest: Infill | None = None,
) -> PrintPlan:
    """Return the plan of a preset: heel, arch and forefoot by its table, then the zones given.

    Parameters
    ----------
    weight_kg
        None for a usual one.
    zones
        One of heel, arch or forefoot for both feet takes the place of that of the table.
    walls, rest
        In place of those of the preset.
    """
    weight = USUAL_WEIGHT_KG if weight_kg is None else weight_kg
    given = {zone.kind for zone in zones if zone.side is None}
    of_table = tuple(
        Zone(region, Infill(preset.density_percent(region, weight), preset.pattern))
        for region in REGIONS
        if region not in given
    )
    return PrintPlan(
        preset.walls if walls is None else walls,
        preset.top_layers,
        preset.bottom_layers,
        rest or Infill(preset.density_percent("rest", weight), preset.pattern),
        (*of_table, *zones),
        preset.layer_mm,
        preset.g_per_cm3,
    )


def require_printable(plan: PrintPlan, printer: Printer) -> None:
    """Check that a slicer has the patterns of a plan.

    Raises
    ------
    UsageError
        Naming the first pattern that it does not have.
    """
    for infill in (plan.rest, *(zone.infill for zone in plan.zones)):
        if not can_print(printer, infill.used_pattern):
            raise UsageError(
                "{printer} has no pattern {pattern}; choose another pattern, such as gyroid, or "
                "another printer.",
                printer=PRINTER_NAMES[printer],
                pattern=infill.used_pattern,
            )


def read_zones(
    path: Path,
    presets: Sequence[PrintPreset] | None = None,
    weight_kg: float | None = None,
) -> PrintPlan:
    """Read zones.json.

    Parameters
    ----------
    presets
        By default those of the product.
    weight_kg
        Of the patient, where the file states none; None for a usual one.

    Raises
    ------
    InputError
        Naming the file and the key that is missing or wrong.
    """
    root = JsonObject.read(path)
    root.check_format(FORMAT, VERSION)
    require_keys(
        root, ("format", "version", "preset", "weight_kg", "walls", "rest", "graded", "zones")
    )
    known = {preset.name: preset for preset in presets or read_print_presets()}
    preset = known[root.choice("preset", tuple(known))]
    zones = tuple(_zone(item, preset.pattern) for item in root.objects("zones"))
    _require_few(root, zones)
    _require_single(root, zones)
    plan = plan_of(
        preset,
        root.number("weight_kg", WEIGHT.least, WEIGHT.greatest)
        if root.has("weight_kg")
        else weight_kg,
        zones,
        walls=root.integer("walls", 1, MOST_WALLS) if root.has("walls") else None,
        rest=_rest(root.object("rest"), preset.pattern) if root.has("rest") else None,
    )
    return replace(plan, graded=root.flag("graded") if root.has("graded") else False)


def _rest(item: JsonObject, pattern: Pattern) -> Infill:
    require_keys(item, ("density_percent", "pattern"))
    return _infill(item, pattern)


def _infill(item: JsonObject, pattern: Pattern) -> Infill:
    return Infill(
        item.number("density_percent", LEAST_PERCENT, MOST_PERCENT),
        item.choice("pattern", PATTERNS) if item.has("pattern") else pattern,
    )


def _zone(item: JsonObject, pattern: Pattern) -> Zone:
    kind = item.choice("zone", ZONE_KINDS)
    own: dict[str, tuple[str, ...]] = {"pad": ("pad",), "pressure": ("from_kpa", "to_kpa")}
    require_keys(item, ("zone", "density_percent", "pattern", "side", *own.get(kind, ())))
    return Zone(
        kind,
        _infill(item, pattern),
        pad=item.text("pad") if item.has("pad") else "",
        kpa=_range(item) if kind == "pressure" else (0.0, math.inf),
        side=Side(item.choice("side", tuple(map(str, Side)))) if item.has("side") else None,
    )


def _range(item: JsonObject) -> tuple[float, float]:
    low = item.number("from_kpa", 0, _MOST_KPA)
    high = item.number("to_kpa", 0, _MOST_KPA) if item.has("to_kpa") else math.inf
    if high <= low:
        raise item.fail("to_kpa", "must be above from_kpa")
    return low, high


def _require_few(root: JsonObject, zones: Sequence[Zone]) -> None:
    """Refuse more zones than a slicer could be given."""
    if len(zones) > _MOST_ZONES:
        raise root.fail(
            "zones",
            "has {count} zones, and a print may have {most}; put some of them together",
            count=len(zones),
            most=_MOST_ZONES,
        )


def _require_single(root: JsonObject, zones: Sequence[Zone]) -> None:
    """Refuse two zones of one name, of which only one could be obeyed."""
    for number, zone in enumerate(zones):
        for other in zones[:number]:
            sides = {zone.side, other.side}
            if zone.name == other.name and (len(sides) == 1 or None in sides):
                raise root.fail(
                    "zones", "names {name} twice; keep one of them", name=f'"{zone.name}"'
                )
