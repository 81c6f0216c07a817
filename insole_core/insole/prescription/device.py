"""A device: the part of a prescription that makes a kind of insole, whoever wears it.

It holds base, finish, shell, outline and thicknesses, and no correction; the file is documented in
docs/formats/device.md. It has no side: every value in it is the same for left and right.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

from insole_core.errors import DesignError, InputError
from insole_core.geometry.side import Side
from insole_core.insole.prescription import design_json
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.item_name import checked_name, key_of
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Shell
from insole_core.json_object import JsonObject

FORMAT, VERSION = "insole-device", 1
DEVICE_KEYS = ("thickness_mm", "outline", "layers", "bottom", "base", "finish", "shell")
"""Keys of a design that belong to its device."""
_OF_ONE_FOOT = {"shoe", "source", "shoe_size_eu", "points_mm"}
_OUTLINE_KEYS = tuple(f.name for f in fields(Outline) if f.name not in _OF_ONE_FOOT)
_HEAD = {
    "format": design_json.FORMAT, "version": design_json.VERSION, "side": "left", "corrections": [],
}  # fmt: skip


@dataclass(frozen=True)
class Device:
    """A named set of design values.

    Parameters
    ----------
    name
        For display; English for those of the product.
    values
        A design without corrections; of its keys only those in `DEVICE_KEYS` are meant.
    keywords
        Further words by which it is found in a list.
    source
        Where its values come from.
    """

    name: str
    values: InsoleDesign
    keywords: tuple[str, ...] = ()
    source: str = ""

    @property
    def key(self) -> str:
        """The name as one word in small letters, for the command line and for file names."""
        return key_of(self.name)


def apply_device(device: Device, design: InsoleDesign) -> InsoleDesign:
    """Make a design one of a device.

    Base, finish, shell, layers, thickness, bottom, and extent and allowances of the outline become
    those of the device. Kept are all corrections, what is of this foot alone (a drawn outline, the
    size of the shoe, the weight of the body, the points of a trim line), and grid, margin and
    greatest height.
    """
    values = device.values
    changes = {key: getattr(values, key) for key in DEVICE_KEYS}
    asked = {key: getattr(values.outline, key) for key in _OUTLINE_KEYS}
    changes["outline"] = replace(design.outline, **asked)
    changes["shell"] = _with_own_values(values.shell, design.shell)
    return replace(design, device=device.name, **changes)


def device_of(
    design: InsoleDesign, name: str, keywords: tuple[str, ...] = (), source: str = ""
) -> Device:
    """Return the device of a design under a new name, without what is of its foot alone.

    Raises
    ------
    DesignError
        If the name is empty or too long.
    """
    values = {key: getattr(design, key) for key in DEVICE_KEYS}
    values["outline"] = Outline(**{key: getattr(design.outline, key) for key in _OUTLINE_KEYS})
    if design.shell is not None:
        values["shell"] = replace(design.shell, trim_mm=None, body_weight_kg=None)
    return Device(checked_name(name), InsoleDesign(Side.LEFT, **values), keywords, source)


def device_to_json(device: Device) -> dict[str, Any]:
    """Return a device as plain values for `json.dump`."""
    design = design_json.design_to_json(device.values)
    design["outline"] = {k: v for k, v in design["outline"].items() if k in _OUTLINE_KEYS}
    return {
        "format": FORMAT,
        "version": VERSION,
        "name": device.name,
        "keywords": list(device.keywords),
        "source": device.source,
        "design": {key: design[key] for key in DEVICE_KEYS if key in design},
    }


def device_from_json(content: JsonObject) -> Device:
    """Build a device from the contents of a file.

    Raises
    ------
    InputError
        Naming the file, and the key that is missing, unknown or out of range.
    """
    content.check_format(FORMAT, VERSION)
    _check_keys(content, ("format", "version", "name", "keywords", "source", "design"))
    design = content.object("design")
    _check_keys(design, DEVICE_KEYS)
    if design.has("outline"):
        _check_keys(design.object("outline"), _OUTLINE_KEYS)
    try:
        values = design_json.design_from_json({**_HEAD, **design.values})
        own = device_of(
            values,
            content.text("name"),
            tuple(content.texts("keywords")) if content.has("keywords") else (),
            content.text("source", empty=True) if content.has("source") else "",
        )
    except DesignError as error:
        raise InputError("{file}: {reason}", file=content.file, reason=error.message) from error
    if own.values != values:
        raise design.fail(
            "shell",
            "holds the weight of a body or the points of a trim line, which belong to one foot; "
            "leave them out",
        )
    return own


def read_device(path: Path) -> Device:
    """Read a device file.

    Raises
    ------
    InputError
        Naming the file and what is wrong with it.
    """
    return device_from_json(JsonObject.read(path))


def write_device(device: Device, path: Path) -> None:
    """Write a device to a path, as a rule the temporary one of `replacing_file`."""
    text = json.dumps(device_to_json(device), indent=1, ensure_ascii=False)
    path.write_text(text + "\n", encoding="utf-8", newline="\n")


def _with_own_values(shell: Shell | None, worn: Shell | None) -> Shell | None:
    """Return the shell of a device with what the shell before has of one foot alone."""
    if shell is None or worn is None:
        return shell
    return replace(shell, body_weight_kg=worn.body_weight_kg, trim_mm=worn.trim_mm)


def _check_keys(content: JsonObject, known: tuple[str, ...]) -> None:
    unknown = sorted(content.values.keys() - set(known))
    if "side" in unknown:
        raise content.fail("side", "does not belong here: a device fits both feet; leave it out")
    if unknown:
        raise content.fail(
            unknown[0],
            "is no key of a device; check its spelling or leave it out ({known} are known)",
            known=", ".join(known),
        )
