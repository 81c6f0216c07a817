"""A foot that is captured again and again tells the ± of the place's measures."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from insole_core.errors import InputError
from insole_core.evaluation.repeat import Repeated
from insole_core.evaluation.repeat_section import number_keys, repeat_section
from insole_core.evaluation.report import Report
from insole_core.evaluation.report_files import write_pdf
from insole_core.geometry.arrays import RawArray
from insole_core.geometry.side import Side
from insole_core.recording.capture_place import CapturePlace
from insole_core.recording.reader import read_session
from insole_core.recording.session import Session, View
from insole_core.recording.writer import write_session
from insole_core.sensing.sensor import CalibrationRecord
from insole_core.workflows.calibration import repeated_captures
from insole_core.workflows.calibration.repeat_tests import (
    REPEAT_TESTS_FILE,
    RepeatTest,
    RepeatTests,
    repeated_limits,
)
from insole_core.workflows.calibration.repeated_captures import RepeatedCaptures, repeat_captures
from insole_core.workflows.scanned_feet import session_source
from insole_studio.cli.main import run

SMALL_SESSION = Path(__file__).parents[3] / "data" / "sessions" / "left_small.zip"


def with_noise(view: View, seed: int) -> View:
    """Return the same view with frames of its own: single readings that jump by one unit."""

    def read(number: int) -> RawArray:
        raw = view.read_depth(number).copy()
        jumps = np.random.default_rng([seed, number]).random(raw.shape) < 0.2
        raw[jumps & (raw < 2047)] += 1
        return raw

    return replace(view, read_depth=read)


@pytest.fixture(scope="module")
def captures(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Three captures of one foot with the same sensors."""
    folder, session = tmp_path_factory.mktemp("repeat"), read_session(SMALL_SESSION)
    paths = [folder / f"capture{number}" for number in range(3)]
    for seed, path in enumerate(paths):
        views = tuple(with_noise(view, seed) for view in session.views)
        write_session(replace(session, views=views), path)
    return paths


@pytest.fixture(scope="module")
def repeated(captures: list[Path]) -> RepeatedCaptures:
    return repeat_captures(captures)


