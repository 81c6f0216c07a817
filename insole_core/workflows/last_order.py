"""Remember the settings of the last order, without patient data."""

from __future__ import annotations

import json
import logging
from dataclasses import fields
from pathlib import Path
from typing import Any, get_args, get_type_hints

from insole_core.errors import InputError
from insole_core.files.atomic import make_output_folder, replacing_file
from insole_core.forgiving_json import remembered
from insole_core.formats.file_formats import SOLID_SUFFIXES
from insole_core.insole.prescription.item_name import key_of
from insole_core.milling.machine import Machine
from insole_core.solids.print_presets import LEAST_PERCENT, MOST_PERCENT
from insole_core.solids.shop import Block, Shop
from insole_core.workflows.clinic_tables import ClinicBlocks
from insole_core.workflows.make_order import OrderChoice, Package
from insole_core.workflows.mill import MillingChoice
from insole_core.workflows.named_files import NamedFiles
from insole_core.workflows.print_order import PrintChoice

log = logging.getLogger(__name__)
_FORGOTTEN = (
    "both", "alone", "pseudonym", "text", "block", "own_materials", "terms", "printing", "milling",
    "release",
)  # fmt: skip
_OF_PRINT = ("printer", "preset", "zones", "file", "above_kpa", "pressed_percent", "graded")
"""Fields of a `PrintChoice` that are kept; the body weight is the patient's."""
_OF_MILLING = {"machine": str | None, "both_sides": bool}
_LIMITS = {
    "draft_deg": (-15.0, 30.0),
    "chamfer_mm": (0.0, 10.0),
    "most_triangles": (2_000, 2_000_000),
    "most_deviation_mm": (0.005, 2.0),
    "print_above_kpa": (1.0, 5000.0),
    "print_pressed_percent": (LEAST_PERCENT, MOST_PERCENT),
}
_LONGEST = 1000
"""Letters of the material."""


class LastOrder:
    """Storage of the last order beside the settings; a bad entry costs only a warning.

    Parameters
    ----------
    shop, own
        Its blocks, and those of the clinic, are found by name.
    machines
        Storage of the routers, found by name as well.
    """

    def __init__(
        self,
        path: Path,
        shop: Shop,
        own: ClinicBlocks | None = None,
        machines: NamedFiles[Machine] | None = None,
    ) -> None:
        self._path, self._shop, self._own = path, shop, own
        self._machines = machines

    def load(self) -> OrderChoice:
        """Return the settings of the last order, or the defaults."""
        hints = get_type_hints(OrderChoice)
        kinds = {name: hints[name] for name in _kept_names()} | {"block": str | None}
        stored = remembered(self._path, kinds | _print_kinds() | _OF_MILLING)
        blocks = {block.name: block for block in (*self._shop.blocks, *self._own_blocks())}
        block = blocks.get(str(stored.pop("block", None)))
        kept = {name: value for name, value in stored.items() if _is_possible(name, value)}
        milling = self._milling(kept.pop("machine", None), kept.pop("both_sides", False))
        printing = _printing(kept)
        return OrderChoice(**kept, block=block, printing=printing, milling=milling)

    def _milling(self, name: str | None, both_sides: bool) -> MillingChoice | None:
        if name is None or self._machines is None:
            return None
        machine = self._machines.load().items.get(key_of(name))
        return None if machine is None else MillingChoice(machine, both_sides)

    def _own_blocks(self) -> tuple[Block, ...]:
        try:
            return () if self._own is None else self._own.load()
        except InputError as error:
            log.warning("the clinic's blocks are left out: %s", error)
            return ()

    def save(self, choice: OrderChoice) -> None:
        """Store the settings of an order.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        make_output_folder(self._path.parent)
        values = {name: getattr(choice, name) for name in _kept_names()}
        values["block"] = None if choice.block is None else choice.block.name
        if choice.printing is not None:
            values |= {f"print_{name}": getattr(choice.printing, name) for name in _OF_PRINT}
        if choice.milling is not None:
            values["machine"] = choice.milling.machine.name
            values["both_sides"] = choice.milling.both_sides
        with replacing_file(self._path) as beside:
            beside.write_text(json.dumps(values, indent=1), encoding="utf-8", newline="\n")


def _print_kinds() -> dict[str, Any]:
    hints = get_type_hints(PrintChoice)
    return {f"print_{name}": hints[name] for name in _OF_PRINT}


def _printing(kept: dict[str, Any]) -> PrintChoice | None:
    """Take the entries of a print from those that are kept; None if no printer is among them."""
    values = {name: kept.pop(f"print_{name}") for name in _OF_PRINT if f"print_{name}" in kept}
    return PrintChoice(**values) if "printer" in values else None


def _is_possible(name: str, value: object) -> bool:
    """Return whether a form could have held a value."""
    if name == "suffix":
        return value in SOLID_SUFFIXES
    if name == "package":
        return value in get_args(Package)
    if isinstance(value, str):
        return len(value) <= _LONGEST
    if name in _LIMITS and isinstance(value, int | float):
        least, most = _LIMITS[name]
        return least <= value <= most
    return True


def _kept_names() -> list[str]:
    return [field.name for field in fields(OrderChoice) if field.name not in _FORGOTTEN]
