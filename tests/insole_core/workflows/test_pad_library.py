"""The pad library is the clinic's: its own kinds, sizes left out, and what is refused."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from insole_core.errors import InputError
from insole_core.workflows.pad_library import GROUPS, LibraryPad, default_pelott, load_pads

FELT = {"kind": "felt_pad", "shape": "oval", "height_mm": 3, "place": "cuboid"}


def library(folder: Path, *pads: dict[str, Any]) -> tuple[LibraryPad, ...]:
    path = folder / "library.json"
    content = {"format": "insole-pad-library", "version": 1, "pads": pads}
    path.write_text(json.dumps(content), encoding="utf-8")
    return load_pads(path)


def test_a_kind_of_the_clinics_own_keeps_its_name(tmp_path: Path) -> None:
    (felt,) = library(tmp_path, FELT)
    assert (felt.group, felt.kind, felt.size, felt.template.kind) == (
        "",
        "felt_pad",
        "",
        "felt_pad",
    )
    assert felt.template.noun == "felt pad"


def test_what_its_shape_names_is_stored_without_a_kind(tmp_path: Path) -> None:
    egg = {"kind": "pelott", "shape": "egg", "height_mm": 5, "place": "metatarsal_line"}
    pads = library(tmp_path, FELT, egg, {**egg, "kind": "drop", "shape": "drop"})
    assert [pad.template.kind for pad in pads] == ["felt_pad", None, None]
    assert default_pelott(pads) == pads[1].template


def test_without_a_pelott_in_the_library_there_is_one_still(tmp_path: Path) -> None:
    assert default_pelott(library(tmp_path, FELT)).shape == "egg"


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"kind": "a" * 61}, "kind has 61 letters, but may have 60"),
        ({"place": "knee"}, "place.*knee"),
        ({"group": "knee"}, "group.*knee"),
        ({"height_mm": 21}, "height_mm is 21"),
        ({"width_mm": 2}, "width_mm is 2"),
        ({"shape": "star"}, "shape.*star"),
    ],
)
def test_what_cannot_be_placed_is_refused_by_name(
    tmp_path: Path, change: dict[str, Any], reason: str
) -> None:
    with pytest.raises(InputError, match=rf"library\.json: pads.*{reason}"):
        library(tmp_path, {**FELT, **change})


def test_the_library_of_the_product_has_pads_for_every_part_of_the_foot() -> None:
    assert {pad.group for pad in load_pads()} == set(GROUPS)
