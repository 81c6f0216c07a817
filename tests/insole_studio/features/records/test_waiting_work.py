"""What the record could not take yet outlives a kill, and is stored by the next window."""

from __future__ import annotations

import signal
import subprocess
import sys
import textwrap
from collections.abc import Callable
from contextlib import closing
from datetime import date
from pathlib import Path

import pytest
from PySide6.QtGui import QColor, QImage
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.records.author import Author
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records, open_records
from insole_core.records.traces import Traces
from insole_core.records.visit import Visit
from insole_studio.document.record_maintenance import forget_leftovers
from insole_studio.document.waiting_work import WaitingWork
from insole_studio.user_paths import UserPaths
from tests.patience import PATIENCE_S

KILLED = """
    import os, signal, sys
    from pathlib import Path
    from PySide6.QtCore import QPoint, Qt
    from PySide6.QtTest import QTest
    from insole_core.errors import Unreachable
    from insole_core.export.shop_order import OrderTerms
    from insole_core.records.orders import Orders
    from insole_core.records.photos import Photos
    from insole_core.workflows.order_package import Ordered
    from insole_studio.app.bootstrap import build_application, qt_application
    from insole_studio.features.records.photos_dialog import PhotosDialog
    from insole_studio.user_paths import UserPaths

    settings, autosave, visit_id, solid = sys.argv[1:]
    qt = qt_application()
    app = build_application(qt, UserPaths(Path(settings), Path(autosave)))
    app.window.show()

    def until(is_so):
        while not is_so():
            qt.processEvents()

    def fail(*_given, **_more):
        raise Unreachable("The database does not answer.")

    Photos.change = Orders.add = fail
    clinic, records = app.services.clinic, app.features.records
    clinic.open()
    until(lambda: clinic.is_open)
    records.open_visit(visit_id)
    until(lambda: app.case.kept is not None)
    ordered = Ordered((Path(solid),), OrderTerms(colour="black"), "26-7")
    records.order_actions.note_export(app.case.record, ordered, visit_id)
    records.photos.open(visit_id)
    dialogs = lambda: app.window.findChildren(PhotosDialog)
    until(lambda: dialogs() and not dialogs()[0].picture.picture_rect.isEmpty())
    picture = dialogs()[0].picture
    QTest.mouseClick(
        picture, Qt.MouseButton.LeftButton, pos=picture.picture_rect.center().toPoint()
    )
    QTest.keyClicks(dialogs()[0].text, "sore")
    QTest.keyClick(dialogs()[0].text, Qt.Key.Key_Return)
    os.kill(os.getpid(), signal.SIGKILL)
"""


def record_of(paths: UserPaths) -> Records:
    return open_records(RecordsPlace.local(paths.records_folder), Author("anna", "desk"))


@pytest.fixture
def visit_id(paths: UserPaths, make_foot: Callable[[Side], Foot], tmp_path: Path) -> str:
    """A visit with a prescription and a photo, in a record that no window has open."""
    image = QImage(400, 300, QImage.Format.Format_RGB32)
    image.fill(QColor("#c8a08c"))
    assert image.save(str(tmp_path / "sole.png"))
    source = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
    with closing(record_of(paths)) as records:
        anna = records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
        visit = records.visits.add(Visit(anna.id, date.today()))
        records.prescriptions.save(visit.id, FootRecord.begun(make_foot(Side.LEFT), source), None)
        records.photos.add(visit.id, tmp_path / "sole.png")
    return visit.id


@pytest.fixture
def killed(paths: UserPaths, visit_id: str, tmp_path: Path) -> None:
    """A window draws and orders while the record does not answer, and is killed."""
    (tmp_path / "p-left.stl").write_bytes(b"solid")
    arguments = [paths.settings_file, paths.autosave_folder, visit_id, tmp_path / "p-left.stl"]
    call = [sys.executable, "-c", textwrap.dedent(KILLED), *map(str, arguments)]
    died = subprocess.run(call, timeout=PATIENCE_S, check=False, capture_output=True)
    assert died.returncode == -signal.SIGKILL, died.stderr.decode()


@pytest.mark.slow
def test_marks_and_orders_are_stored_by_the_window_after_one_that_was_killed(
    killed: None, visit_id: str, paths: UserPaths, records: Records, qtbot: QtBot
) -> None:
    waiting = paths.waiting_photos_folder.parent
    qtbot.waitUntil(lambda: not list(waiting.rglob("*.json")))
    (mark,) = records.photos.of_visit(visit_id)[0].marks
    assert mark.text == "sore"
    (listed,) = records.orders.of_person(records.visits.get(visit_id).person_id)
    order = records.orders.get(listed.id)
    assert (order.number, [file.name for file in order.files]) == ("26-7", ["p-left.stl"])


def test_what_a_running_window_works_on_is_its_own(tmp_path: Path) -> None:
    running, other = waiting(tmp_path), waiting(tmp_path)
    running.keep("photo-1", "visit-1", {"caption": "sole"})
    assert other.take_over() == []
    running.close()
    (left,) = other.take_over()
    assert (left.key, left.visit_id, left.content.text("caption")) == ("photo-1", "visit-1", "sole")
    assert waiting(tmp_path).take_over() == []
    other.drop("photo-1")
    other.close()
    assert list(tmp_path.iterdir()) == []


def test_what_waits_of_an_erased_patient_goes_and_that_of_others_stays(paths: UserPaths) -> None:
    window = waiting(paths.waiting_orders_folder)
    for number in "12":
        window.keep(f"order-{number}", f"visit-{number}", {"number": f"26-{number}"})
    window.close()
    forget_leftovers(Traces.of(("Anna Berg",), {"visit-1"}), paths)
    next_window = waiting(paths.waiting_orders_folder)
    (left,) = next_window.take_over()
    assert left.visit_id == "visit-2"
    next_window.close()


def test_damaged_work_is_set_aside_and_told(tmp_path: Path) -> None:
    window = waiting(tmp_path)
    window.keep("photo-1", "visit-1", {})
    window.close()
    (file,) = tmp_path.rglob("*.json")
    file.write_text('{"visit": ')
    told: list[str] = []
    assert WaitingWork(tmp_path, told.append).take_over() == []
    (kept,) = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert "broken" in kept.name
    (sentence,) = told
    assert str(kept) in sentence


@pytest.mark.parametrize("kind", ["photos", "orders"])
def test_what_the_record_can_never_take_is_told_once_and_set_aside(
    kind: str, visit_id: str, paths: UserPaths, request: pytest.FixtureRequest
) -> None:
    """Neither marks that are no pairs nor an order without files are tried again for ever."""
    folder = paths.data_folder / "waiting" / kind
    with closing(record_of(paths)) as records:
        (photo,) = records.photos.of_visit(visit_id)
    window = waiting(folder)
    window.keep(photo.id, visit_id, {"caption": "", "marks": [{"points": [1]}], "revision": 1})
    window.close()
    services = request.getfixturevalue("clinic").services  # opened only now
    rest = request.getfixturevalue("rest")
    rest()
    services.clinic.state_changed.emit()
    rest()
    (told,) = services.messages.dialogs
    assert list(folder.rglob("*.json")) == []
    (kept,) = folder.rglob("*.broken-*")
    assert str(kept) in told.text()


def waiting(folder: Path) -> WaitingWork:
    """Return the work of a window that has nothing to tell."""
    return WaitingWork(folder, pytest.fail)
