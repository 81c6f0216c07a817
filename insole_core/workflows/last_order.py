"""Remember the settings of the last order, without patient data."""

from __future__ import annotations

import json
import logging
from dataclasses import fields
from pathlib import Path

from insole_core.errors import InputError
from insole_core.export.atomic import replacing_file
from insole_core.forgiving_json import read_remembered, understood
from insole_core.solids.shop import Block, Shop
from insole_core.workflows.clinic_blocks import ClinicBlocks
from insole_core.workflows.make_order import OrderChoice

log = logging.getLogger(__name__)
_FORGOTTEN = ("both", "pseudonym", "text", "block")


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
        stored = read_remembered(self._path)
        kept = {name: stored[name] for name in _kept_names() if name in stored}
        blocks = {block.name: block for block in (*self._shop.blocks, *self._own_blocks())}
        block = blocks.get(str(stored.get("block")))
        return OrderChoice(**understood(kept, OrderChoice, self._path), block=block)

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
        self._path.parent.mkdir(parents=True, exist_ok=True)
        values = {name: getattr(choice, name) for name in _kept_names()}
        values["block"] = None if choice.block is None else choice.block.name
        with replacing_file(self._path) as beside:
            beside.write_text(json.dumps(values, indent=1), encoding="utf-8")


def _kept_names() -> list[str]:
    return [field.name for field in fields(OrderChoice) if field.name not in _FORGOTTEN]
