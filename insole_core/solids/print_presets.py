"""Walls and densities of a printed insole by material and body weight.

They stand in resources/rules/print_presets.json. No publication gives a rule from body weight to
density that holds for any printer, so the figures are a clinic's own judgement, for it to change.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Literal, TypeAlias, get_args

from insole_core.formats.slicer_3mf import PATTERNS, Pattern
from insole_core.insole.prescription.materials import WEIGHT
from insole_core.json_object import JsonObject
from insole_core.resources import resource_path

FORMAT, VERSION = "insole-print-presets", 1
LEAST_PERCENT, MOST_PERCENT = 5.0, 100.0
"""Densities that slicers print; below, the upper skin has nothing to lie on."""
MOST_WALLS, MOST_LAYERS = 20, 50
LAYERS_MM, USUAL_LAYER_MM = (0.05, 1.0), 0.2
"""Least and greatest height of a layer, and that of a preset which names none."""
USUAL_G_PER_CM3 = 1.2
USUAL_WEIGHT_KG = 75.0
"""Where nobody has named a body weight."""
Region: TypeAlias = Literal["heel", "arch", "forefoot"]
REGIONS: tuple[Region, ...] = get_args(Region)


@dataclass(frozen=True)
class PrintPreset:
    """How a material is printed.

    Parameters
    ----------
    layer_mm, g_per_cm3
        Height of the layers and mass of the material, by which the density and mass of what is
        printed are told; the former is set in the slicer.
    densities
        (up to this body weight in kg, per cent) from light to heavy, by region, and as "rest" of
        what lies in no zone; the last one has no limit.
    source
        Where the figures come from.
    """

    name: str
    walls: int
    top_layers: int
    bottom_layers: int
    pattern: Pattern
    layer_mm: float
    g_per_cm3: float
    densities: Mapping[str, tuple[tuple[float, float], ...]]
    source: str = ""

    def density_percent(self, region: Region | Literal["rest"], weight_kg: float) -> float:
        """Return the density of a region for a body weight."""
        return next(percent for up_to, percent in self.densities[region] if weight_kg <= up_to)


def read_print_presets(path: Path | None = None) -> tuple[PrintPreset, ...]:
    """Read a table of presets, by default that shipped with the product.

    Raises
    ------
    InputError
        Naming the file and the key that is missing or wrong.
    """
    return _shipped() if path is None else _read(path)


@cache
def _shipped() -> tuple[PrintPreset, ...]:
    return _read(resource_path("rules/print_presets.json"))


def _read(path: Path) -> tuple[PrintPreset, ...]:
    root = JsonObject.read(path)
    root.check_format(FORMAT, VERSION)
    require_keys(root, ("format", "version", "presets"))
    presets = tuple(_preset(item) for item in root.objects("presets"))
    if not presets:
        raise root.fail("presets", "holds no preset; add one")
    if len({preset.name for preset in presets}) < len(presets):
        raise root.fail("presets", "names one preset twice; keep one of them")
    return presets


def require_keys(content: JsonObject, known: tuple[str, ...]) -> None:
    """Refuse a key that nobody reads, which is as a rule a misspelt one.

    Raises
    ------
    InputError
    """
    for key in sorted(content.values.keys() - set(known)):
        raise content.fail(key, "is no key that is known here; check its spelling or leave it out")


def _preset(item: JsonObject) -> PrintPreset:
    require_keys(
        item,
        (
            "name",
            "walls",
            "top_layers",
            "bottom_layers",
            "pattern",
            "layer_mm",
            "g_per_cm3",
            "density",
            "source",
        ),
    )
    density = item.object("density")
    names = ("rest", *REGIONS)
    require_keys(density, names)
    return PrintPreset(
        item.text("name"),
        item.integer("walls", 1, MOST_WALLS),
        item.integer("top_layers", 0, MOST_LAYERS),
        item.integer("bottom_layers", 0, MOST_LAYERS),
        item.choice("pattern", PATTERNS),
        item.number("layer_mm", *LAYERS_MM) if item.has("layer_mm") else USUAL_LAYER_MM,
        item.number("g_per_cm3", 0.1, 10) if item.has("g_per_cm3") else USUAL_G_PER_CM3,
        {name: _steps(density, name) for name in names},
        item.text("source", empty=True) if item.has("source") else "",
    )


def _steps(density: JsonObject, name: str) -> tuple[tuple[float, float], ...]:
    listed = density.objects(name)
    for step in listed:
        require_keys(step, ("up_to_kg", "percent"))
    steps = tuple(
        (
            step.number("up_to_kg", WEIGHT.least, WEIGHT.greatest)
            if step.has("up_to_kg")
            else math.inf,
            step.number("percent", LEAST_PERCENT, MOST_PERCENT),
        )
        for step in listed
    )
    weights = [up_to for up_to, _ in steps]
    if not steps or weights[-1] < math.inf or weights != sorted(set(weights)):
        raise density.fail(
            name, "must go from light to heavy, and end with a step without up_to_kg"
        )
    return steps
