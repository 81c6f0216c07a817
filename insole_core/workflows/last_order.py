"""Remember the settings of the last order, without patient data."""

from __future__ import annotations

import json
from dataclasses import fields
from pathlib import Path

from insole_core.export.atomic import make_private_folder, replacing_file
from insole_core.forgiving_json import read_remembered, understood
from insole_core.solids.shop import Shop
from insole_core.workflows.make_order import OrderChoice

_FORGOTTEN = ("both", "pseudonym", "text", "block")


class LastOrder:
    """Storage of the last order beside the settings; a bad entry costs only a warning.

    Parameters
    ----------
    shop
        Its blocks are found by name.
    """

    def __init__(self, path: Path, shop: Shop) -> None:
        self._path = path
        self._blocks = {block.name: block for block in shop.blocks}

    def load(self) -> OrderChoice:
        """Return the settings of the last order, or the defaults."""
        stored = read_remembered(self._path)
        kept = {name: stored[name] for name in _kept_names() if name in stored}
        block = self._blocks.get(str(stored.get("block")))
        return OrderChoice(**understood(kept, OrderChoice, self._path), block=block)

    def save(self, choice: OrderChoice) -> None:
        """Store the settings of an order.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        make_private_folder(self._path.parent)
        values = {name: getattr(choice, name) for name in _kept_names()}
        values["block"] = None if choice.block is None else choice.block.name
        with replacing_file(self._path) as beside:
            beside.write_text(json.dumps(values, indent=1), encoding="utf-8")


def _kept_names() -> list[str]:
    return [field.name for field in fields(OrderChoice) if field.name not in _FORGOTTEN]
