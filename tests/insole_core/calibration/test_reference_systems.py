from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from insole_core.calibration.markers.reference_file import (
    check_for_bump,
    check_reference_system,
    load_reference_system,
    save_reference_system,
)
from insole_core.errors import InputError
from insole_core.geometry.transforms import rigid, rotation_about, transform
from insole_core.recording.session import Marker, ReferenceSystem
from insole_core.resources import resource_path


@pytest.fixture(scope="module")
def lego() -> ReferenceSystem:
    return load_reference_system(resource_path("reference_systems/lego-20.json"))


def test_the_bundled_system_is_fit(lego: ReferenceSystem) -> None:
    checks = check_reference_system(lego)
    assert {check.face: check.markers for check in checks} == {"sole": 12, "achilles": 8}
    assert all(check.problems == () for check in checks)


def test_round_trip(lego: ReferenceSystem, tmp_path: Path) -> None:
    save_reference_system(lego, tmp_path / "own.json")
    assert load_reference_system(tmp_path / "own.json") == lego


def grid(z: float = 0.0) -> ReferenceSystem:
    places = [(40.0 * i, 40.0 * j, z * ((i + j) % 2)) for i in range(3) for j in range(3)]
    return ReferenceSystem(
        "grid", tuple(Marker(f"M{i}", place, "sole") for i, place in enumerate(places))
    )


def test_a_regular_flat_face_is_named() -> None:
    (check,) = check_reference_system(grid())
    assert any("looks like itself" in problem for problem in check.problems)
    assert any("one plane" in problem for problem in check.problems)
    assert not any("one plane" in p for p in check_reference_system(grid(20.0))[0].problems)


def ring(count: int) -> ReferenceSystem:
    """Markers in two rings above each other, `count` in each: alike after a turn of 360 / count."""
    angles = np.radians(360 / count * np.arange(2 * count) + [0, 15] * count)
    return ReferenceSystem(
        "ring",
        tuple(
            Marker(f"M{i}", (90 * float(np.cos(a)), 90 * float(np.sin(a)), 20.0 * (i % 2)), "sole")
            for i, a in enumerate(angles)
        ),
    )


@pytest.mark.parametrize("count", [3, 5])
def test_a_face_that_is_alike_after_any_turn_is_named(count: int) -> None:
    (check,) = check_reference_system(ring(count))
    assert check.symmetry_mm < 0.01
    assert round(check.symmetry_turn_deg * count / 360, 3) in range(1, count)


def test_where_the_faces_are_seen_from(lego: ReferenceSystem) -> None:
    from_ = {check.face: np.array(check.seen_from) for check in check_reference_system(lego)}
    assert from_["sole"] @ [0, 0, -1] > 0.99
    assert from_["achilles"] @ [0, -1, 0] > 0.99


def test_markers_that_hide_each_other(lego: ReferenceSystem) -> None:
    behind = replace(lego.markers[0], id="behind", position_mm=(-80.0, -110.0, 60.0))
    system = ReferenceSystem("s", (*lego.markers, behind))
    (sole, _) = check_reference_system(system)
    assert sole.clear_to_deg < 20
    assert any("hide each other" in problem for problem in sole.problems)


def test_few_or_crowded_markers_are_named() -> None:
    few = ReferenceSystem("few", grid().markers[:3])
    assert "3 markers" in check_reference_system(few)[0].problems[0]
    moved = replace(grid().markers[0], id="extra", position_mm=(5.0, 0.0, 0.0))
    crowded = ReferenceSystem("crowded", (*grid().markers, moved))
    assert any("5 mm apart" in problem for problem in check_reference_system(crowded)[0].problems)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('{"name": "x", "markers": []}', "at least 4"),
        ('{"name": "x"}', "markers is missing"),
        (
            '{"name": "x", "markers": [{"id": "A", "face": "f", "position_mm": [1, 2]}]}',
            "2 numbers",
        ),
        ("nonsense", "not valid JSON"),
    ],
)
def test_bad_files(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "system.json"
    path.write_text(text)
    with pytest.raises(InputError, match=words):
        load_reference_system(path)
    with pytest.raises(InputError, match="cannot be read"):
        load_reference_system(tmp_path / "none.json")


def test_a_bumped_marker_is_named(lego: ReferenceSystem) -> None:
    turn = rigid(rotation_about(np.array([1.0, 2, 3]), 40), np.array([100.0, -50, 800]))
    seen = {m.id: transform(turn, np.array(m.position_mm)) for m in lego.markers}
    assert not check_for_bump(lego, seen).bumped
    seen["S5"] = seen["S5"] + [0, 4.0, 0]
    check = check_for_bump(lego, seen)
    assert list(check.moved) == ["S5"]
    assert check.moved["S5"] == pytest.approx(4, abs=0.1)
