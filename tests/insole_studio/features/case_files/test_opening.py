"""What opening a case costs the window: the search for the landmarks is none of its work."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
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
