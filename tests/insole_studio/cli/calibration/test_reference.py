"""``insole-studio calibrate reference``: check a reference system, measure a built one."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from insole_core.resources import resource_path
from insole_studio.cli.main import run

PLAN = resource_path("reference_systems/lego-20.json")
LENGTH = ["--length", "S1", "S5", "208"]


def moved_plan(path: Path, by_mm: float) -> Path:
    plan = json.loads(PLAN.read_text())
    plan["markers"][2]["position_mm"][0] += by_mm
    path.write_text(json.dumps(plan))
    return path


def test_the_bundled_system_is_fit(tmp_path: Path) -> None:
    report = tmp_path / "reference.html"
    assert run(["calibrate", "reference", "--report", str(report)]) == 0
    assert "Every face is fit" in report.read_text()


def test_a_regular_system_is_refused_with_its_picture(
    tmp_path: Path, last_line: Callable[[], str]
) -> None:
    places = [[40.0 * i, 40.0 * j, 0.0] for i in range(3) for j in range(3)]
    markers = [
        {"id": f"M{i}", "position_mm": place, "face": "sole"} for i, place in enumerate(places)
    ]
    own, report = tmp_path / "own.json", tmp_path / "own.pdf"
    own.write_text(json.dumps({"name": "grid", "markers": markers}))
    assert run(["calibrate", "reference", str(own), "--report", str(report)]) == 1
    assert "it looks like itself within 0.0 mm" in last_line()
    assert report.exists()


def test_a_length_between_faces_that_nothing_links(
    small_session: Path, last_line: Callable[[], str]
) -> None:
    words = ["calibrate", "reference", "--sessions", *[str(small_session)] * 2]
    assert run([*words, "--length", "S1", "A1", "9"]) == 1
    assert "but nothing links these faces; measure between two markers of one" in last_line()


def test_a_built_system_is_measured(small_session: Path, tmp_path: Path, capsys) -> None:
    built = tmp_path / "built.json"
    words = ["calibrate", "reference", "--sessions", str(small_session), str(small_session)]
    assert run([*words, *LENGTH, "--moved", "2", "--out", str(built)]) == 0
    for before, after in zip(
        json.loads(PLAN.read_text())["markers"],
        json.loads(built.read_text())["markers"],
        strict=True,
    ):
        assert after["position_mm"] == pytest.approx(before["position_mm"], abs=1)
    assert "The face achilles was not measured and stays as planned" in capsys.readouterr().out


def test_faces_that_views_link_are_measured_together(
    small_session: Path, tmp_path: Path, capsys
) -> None:
    """Every other marker of the sole is taken for one of another face that the views show too."""
    plan = json.loads(PLAN.read_text())
    soles = [marker for marker in plan["markers"] if marker["face"] == "sole"]
    for marker in soles[::2]:
        marker["face"] = "rim"
    system, built = tmp_path / "plan.json", tmp_path / "built.json"
    system.write_text(json.dumps(plan))
    words = ["calibrate", "reference", str(system), "--sessions", *[str(small_session)] * 2]
    assert run([*words, *LENGTH, "--moved", "3", "--out", str(built)]) == 0
    measured = json.loads(built.read_text())["markers"]
    for before, after in zip(plan["markers"], measured, strict=True):
        assert after["face"] == before["face"]
        assert after["position_mm"] == pytest.approx(before["position_mm"], abs=1.5)
    said = capsys.readouterr().out
    assert "The face rim" not in said
    assert "The face achilles was not measured and stays as planned" in said


def test_a_bumped_marker_is_named(
    small_session: Path, tmp_path: Path, last_line: Callable[[], str]
) -> None:
    plan = moved_plan(tmp_path / "plan.json", 6)
    words = ["calibrate", "reference", str(plan), "--sessions", *[str(small_session)] * 2]
    assert run([*words, *LENGTH, "--moved", "2"]) == 1
    assert "The reference system was bumped: S3 moved" in last_line()


def test_more_certainty_than_the_views_can_give(
    small_session: Path, tmp_path: Path, last_line: Callable[[], str]
) -> None:
    words = ["calibrate", "reference", "--sessions", *[str(small_session)] * 2, *LENGTH]
    assert run([*words, "--moved", "0.01", "--out", str(tmp_path / "built.json")]) == 1
    assert "record the system from sides that lie 30 degrees or more apart" in last_line()
    assert list(tmp_path.iterdir()) == []


WRONG_CALLS = {
    "no length": (["--sessions", "x"], "needs both --sessions and --length"),
    "nothing measured": (["--out", "x.json"], "name them too"),
    "no number": (["--sessions", "{session}", "--length", "S1", "S5", "far"], 'ends with "far"'),
}


@pytest.mark.parametrize("name", WRONG_CALLS)
def test_wrong_calls(name: str, small_session: Path, last_line: Callable[[], str]) -> None:
    words, expected = WRONG_CALLS[name]
    filled = [word.format(session=small_session) for word in words]
    assert run(["calibrate", "reference", *filled]) == 2
    assert expected in last_line()
