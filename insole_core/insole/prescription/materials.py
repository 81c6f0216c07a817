"""Materials of insoles: least thickness, and the usual one by body weight.

The table is resources/rules/materials.json, which a clinic can change.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from insole_core.errors import DesignError
from insole_core.insole.prescription.design_limits import DESIGN_RANGES, SHELL_RANGES
from insole_core.json_object import JsonObject
from insole_core.messages import joined
from insole_core.resources import resource_path

FORMAT, VERSION = "insole-materials", 1
_THICKNESS, _WEIGHT = DESIGN_RANGES["thickness_mm"], SHELL_RANGES["body_weight_kg"]


@dataclass(frozen=True)
class ThicknessStep:
    """The usual thickness up to a body weight, which is infinite for the last step."""

    up_to_kg: float
    thickness_mm: float


@dataclass(frozen=True)
class Material:
    """A material that insoles are made of.

    Parameters
    ----------
    least_mm
        Thickness below which it breaks or wears through.
    least_edge_mm
        The same at the front edge of the insole.
    steps
        In the order of their weights.
    source
        Where the thicknesses come from.
    """

    name: str
    least_mm: float
    least_edge_mm: float
    steps: tuple[ThicknessStep, ...] = ()
    source: str = ""

    def usual_mm(self, weight_kg: float) -> float | None:
        """Return the usual thickness for a body weight; None if the table has none."""
        return next((s.thickness_mm for s in self.steps if weight_kg <= s.up_to_kg), None)


ANY_MATERIAL = Material("", least_mm=2.0, least_edge_mm=1.0)
"""What holds for a material that the table does not know."""


class MaterialTable:
    """Materials by their names, in whatever letters these are written."""

    def __init__(self, materials: Iterable[Material]) -> None:
        self._by_name = {material.name.casefold(): material for material in materials}

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the materials, in the order of the table."""
        return tuple(material.name for material in self._by_name.values())

    def known(self, name: str) -> Material | None:
        """Return the material of a name; None if the table does not hold it."""
        return self._by_name.get(name.strip().casefold())

    def material(self, name: str) -> Material:
        """Return the material of a name, or `ANY_MATERIAL`."""
        return self.known(name) or ANY_MATERIAL


def read_materials(path: Path | None = None) -> MaterialTable:
    """Read a table of materials, by default that shipped with the product.

    Raises
    ------
    InputError
        Naming the file and the key that is missing or wrong.
    """
    return _shipped() if path is None else _read(path)


def proposed_thickness(
    material: str, weight_kg: float | None, table: MaterialTable | None = None
) -> float:
    """Return the usual thickness of a shell, in mm, for a body weight.

    Parameters
    ----------
    weight_kg
        None if unknown.
    table
        By default that of the product.

    Raises
    ------
    DesignError
        If material or weight is missing, the material is not in the table, or nobody has that
        weight.
    """
    table = table or read_materials()
    names = joined(table.names)
    if not material.strip():
        raise DesignError(
            "No thickness can be proposed without a material; choose one of {names}.", names=names
        )
    if weight_kg is None:
        raise DesignError(
            "No thickness can be proposed without the body weight; put in the weight, or the "
            "thickness itself."
        )
    if weight_kg not in _WEIGHT:
        raise DesignError(
            "A body weight of {weight_kg:g} kg cannot be right: it must be {range}; put in the "
            "patient's weight.",
            weight_kg=weight_kg,
            range=str(_WEIGHT),
        )
    usual_mm = table.material(material).usual_mm(weight_kg)
    if usual_mm is None:
        raise DesignError(
            "No thickness is known for the material {material}; choose one of {names}, or put in "
            "the thickness yourself.",
            material=material,
            names=names,
        )
    return usual_mm


@cache
def _shipped() -> MaterialTable:
    return _read(resource_path("rules/materials.json"))


def _read(path: Path) -> MaterialTable:
    root = JsonObject.read(path)
    root.check_format(FORMAT, VERSION)
    items = root.objects("materials")
    table = MaterialTable(_material(item) for item in items)
    if len(table.names) < len(items):
        raise root.fail("materials", "names one material twice; keep one of them")
    return table


def _material(item: JsonObject) -> Material:
    least, most = _THICKNESS.least, _THICKNESS.greatest
    steps = tuple(
        ThicknessStep(
            step.number("up_to_kg", 0, 1000) if step.has("up_to_kg") else math.inf,
            step.number("mm", least, most),
        )
        for step in item.objects("thickness")
    )
    weights = [step.up_to_kg for step in steps]
    if not steps or weights[-1] < math.inf or weights != sorted(set(weights)):
        raise item.fail(
            "thickness", "must go from light to heavy, and end with a step without up_to_kg"
        )
    return Material(
        item.text("name"),
        item.number("least_mm", least, most),
        item.number("least_edge_mm", least, most),
        steps,
        item.text("source") if item.has("source") else "",
    )