@pytest.fixture
def evaluated(
    captures: list[Path],
    repeated: RepeatedCaptures,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> Callable[..., int]:
    """Run the command on the captures, which are reconstructed once for all tests."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setattr(repeated_captures, "repeat_captures", lambda *_: repeated)
    return lambda *words: run(["evaluate", "repeat", *map(str, captures), *words])


@pytest.mark.slow
def test_a_repeat_test_is_where_the_limits_of_measures_come_from(
    evaluated: Callable[..., int],
    captures: list[Path],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    report, measures = tmp_path / "repeat.json", tmp_path / "measures.json"
    assert evaluated("--report", str(report), "--limit", "sd_foot_length=2") == 0
    numbers = json.loads(report.read_text())["sections"]["repeat"]["numbers"]
    (kept,) = tmp_path.rglob(REPEAT_TESTS_FILE)
    assert str(kept) in capsys.readouterr().out
    assert run(["measure", str(captures[0]), "--report", str(measures)]) == 0
    told = json.loads(measures.read_text())
    assert told["limits_by"]["foot_length"] == "repeat test"
    limit = told["limits_95"]["foot_length"]
    assert limit == pytest.approx(numbers["limits_95_foot_length"]["value"], abs=1e-3)
    assert limit == pytest.approx(4.303 * numbers["sd_foot_length"]["value"], abs=2e-3)
    assert numbers["sole_median_mm"]["value"] < 0.5


@pytest.mark.slow
def test_a_place_that_scatters_too_much_keeps_nothing(
    evaluated: Callable[..., int], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert evaluated("--limit", "sd_foot_length=0.0001") == 1
    *_, not_kept, failed = capsys.readouterr().err.splitlines()
    assert "foot length, SD" in failed
    assert "The test is not kept" in not_kept
    assert not list(tmp_path.rglob(REPEAT_TESTS_FILE))


@pytest.mark.parametrize(
    ("words", "status", "told"),
    [
        (["--limit", "foot_length=2"], 2, '--limit is of "foot_length", and the report has no'),
        (["--limit", "sd_foot_length"], 2, '--limit is "sd_foot_length"; give the key'),
        (["--limits", "nothing.json"], 1, "nothing.json"),
    ],
)
def test_limits_that_say_nothing_are_told_before_anything_is_read(
    words: list[str], status: int, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["evaluate", "repeat", "a", "b", "c", *words]) == status
    (line,) = capsys.readouterr().err.splitlines()
    assert told in line


@pytest.mark.parametrize("step", ["chain", "wall", "noise"])
def test_so_they_are_by_the_other_evaluations(
    step: str, capsys: pytest.CaptureFixture[str]
) -> None:
    sphere = ["--ball", "--diameter", "60"] if step == "chain" else []
    assert run(["evaluate", step, "nothing", *sphere, "--limit", "x=-1"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert '--limit is "x=-1"' in line


def test_the_keys_that_limits_may_have_are_those_of_the_report(
    repeated: RepeatedCaptures,
) -> None:
    section = repeat_section(repeated.evaluation)
    assert {number.key for number in section.numbers} <= set(number_keys())


@pytest.mark.slow
def test_the_pictures_of_a_repeat_test_can_be_printed(
    repeated: RepeatedCaptures, tmp_path: Path
) -> None:
    section = repeat_section(repeated.evaluation)
    write_pdf(Report(section.title, "", "2026-11-27T08:00:00Z", (section,)), tmp_path / "r.pdf")
    assert (tmp_path / "r.pdf").read_bytes().count(b"/Subtype /Image") == 2


def test_a_test_holds_for_its_very_sensors_and_takes_the_place_of_the_one_before(
    tmp_path: Path,
) -> None:
    tests, earlier, later = RepeatTests(tmp_path), Repeated(0.3, 1.3, 3), Repeated(0.2, 0.5, 5)
    two, three = (CapturePlace(tuple(serials), "frame", "2026-11-01") for serials in ("AB", "ABC"))
    for place, one in ((two, earlier), (three, earlier), (two, later)):
        tests.keep(RepeatTest(place, "2026-11-27", 3, {"foot_length": one}))
    assert len(json.loads(tests.path.read_text())["tests"]) == 2
    assert repeated_limits(two, tmp_path) == {"foot_length": 0.5}
    assert repeated_limits(three, tmp_path) == {"foot_length": 1.3}
    for other in (
        replace(two, sensors=("A",)),
        replace(two, frame="another"),
        replace(two, calibrated_at="2026-11-28"),
        None,
    ):
        assert repeated_limits(other, tmp_path) == {}
    tests.path.write_text("{")
    assert repeated_limits(two, tmp_path) == {}  # the ± by simulation counts then, and says so
    with pytest.raises(InputError, match=REPEAT_TESTS_FILE):
        tests.keep(RepeatTest(two, "2026-11-27", 3, {}))
    assert tests.path.read_text() == "{"


def test_a_place_changes_with_its_sensors_their_calibration_and_its_frame() -> None:
    session = read_session(SMALL_SESSION)
    place = session.place
    assert place == session_source(SMALL_SESSION, session).place == calibrated(session, "").place
    assert place is not None
    assert in_other_frame(session).place.frame != place.frame
    assert calibrated(session, "2027-01-01T08:00:00+00:00").place.calibrated_at[:4] == "2027"
    assert with_serial(session, "").place is None  # those of the others are no whole place


def changed(session: Session, **manifest: object) -> Session:
    return replace(session, manifest=replace(session.manifest, **manifest))  # type: ignore[arg-type]


def with_serial(session: Session, serial: str) -> Session:
    view, *others = session.views
    return replace(
        session, views=(replace(view, sensor=replace(view.sensor, serial=serial)), *others)
    )


def calibrated(session: Session, made_at: str) -> Session:
    """Return a session as after a calibration; as it was where that was on no day."""
    view, *others = session.views
    sensor = view.sensor.calibrated(CalibrationRecord("camera", made_at, 0.1, "px"))
    views = (replace(view, sensor=sensor if made_at else view.sensor), *others)
    return replace(session, views=views)


def in_other_frame(session: Session) -> Session:
    system = session.manifest.reference_system
    first, *others = system.markers
    moved = replace(first, position_mm=(first.position_mm[0] + 2, *first.position_mm[1:]))
    return changed(session, reference_system=replace(system, markers=(moved, *others)))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda session: changed(session, side=Side.RIGHT), "is of a left foot, but"),
        (lambda session: with_serial(session, "Z9"), "test each place on its own"),
        (in_other_frame, "two different frames of markers"),
        (lambda session: calibrated(session, "2027-01-01T08:00:00+00:00"), "calibrated between"),
        (None, "is a copy of"),
    ],
)
def test_captures_that_are_no_repetition_are_refused(
    captures: list[Path],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    change: Callable[[Session], Session] | None,
    said: str,
) -> None:
    other = tmp_path / "other"
    if change is None:
        shutil.copytree(captures[0], other)
    else:
        write_session(change(read_session(captures[2])), other)
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    paths = map(str, (*captures[:2], other))
    assert run(["evaluate", "repeat", *paths]) == 2
    sentence = capsys.readouterr().err.splitlines()[-1]
    assert said in sentence
    assert str(other) in sentence
    assert not list(tmp_path.rglob(REPEAT_TESTS_FILE))


def test_two_captures_are_no_test(captures: list[Path], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["evaluate", "repeat", *map(str, captures[:2])]) == 2
    assert "3 to 10" in capsys.readouterr().err.splitlines()[-1]
