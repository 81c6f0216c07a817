"""Conversion between the key ``choice`` of a scan's source and `ImportChoice`."""

from __future__ import annotations

from typing import Any

from insole_core.cases.import_choice import ImportChoice
from insole_core.foot.foot_candidate import PoseClicks
from insole_core.formats.units import MM_PER_UNIT
from insole_core.geometry.side import Side
from insole_core.imprints.form import Form
from insole_core.json_object import JsonObject
from insole_core.scans.scale import KnownDistance, KnownFootLength, KnownShoeSize, KnownSize

_MOST = 1e9  # of a coordinate, in any unit


def choice_to_json(choice: ImportChoice) -> dict[str, Any]:
    """Return what was said of a scan as plain values: a key for each that was said."""
    content: dict[str, Any] = {}
    for key, word in (("side", choice.side), ("unit", choice.unit), ("form", choice.form)):
        if word is not None:
            content[key] = str(word)
    if choice.known_size is not None:
        content["known_size"] = vars(choice.known_size).copy()
    if choice.pose is not None:
        content["clicks"] = vars(choice.pose).copy()
    if choice.force:
        content["force"] = True
    return content


def choice_from_json(choice: JsonObject) -> ImportChoice:
    """Read what was said of a scan.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    return ImportChoice(
        choice.choice("side", list(Side)) if choice.has("side") else None,
        choice.choice("unit", list(MM_PER_UNIT)) if choice.has("unit") else None,
        _known_size(choice.object("known_size")) if choice.has("known_size") else None,
        choice.choice("form", list(Form)) if choice.has("form") else None,
        _clicks(choice.object("clicks")) if choice.has("clicks") else None,
        choice.flag("force") if choice.has("force") else False,
    )


def _known_size(size: JsonObject) -> KnownSize:
    if size.has("length_mm"):
        return KnownFootLength(size.number("length_mm", 0, _MOST))
    if size.has("size_eu"):
        return KnownShoeSize(size.number("size_eu", 0, _MOST))
    first, second = size.triple("first", _MOST), size.triple("second", _MOST)
    return KnownDistance(first, second, size.number("distance_mm", 0, _MOST))


def _clicks(clicks: JsonObject) -> PoseClicks:
    return PoseClicks(*(clicks.triple(key, _MOST) for key in ("heel", "toe", "sole")))
