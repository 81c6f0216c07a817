"""A stored prescription without anything that somebody has typed about the patient."""

from __future__ import annotations

import json
from collections.abc import Set
from typing import Any

from insole_core.cases.name_words import holds_any

_NOTHING = "–"
"""In place of a text that may not be empty."""


def nameless_document(document: str, words: Set[str]) -> str:
    """Return what a version of a prescription states, without names, notes and places of files.

    Variants and key points get new names, in their order. A text of the design, such as a
    material, stays, unless it holds one of the words: it says what the device is made of.

    Parameters
    ----------
    document
        As `prescription_versions` holds it; of any version, also a damaged one.
    words
        Of the patient's name, folded.
    """
    try:
        content = json.loads(document)
    except ValueError:
        content = {}
    foot = content if isinstance(content, dict) else {}
    if "notes" in foot:
        foot["notes"] = []
    foot.pop("picture", None)  # of a footprint on paper, where a name may be written
    _rename_source(_within(foot, "source"))
    for number, point in enumerate(_each(_within(foot, "annotations").get("key_points")), 1):
        point["name"] = str(number)
    _rename_variants(foot)
    for part, key in (("earlier", "name"), ("pressure", "device"), ("pressure", "shown")):
        if key in _within(foot, part):
            foot[part][key] = _NOTHING
    return json.dumps(_without(foot, words), ensure_ascii=False)


def _rename_source(source: dict[str, Any]) -> None:
    if "path" in source:
        source["path"] = str(source.get("kind", _NOTHING))


def _rename_variants(foot: dict[str, Any]) -> None:
    names = {}
    for number, variant in enumerate(_each(foot.get("variants")), 1):
        names[variant.get("name")] = variant["name"] = str(number)
    if "chosen" in foot:
        foot["chosen"] = names.get(foot["chosen"], _NOTHING)


def _without(value: Any, words: Set[str]) -> Any:
    """Return a value without texts and keys that hold one of some words."""
    if isinstance(value, dict):
        kept = {k: v for k, v in value.items() if not holds_any(k, words)}
        return {key: _without(inner, words) for key, inner in kept.items()}
    if isinstance(value, list):
        return [_without(inner, words) for inner in value]
    return _NOTHING if isinstance(value, str) and holds_any(value, words) else value


def _within(values: dict[str, Any], key: str) -> dict[str, Any]:
    inner = values.get(key)
    return inner if isinstance(inner, dict) else {}


def _each(values: Any) -> list[dict[str, Any]]:
    return [v for v in values if isinstance(v, dict)] if isinstance(values, list) else []
