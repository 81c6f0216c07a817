"""A visit whose patient is erased is closed, and nothing of the patient is left; all goes on."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from datetime import date
from hashlib import sha256
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication, QLabel, QLineEdit
from pytestqt.qtbot import QtBot

from insole_core.cases.scan_source import ScanSource
from insole_core.geometry.side import Side
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.retention import ErasureReason, erase_person
from insole_core.records.visit import Visit
from insole_studio.app.bootstrap import Application, build_application
from insole_studio.document.record_keeper import KeepState
from insole_studio.features.clinic.erase_dialog import EraseDialog
from insole_studio.user_paths import UserPaths


@pytest.fixture
def second(
    qapp: QApplication, opened: Application, paths: UserPaths, visit: Visit, qtbot: QtBot
) -> Iterator[Application]:
    """Another window of the same record, which has the same visit open."""
    built = build_application(qapp, paths)
    built.window.resize(960, 640)
    built.window.show()
    built.services.clinic.open()
    qtbot.waitUntil(lambda: built.services.clinic.is_open)
    built.features.records.open_visit(visit.id)
    qtbot.waitUntil(lambda: built.case.kept is not None)
    yield built
    built.autosave.forget()
    built.close()


def erase(app: Application, qtbot: QtBot) -> EraseDialog:
    """Erase the patient of the open visit by the menu."""
    app.window.actions_by_key["erase_patient"].trigger()
    (dialog,) = app.window.findChildren(EraseDialog)
    qtbot.waitUntil(lambda: "visits 1" in dialog.means.text())
    dialog.reason.setCurrentIndex(1)
    dialog.reason.activated.emit(1)
    dialog.erase.click()  # asks
    dialog.erase.click()
    qtbot.waitUntil(lambda: "has been erased" in dialog.message.text())
    return dialog


def type_note(app: Application, text: str) -> None:
    """Change the case of the window."""
    app.case.apply(replace(app.case.record.patient, notes=text), "Edit")


def texts_of(app: Application) -> str:
    """Return all that can be read in a window."""
    labels = [label.text() for label in app.window.findChildren(QLabel)]
    lines = [line.text() for line in app.window.findChildren(QLineEdit)]
    return "\n".join((app.window.windowTitle(), *labels, *lines))


def is_left_on_disk(paths: UserPaths, word: str) -> bool:
    folders = (paths.autosave_folder, paths.settings_folder)
    files = [path for folder in folders for path in folder.rglob("*") if path.is_file()]
    return any(word.encode() in path.read_bytes() for path in files)


def assert_closed(app: Application) -> None:
    assert app.case.is_empty
    assert app.case.kept is None
    assert app.window.page is app.features.records.start
    assert app.services.keeper.state is KeepState.NOTHING
    assert "Anna" not in texts_of(app)
    texts = [notice.text for notice in app.services.notices.notices]
    assert texts == ["The patient whose visit was open was erased; the visit was closed."]


def test_the_window_that_erases_and_another_one_close_the_visit_and_go_on(
    opened: Application, second: Application, records: Records, paths: UserPaths, qtbot: QtBot
) -> None:
    type_note(second, "Anna feels better")
    qtbot.waitUntil(lambda: second.services.keeper.state is KeepState.SAVED)
    dialog = erase(opened, qtbot)
    qtbot.waitUntil(lambda: opened.case.is_empty and second.case.is_empty)
    assert dialog.isVisible()  # it tells what was erased
    dialog.close_button.click()
    for app in (opened, second):
        assert_closed(app)
    qtbot.waitUntil(lambda: not opened.services.leftovers.are_noted)
    assert not is_left_on_disk(paths, "Anna")
    berta = records.persons.add(Person("Berta Dal"))
    opened.features.records.show_person(berta.id)
    assert opened.window.page is opened.features.records.person
    assert opened.services.notices.notices != ()
    for app in (opened, second):
        with qtbot.waitSignal(app.controller.closed):
            app.window.close()


@pytest.mark.parametrize("time_is_over", [False, True], ids=["kept by law", "all goes"])
def test_a_change_that_the_record_refuses_as_the_patient_is_erased_closes_the_visit_and_leaves_it(
    opened: Application,
    records: Records,
    visit: Visit,
    paths: UserPaths,
    qtbot: QtBot,
    time_is_over: bool,
) -> None:
    """Before the window has looked at the record again."""
    opened.services.clinic._watch.stop()
    today = date(2090, 1, 1) if time_is_over else date.today()
    erase_person(records.context, visit.person_id, ErasureReason.REQUEST, today)
    type_note(opened, "Anna feels better")
    opened.autosave.write_now()
    assert list(paths.autosave_folder.glob("*.insole"))
    with qtbot.waitSignal(opened.controller.closed):
        opened.window.close()
    assert opened.case.is_empty
    assert not opened.services.messages.dialogs
    assert not list(paths.autosave_folder.glob("*.insole"))


def test_scans_of_somebody_erased_are_no_recent_files_and_their_folder_is_not_proposed(
    opened: Application, records: Records, visit: Visit, tmp_path: Path, qtbot: QtBot
) -> None:
    """Whatever they are called; a scan of somebody else stays."""
    hers, other, gone = (tmp_path / who / "left.stl" for who in ("hers", "other", "gone"))
    for path in (hers, other):
        path.parent.mkdir()
        path.write_bytes(path.parent.name.encode())
    session = tmp_path / "sessions" / "2026-11-28"
    (before,) = records.visits.open_case(visit.id).record.feet
    for source in (
        ScanSource("mesh", str(hers), sha256(b"hers").hexdigest()),
        ScanSource("session", str(session), "1" * 64),  # is not there any more
    ):
        bases = records.visits.open_case(visit.id).bases
        records.prescriptions.save(visit.id, replace(before, source=source), bases[Side.LEFT])
    settings = opened.settings
    settings.recent = [str(path) for path in (hers, other, gone, session)]
    settings.scans_folder, settings.exports_folder = str(hers.parent), str(other.parent)
    erase(opened, qtbot)
    qtbot.waitUntil(lambda: settings.recent == [str(other), str(gone)])
    assert (settings.scans_folder, settings.exports_folder) == ("", str(other.parent))


def test_undo_on_the_page_of_somebody_erased_brings_no_name_back(
    clinic: Application, records: Records, rest: Callable[[], None], qtbot: QtBot
) -> None:
    anna = records.persons.add(Person("Anna Berg"))
    pages = clinic.features.records
    pages.show_person(anna.id)
    qtbot.waitUntil(lambda: pages.name_on_page == "Anna Berg")
    assert pages.person is not None
    pages.person.field_edited.emit("name", "Anna Dal")
    qtbot.waitUntil(lambda: records.persons.get(anna.id).name == "Anna Dal")
    rest()
    erase_person(records.context, anna.id, ErasureReason.REQUEST, date.today())
    qtbot.waitUntil(lambda: pages.name_on_page == anna.pseudonym)
    clinic.controller.run_action("undo", False)
    assert pages.name_on_page == anna.pseudonym
    assert "Anna" not in texts_of(clinic)
