"""Scans are stored with the visit, and those of the capture room appear at the desk."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from datetime import date
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.given_file import sha256_of
from insole_core.recording.hand_edits import HandEdits, ViewEdits
from insole_core.recording.hand_edits_file import write_edits
from insole_core.recording.reader import read_session
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.visit import CaptureState, Visit
from insole_core.workflows.scanned_feet import session_source
from insole_studio.app.bootstrap import Application
from insole_studio.texts import moment_text

pytestmark = pytest.mark.one_window

MOST_BYTES = 10_000_000


def test_the_scan_of_a_foot_is_stored_with_its_visit(
    opened: Application,
    records: Records,
    visit: Visit,
    make_foot: Callable[[Side], Foot],
    tmp_path: Path,
    qtbot: QtBot,
) -> None:
    scan = tmp_path / "right.stl"
    scan.write_bytes(b"solid foot")
    source = ScanSource("mesh", str(scan), sha256_of(scan, MOST_BYTES))
    qtbot.waitUntil(lambda: opened.features.records.captures._stored is not None)
    opened.case.open_foot(make_foot(Side.RIGHT), source)
    qtbot.waitUntil(lambda: len(records.captures.of_visit(visit.id)) == 1)
    (capture,) = records.captures.of_visit(visit.id)
    assert (capture.kind, capture.file_name) == ("mesh", "right.stl")
    assert capture.source_sha256 == source.sha256


def test_a_capture_of_another_station_is_offered_soon(
    opened: Application,
    other_station: Records,
    visit: Visit,
    small_session: Path,
    qtbot: QtBot,
) -> None:
    captures = opened.features.records.captures
    qtbot.waitUntil(lambda: captures._stored is not None)
    other_station.captures.add(visit.id, "session", small_session)
    notices = opened.services.notices
    qtbot.waitUntil(lambda: bool(notices.notices))
    (notice,) = notices.notices
    assert "Dr. Dal" in notice.text
    fetched: list[Path] = []
    captures.fetched.disconnect(opened.features.case_files.opener.open_path)
    captures.fetched.connect(fetched.append)
    notices.take(notice.key)
    qtbot.waitUntil(lambda: bool(fetched))
    assert sha256_of(fetched[0], MOST_BYTES) == sha256_of(small_session, MOST_BYTES)


def test_a_capture_that_is_taken_as_the_other_foot_is_stored_as_that(
    opened: Application,
    records: Records,
    visit: Visit,
    small_session: Path,
    make_foot: Callable[[Side], Foot],
    tmp_path: Path,
    qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    session = tmp_path / "session.zip"
    session.write_bytes(small_session.read_bytes())
    records.captures.add(visit.id, "session", session)
    captures = opened.features.records.captures
    qtbot.waitUntil(lambda: captures._stored is not None)
    captures._look()
    write_edits(HandEdits(side=Side.RIGHT), session)
    source = session_source(session, read_session(session))
    opened.case.open_foot(make_foot(Side.RIGHT), source)

    def side() -> Side:
        (capture,) = records.captures.of_visit(visit.id)
        return read_session(records.captures.copy_to(capture, tmp_path)).manifest.one_side

    qtbot.waitUntil(lambda: side() is Side.RIGHT)
    # Opened another time, with its markers corrected: the record has it as that foot already.
    write_edits(HandEdits({"left": ViewEdits(off=True)}, side=Side.RIGHT), session)
    again: list[Path] = []
    monkeypatch.setattr(captures, "store", lambda _visit, path, _kind: again.append(path))
    captures._stored = None
    captures._look()
    qtbot.waitUntil(lambda: captures._stored is not None)
    assert again == []


def test_the_foot_of_a_capture_stores_it_only_once(
    opened: Application,
    other_station: Records,
    visit: Visit,
    small_session: Path,
    make_foot: Callable[[Side], Foot],
    tmp_path: Path,
    qtbot: QtBot,
) -> None:
    """The capture room stores a folder, and the desk opens a copy of it, which is an archive."""
    captures = opened.features.records.captures
    qtbot.waitUntil(lambda: captures._stored is not None)
    with zipfile.ZipFile(small_session) as archive:
        archive.extractall(tmp_path / "session")
    stored = other_station.captures.add(visit.id, "session", tmp_path / "session")
    notices = opened.services.notices
    qtbot.waitUntil(lambda: bool(notices.notices))
    copy = other_station.captures.copy_to(stored, tmp_path)
    source = ScanSource("session", str(copy), sha256_of(copy, MOST_BYTES))
    opened.case.open_foot(make_foot(Side.LEFT), source)
    scan = tmp_path / "right.stl"
    scan.write_bytes(b"solid foot")
    opened.case.open_foot(
        make_foot(Side.RIGHT), ScanSource("mesh", str(scan), sha256_of(scan, MOST_BYTES))
    )  # what is stored after it tells that it was not
    qtbot.waitUntil(
        lambda: "right.stl" in [c.file_name for c in other_station.captures.of_visit(visit.id)]
    )
    assert [c.kind for c in other_station.captures.of_visit(visit.id)] == ["mesh", "session"]


def test_the_capture_room_stores_a_session_with_a_visit_of_its_work_list(
    clinic: Application,
    records: Records,
    small_session: Path,
    qtbot: QtBot,
) -> None:
    anna = records.persons.add(Person("Anna Berg"))
    wanted = Visit(anna.id, date.today(), capture_state=CaptureState.WANTED)
    records.visits.add(wanted)
    clinic.controller.run_action("capture", False)
    stage = clinic.features.capture.stage
    assert stage is not None
    visits = stage.view._visits
    qtbot.waitUntil(lambda: visits.count() == 2)
    assert [visits.itemText(number) for number in range(2)] == [
        "Nobody of the work list",
        "Anna Berg",
    ]
    assert stage.view.visit_id == wanted.id  # the only one
    stage.kept.emit(small_session)
    qtbot.waitUntil(lambda: len(records.captures.of_visit(wanted.id)) == 1)
    assert records.visits.get(wanted.id).capture_state is CaptureState.DONE
    (capture,) = records.captures.of_visit(wanted.id)
    assert capture.facts.sensor_serials
    bo = records.persons.add(Person("Bo Ek"))
    records.visits.add(Visit(bo.id, date.today(), capture_state=CaptureState.WANTED))
    qtbot.waitUntil(lambda: visits.findText("Bo Ek") > 0)
    assert stage.view.visit_id == wanted.id  # the other foot is of the same patient
    bos = records.visits.add(Visit(bo.id, date.today(), capture_state=CaptureState.WANTED))
    named = f"Bo Ek, visit of {moment_text(bos.created_at)}"  # else there are two equal ones
    qtbot.waitUntil(lambda: visits.findText(named) > 0)
    assert visits.findText("Bo Ek") == -1
    stage.close()
    assert clinic.features.foot.stage is None


def test_who_else_has_the_visit_open_is_told(
    clinic: Application, other_station: Records, visit: Visit, qtbot: QtBot
) -> None:
    other_station.presence.enter(visit.id)
    clinic.features.records.open_visit(visit.id)
    notices = clinic.services.notices
    qtbot.waitUntil(lambda: bool(notices.notices))
    (notice,) = notices.notices
    assert "Dr. Dal, capture-room" in notice.text
    assert [present.station for present in other_station.presence.others(visit.id)]
    clinic.controller.run_action("new_case", False)
    qtbot.waitUntil(lambda: not other_station.presence.others(visit.id))
