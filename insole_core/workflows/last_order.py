"""Remembers how this workplace orders; whose piece it was and what stood on it is forgotten."""

from __future__ import annotations

import json
import logging
from dataclasses import fields
from pathlib import Path
from typing import Any

from insole_core.export.atomic import replacing_file
from insole_core.solids.shop import Shop
from insole_core.workflows.make_order import OrderChoice

log = logging.getLogger(__name__)
_FORGOTTEN = ("both", "pseudonym", "text", "block")


class LastOrder:
    """Keeps the last order beside the settings; a bad entry costs a warning, never the start.

    Parameters
    ----------
    path
    shop
        Knows the blocks by their names.
    """

    def __init__(self, path: Path, shop: Shop) -> None:
        self._path = path
        self._blocks = {block.name: block for block in shop.blocks}

    def load(self) -> OrderChoice:
        """Give the order to begin with."""
        stored = self._read()
        default = OrderChoice()
        kept: dict[str, Any] = {
            name: stored[name]
            for name in _kept_names()
            if name in stored and _fits(stored[name], getattr(default, name))
        }
        try:
            return OrderChoice(**kept, block=self._blocks.get(str(stored.get("block"))))
        except (TypeError, ValueError) as error:
            log.warning("%s: the last order is forgotten: %s", self._path, error)
            return default

    def save(self, choice: OrderChoice) -> None:
        """Remember an order.

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

    def _read(self) -> dict[str, Any]:
        try:
            stored = json.loads(self._path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {}
        except (OSError, ValueError) as error:
            log.warning("%s: the last order cannot be read: %s", self._path, error)
            return {}
        return stored if isinstance(stored, dict) else {}


def _kept_names() -> list[str]:
    return [field.name for field in fields(OrderChoice) if field.name not in _FORGOTTEN]


def _fits(value: object, default: object) -> bool:
    """Whether a value has the type of the default; None stands for "none" where that is allowed."""
    if default is None or (isinstance(default, int) and not isinstance(default, bool)):
        return value is None or isinstance(value, str | int)
    return isinstance(value, type(default))
