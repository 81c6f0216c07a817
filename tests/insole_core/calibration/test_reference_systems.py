from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from simulated_board import COLOR_CAMERA

from insole_core.calibration.marker_survey import KnownLength, MarkerView, survey_markers
from insole_core.calibration.reference_file import (
    check_for_bump,
    check_reference_system,
    load_reference_system,
    positions,
    save_reference_system,
)
from insole_core.errors import CalibrationError, InputError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.horn import absolute_orientation
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


def views(true: dict[str, FloatArray], count: int, noise_px: float) -> list[MarkerView]:
    """Pictures from below and behind, on a cap of directions."""
    generator = np.random.default_rng(5)
    center = np.mean(list(true.values()), axis=0)
    pictures = []
    for i in range(count):
        tilt = generator.uniform(-40, 40, 2)
        rotation = rotation_about(np.array([1.0, 0, 0]), tilt[0]) @ rotation_about(
            np.array([0, 1.0, 0]), tilt[1]
        )
        place = np.array([*generator.uniform(-60, 60, 2), generator.uniform(600, 900)])
        reference2camera = rigid(rotation, place - rotation @ center)
        pixels = {
            name: COLOR_CAMERA.project(transform(reference2camera, point))
            + generator.normal(0, noise_px, 2)
            for name, point in true.items()
        }
        pictures.append(MarkerView(f"picture {i}", pixels, COLOR_CAMERA))
    return pictures


def built(plan: ReferenceSystem) -> dict[str, FloatArray]:
    generator = np.random.default_rng(2)
    return {m.id: np.array(m.position_mm) + generator.normal(0, 0.5, 3) for m in plan.markers}


def test_the_survey_finds_the_built_positions(lego: ReferenceSystem) -> None:
    true = built(lego)
    known = KnownLength("S1", "S12", float(np.linalg.norm(true["S1"] - true["S12"])))
    survey = survey_markers(lego, views(true, 12, 0.1), known)
    truth = np.array([true[m.id] for m in lego.markers])
    found = positions(survey.system.markers)
    error = transform(absolute_orientation(found, truth).a2b, found) - truth
    assert np.abs(error).max() < 0.25
    deviation = np.array([survey.deviation_mm[m.id] for m in lego.markers])
    assert np.sqrt((error**2).mean()) < 3 * np.sqrt((deviation**2).mean())
    # 480 image coordinates determine 132 unknowns.
    assert survey.rms_px == pytest.approx(0.1 * np.sqrt(2 * (1 - 132 / 480)), rel=0.15)
    assert survey.largest_change_mm < 2.5
    assert survey.unseen == ()


def test_markers_that_are_not_seen_keep_their_place(lego: ReferenceSystem) -> None:
    true = built(lego)
    hidden = [
        MarkerView(v.name, {k: p for k, p in v.pixels.items() if k != "A8"}, v.camera)
        for v in views(true, 6, 0.1)
    ]
    survey = survey_markers(lego, hidden, KnownLength("S1", "S12", 312.0))
    assert survey.unseen == ("A8",)
    assert survey.system.markers[-1] == lego.markers[-1]


def test_surveys_that_cannot_be_made(lego: ReferenceSystem) -> None:
    pictures = views(built(lego), 4, 0.1)
    with pytest.raises(CalibrationError, match="2 pictures"):
        survey_markers(lego, pictures[:2], KnownLength("S1", "S2", 40))
    with pytest.raises(CalibrationError, match="ends at X9"):
        survey_markers(lego, pictures, KnownLength("S1", "X9", 40))
    with pytest.raises(CalibrationError, match="two different markers"):
        survey_markers(lego, pictures, KnownLength("S1", "S1", 40))


def test_a_bumped_marker_is_named(lego: ReferenceSystem) -> None:
    turn = rigid(rotation_about(np.array([1.0, 2, 3]), 40), np.array([100.0, -50, 800]))
    seen = {m.id: transform(turn, np.array(m.position_mm)) for m in lego.markers}
    assert not check_for_bump(lego, seen).bumped
    seen["S5"] = seen["S5"] + [0, 4.0, 0]
    check = check_for_bump(lego, seen)
    assert list(check.moved) == ["S5"]
    assert check.moved["S5"] == pytest.approx(4, abs=0.1)
