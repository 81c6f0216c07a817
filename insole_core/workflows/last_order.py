"""Remember the settings of the last order, without patient data."""

from __future__ import annotations

import json
import logging
from dataclasses import fields
from pathlib import Path
from typing import get_args, get_type_hints

from insole_core.errors import InputError
from insole_core.export.atomic import make_output_folder, replacing_file
from insole_core.export.solid_file import SUFFIXES
from insole_core.forgiving_json import remembered
from insole_core.solids.shop import Block, Shop
from insole_core.workflows.clinic_blocks import ClinicBlocks
from insole_core.workflows.make_order import OrderChoice, Package

log = logging.getLogger(__name__)
_FORGOTTEN = ("both", "pseudonym", "text", "block", "own_materials", "terms")
_LIMITS = {
    "draft_deg": (-15.0, 30.0),
    "chamfer_mm": (0.0, 10.0),
    "most_triangles": (2_000, 2_000_000),
    "most_deviation_mm": (0.005, 2.0),
}
_LONGEST = 1000
"""Letters of the material."""


class LastOrder:
    """Storage of the last order beside the settings; a bad entry costs only a warning.

    Parameters
    ----------
    shop, own
        Its blocks, and those of the clinic, are found by name.
    """

    def __init__(self, path: Path, shop: Shop, own: ClinicBlocks | None = None) -> None:
        self._path, self._shop, self._own = path, shop, own

    def load(self) -> OrderChoice:
        """Return the settings of the last order, or the defaults."""
        hints = get_type_hints(OrderChoice)
        kinds = {name: hints[name] for name in _kept_names()} | {"block": str | None}
        stored = remembered(self._path, kinds)
        blocks = {block.name: block for block in (*self._shop.blocks, *self._own_blocks())}
        block = blocks.get(str(stored.pop("block", None)))
        kept = {name: value for name, value in stored.items() if _is_possible(name, value)}
        return OrderChoice(**kept, block=block)

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
        with replacing_file(self._path) as beside:
            beside.write_text(json.dumps(values, indent=1), encoding="utf-8")


def _is_possible(name: str, value: object) -> bool:
    """Return whether a form could have held a value."""
    if name == "suffix":
        return value in SUFFIXES
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
