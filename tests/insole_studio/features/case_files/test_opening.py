"""What opening a case costs the window: the search for the landmarks is none of its work."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot import landmarks
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import Landmark
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.workflows.scanned_feet import ScannedFoot
from insole_studio.app.bootstrap import Application


@pytest.fixture
def threads_of_search(monkeypatch: pytest.MonkeyPatch) -> list[threading.Thread]:
    """Return the threads that have searched for landmarks."""
    threads: list[threading.Thread] = []
    search = landmarks._search  # what is cached with the foot is not searched for again

    def noted(foot: Foot) -> Iterator[tuple[str, Landmark]]:
        threads.append(threading.current_thread())
        return search(foot)

    monkeypatch.setattr(landmarks, "_search", noted)
    return threads


def test_landmarks_are_found_while_the_case_is_read(
    app: Application,
    qtbot: QtBot,
    tmp_path: Path,
    make_foot: Callable[[Side], Foot],
    threads_of_search: list[threading.Thread],
    forget_results: Callable[[], None],
) -> None:
    path = tmp_path / "anna.insole"
    foot = FootRecord.begun(make_foot(Side.LEFT), ScanSource("mesh", "anna.stl", "0" * 64))
    write_case(CaseRecord().with_foot(foot), path)
    threads_of_search.clear()
    forget_results()
    app.features.case_files.opener.open_path(path)
    qtbot.waitUntil(lambda: app.case.record.foot is not None)
    qtbot.waitUntil(lambda: not app.jobs.is_running())
    assert threads_of_search
    assert threading.main_thread() not in threads_of_search


CAPTURE = ScanSource("session", "/nowhere/capture", "1" * 64)


@pytest.mark.parametrize(
    ("here", "is_alone", "sides"),
    [
        pytest.param(CAPTURE, True, [Side.LEFT], id="one foot"),
        pytest.param(CAPTURE, False, [Side.LEFT, Side.RIGHT], id="a capture of both"),
        pytest.param(
            replace(CAPTURE, mirrored=True), True, [Side.LEFT, Side.RIGHT], id="its mirror image"
        ),
        pytest.param(
            replace(CAPTURE, path="/nowhere/right"),
            True,
            [Side.LEFT, Side.RIGHT],
            id="two captures",
        ),
    ],
)
def test_a_recording_of_one_foot_is_one_foot_of_the_case(
    app: Application,
    make_foot: Callable[[Side], Foot],
    here: ScanSource,
    is_alone: bool,
    sides: list[Side],
) -> None:
    """What was made as a right foot, and is a left one, takes its place in one step of undo."""
    case = app.case
    case.open_foot(make_foot(Side.RIGHT), here)
    assert case.record.design is not None
    case.apply(case.record.design.with_added(Pelott(centre_mm=(0.0, 140.0))), "Place a pelott")
    before = case.record
    left = ScannedFoot(make_foot(Side.LEFT), CAPTURE, is_alone=is_alone)
    app.features.case_files.opener.take_scan(left)
    assert [foot.side for foot in case.record.feet] == sides
    assert case.record.current is not None
    assert case.record.current.foot is left.foot
    earlier = case.record.current.earlier  # what was prescribed on the foot that left is offered
    assert (earlier is not None) is (sides == [Side.LEFT])
    case.undo()
    assert case.record.feet == before.feet


def test_a_foot_that_was_mistaken_leaves_though_its_side_was_there(
    app: Application, make_foot: Callable[[Side], Foot]
) -> None:
    case = app.case
    case.open_foot(make_foot(Side.RIGHT), CAPTURE)
    case.apply(FootRecord.begun(make_foot(Side.LEFT), CAPTURE), "Add the left foot")
    left = ScannedFoot(make_foot(Side.LEFT), CAPTURE, is_alone=True)
    app.features.case_files.opener.take_scan(left)
    assert [foot.foot for foot in case.record.feet] == [left.foot]
    case.undo()
    assert [foot.side for foot in case.record.feet] == [Side.LEFT, Side.RIGHT]
