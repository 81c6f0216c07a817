"""What a job sheet says of its order, kept in the PDF to be compared with `order.json`."""

from __future__ import annotations

import base64
import binascii
import json
import re
from collections.abc import Mapping
from typing import Final, TypeAlias

from insole_core.export.shop_order import OrderTerms, Release
from insole_core.geometry.side import Side

SheetTerms: TypeAlias = Mapping[str, str]
"""Terms by name, in no language; empty ones too."""

_FACTS: Final = (
    "quantity", "colour", "cover", "lot of the material", "remarks", "delivery date",
)  # fmt: skip
_MARK: Final = "insole-order:"
_KEYWORD: Final = re.compile(rf"{_MARK}([A-Za-z0-9+/=]+)".encode("ascii"))


def sheet_terms(
    release: Release, pseudonym: str, materials: Mapping[Side, str], terms: OrderTerms
) -> SheetTerms:
    """Return what a job sheet says of its order.

    Parameters
    ----------
    materials
        Of each side that the sheet is for.
    """
    return {
        "number": release.number,
        "revision": str(release.revision),
        "released by": release.by,
        "pseudonym": pseudonym,
        **{f"material, {side}": materials[side] for side in Side if side in materials},
        **{name: terms.facts.get(name, "") for name in _FACTS},
    }


def as_keyword(terms: SheetTerms) -> str:
    """Return terms as a keyword of a PDF: letters that stand in it as they are."""
    written = json.dumps(terms, separators=(",", ":")).encode("ascii")
    return _MARK + base64.b64encode(written).decode("ascii")


def terms_in(pdf: bytes) -> SheetTerms | None:
    """Return the terms in a job sheet; None where it holds none, as of earlier versions."""
    found = _KEYWORD.search(pdf)
    if found is None:
        return None
    try:
        terms = json.loads(base64.b64decode(found[1], validate=True))
    except (binascii.Error, ValueError):
        return {}
    return terms if isinstance(terms, dict) else {}
