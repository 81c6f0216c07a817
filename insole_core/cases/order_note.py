"""What a case knows of its order: by which number the shop has it, and on which terms."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from insole_core.export.shop_order import (
    MOST_REVISIONS,
    OrderTerms,
    Release,
    terms_from_json,
    terms_to_json,
)
from insole_core.json_object import JsonObject


@dataclass(frozen=True)
class OrderNote:
    """The order of a case that was exported last, and what the shop is to be told.

    Parameters
    ----------
    number
        Of the order that the next export revises; empty where it begins one.
    revision
        Of its papers; 0 without an order.
    terms
        As they were entered last.
    """

    number: str = ""
    revision: int = 0
    terms: OrderTerms = field(default_factory=OrderTerms)

    def revised(self, by: str = "") -> Release:
        """Return the release that the next export of the same order is."""
        return Release(self.number, self.revision + 1, by)


def note_to_json(note: OrderNote) -> dict[str, Any]:
    """Return a note as plain values for `json.dump`."""
    return {"number": note.number, "revision": note.revision, **terms_to_json(note.terms)}


def note_from_json(of: JsonObject) -> OrderNote:
    """Read a note; the inverse of `note_to_json`.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    return OrderNote(
        of.text("number", empty=True),
        of.integer("revision", 0, MOST_REVISIONS),
        terms_from_json(of),
    )
