"""Materials of insoles: least thickness, and the usual one by body weight.

The table is resources/rules/materials.json, which a clinic can change.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise
from pathlib import Path

from insole_core.errors import DesignError, InputError
from insole_core.insole.fields import ranges_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.shell import Shell
from insole_core.json_object import JsonObject
from insole_core.messages import joined
from insole_core.resources import resource_path

FORMAT, VERSION = "insole-materials", 1
THICKNESS, WEIGHT = ranges_of(InsoleDesign)["thickness_mm"], ranges_of(Shell)["body_weight_kg"]
SHORE_A, MODULUS_MPA = (1.0, 90.0), (0.05, 250_000.0)
"""Limits of what a table holds."""


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
    shore_a
        Hardness of a foam; None if unknown.
    modulus_mpa
        Young's modulus of a stiff material; None if unknown.
    """

    name: str
    least_mm: float
    least_edge_mm: float
    steps: tuple[ThicknessStep, ...] = ()
    source: str = ""
    shore_a: float | None = None
    modulus_mpa: float | None = None

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
    def materials(self) -> tuple[Material, ...]:
        """The materials, in the order of the table."""
        return tuple(self._by_name.values())

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


def write_materials(materials: Sequence[Material], path: Path) -> None:
    """Write a table in the format of `read_materials`, as a rule to `replacing_file`'s path."""
    listed = [_to_json(material) for material in materials]
    content = {"format": FORMAT, "version": VERSION, "materials": listed}
    path.write_text(
        json.dumps(content, indent=1, ensure_ascii=False) + "\n", encoding="utf-8", newline="\n"
    )


def check_materials(materials: Sequence[Material]) -> None:
    """Check the rows of a table that somebody edits.

    Raises
    ------
    InputError
        Naming the first material without a name, with the name of another one, or whose body
        weights do not increase.
    """
    taken: set[str] = set()
    if not materials:
        raise InputError("The table needs at least one material; add one.")
    for material in materials:
        if not material.name.strip():
            raise InputError("A material needs a name; type one.")
        if material.name.strip().casefold() in taken:
            raise InputError(
                "There is a material {name} already; give this one another name.",
                name=material.name,
            )
        taken.add(material.name.strip().casefold())
        if any(light.up_to_kg >= heavy.up_to_kg for light, heavy in pairwise(material.steps)):
            raise InputError(
                "The body weights of {name} must go from light to heavy; change them.",
                name=material.name,
            )


def material_of(shell: Shell) -> Material:
    """Return the material of a shell, with the least thicknesses that its design states."""
    material = read_materials().material(shell.material)
    if shell.least_mm is not None:
        material = replace(material, least_mm=shell.least_mm)
    if shell.least_edge_mm is not None:
        material = replace(material, least_edge_mm=shell.least_edge_mm)
    return material


def with_least_thickness(design: InsoleDesign, table: MaterialTable) -> InsoleDesign:
    """Return a design whose shell is as thick at least as a table asks for its material.

    A design without a shell, or of a material that the table does not hold, stays as it is.
    """
    shell = design.shell
    asked = None if shell is None else table.known(shell.material)
    if shell is None or asked is None:
        return design
    usual = read_materials().material(shell.material)
    changed = replace(
        shell,
        least_mm=None if asked.least_mm == usual.least_mm else asked.least_mm,
        least_edge_mm=None if asked.least_edge_mm == usual.least_edge_mm else asked.least_edge_mm,
    )
    return design if changed == shell else replace(design, shell=changed)


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
    if weight_kg not in WEIGHT:
        raise DesignError(
            "A body weight of {weight_kg:g} kg cannot be right: it must be {range}; put in the "
            "patient's weight.",
            weight_kg=weight_kg,
            range=str(WEIGHT),
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
    _check_keys(root, ("format", "version", "materials"))
    items = root.objects("materials")
    table = MaterialTable(_material(item) for item in items)
    if not items:
        raise root.fail("materials", "holds no material; add one")
    if len(table.names) < len(items):
        raise root.fail("materials", "names one material twice; keep one of them")
    return table


def _check_keys(content: JsonObject, known: tuple[str, ...]) -> None:
    for key in sorted(content.values.keys() - set(known)):
        raise content.fail(
            key, "is no key of a table of materials; check its spelling or leave it out"
        )


def _to_json(material: Material) -> dict[str, object]:
    known = {
        "shore_a": material.shore_a,
        "modulus_mpa": material.modulus_mpa,
        "source": material.source or None,
    }
    return {
        "name": material.name,
        "least_mm": material.least_mm,
        "least_edge_mm": material.least_edge_mm,
        "thickness": [
            ({} if math.isinf(step.up_to_kg) else {"up_to_kg": step.up_to_kg})
            | {"mm": step.thickness_mm}
            for step in material.steps
        ],
        **{key: value for key, value in known.items() if value is not None},
    }


_KEYS = (
    "name", "least_mm", "least_edge_mm", "thickness", "source", "shore_a", "modulus_mpa",
)  # fmt: skip


def _material(item: JsonObject) -> Material:
    _check_keys(item, _KEYS)
    least, most = THICKNESS.least, THICKNESS.greatest
    listed = item.objects("thickness")
    for step in listed:
        _check_keys(step, ("up_to_kg", "mm"))
    steps = tuple(
        ThicknessStep(
            step.number("up_to_kg", WEIGHT.least, WEIGHT.greatest)
            if step.has("up_to_kg")
            else math.inf,
            step.number("mm", least, most),
        )
        for step in listed
    )
    weights = [step.up_to_kg for step in steps]
    if not steps or weights[-1] < math.inf or weights != sorted(set(weights)):
        raise item.fail(
            "thickness", "must go from light to heavy, and end with a step without up_to_kg"
        )
    name = item.text("name").strip()
    if not name:
        raise item.fail("name", "must be a text that is not empty")
    return Material(
        name,
        item.number("least_mm", least, most),
        item.number("least_edge_mm", least, most),
        steps,
        item.text("source", empty=True) if item.has("source") else "",
        item.number("shore_a", *SHORE_A) if item.has("shore_a") else None,
        item.number("modulus_mpa", *MODULUS_MPA) if item.has("modulus_mpa") else None,
    )
