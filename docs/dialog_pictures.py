"""The pictures of the manual: who takes each of them, and what window it shows."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from datetime import date, timedelta
from functools import partial
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QElapsedTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog, QPushButton, QWidget

from insole_core.cases.case_file import read_case
from insole_core.records.author import Author
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import open_records
from insole_core.records.visit import Visit
from insole_core.resources import resource_path
from insole_studio.app.scripted import ScriptedWindow, grab, wait_for
from insole_studio.features.calibrate.print_dialog import PrintDialog
from insole_studio.features.calibrate.stage import CalibrateStage
from insole_studio.features.capture.stage import CaptureStage
from insole_studio.features.clinic.accounts_dialog import AccountsDialog
from insole_studio.features.clinic.audit_dialog import AuditDialog
from insole_studio.features.clinic.backup_dialog import BackupDialog
from insole_studio.features.clinic.place_dialog import PlaceDialog
from insole_studio.features.clinic.restore_dialog import RestoreDialog
from insole_studio.features.compare.stage import CompareStage
from insole_studio.features.design.devices.devices_view import DevicesView
from insole_studio.features.design.devices.materials_dialog import MaterialsDialog
from insole_studio.features.export.stage import ExportStage
from insole_studio.features.import_scan.import_dialog import ImportDialog
from insole_studio.features.records.patient_dialogs import NewPatientDialog
from insole_studio.scene.scene_view import SceneView
from insole_studio.texts import tr
from insole_studio.user_paths import UserPaths
from insole_studio.widgets.key_help import KeyHelp

EXAMPLE = resource_path("example/example.insole")
PATIENCE_MS, LOOK_MS = 20_000, 50
SHOWN_MS = 400
STAGE = (1366, 730)

REASONS = {"en": ("Heel pain, right", "Control"), "sv": ("Hälsmärta, höger", "Kontroll")}
"""Of the visits of a patient."""

Window = TypeVar("Window", bound=QWidget)
Take = Callable[[QWidget], None]


@dataclass(frozen=True)
class DialogPicture:
    """A picture of a dialog or of the window of a stage.

    Parameters
    ----------
    name
        That of the file.
    window
        Class of what is shown.
    action
        The action that opens it.
    wait_ms
        How long it takes, once it is ready, until it shows what it is opened for.
    ready
        English text of a button that is enabled from then on; empty where it is ready at once.
    """

    name: str
    window: type[QWidget]
    action: str
    wait_ms: int = SHOWN_MS
    ready: str = ""


DIALOGS = (
    DialogPicture("capture", CaptureStage, "capture", wait_ms=3000, ready="Capture"),
    DialogPicture("calibrate", CalibrateStage, "calibrate"),
    DialogPicture("print-boards", PrintDialog, "print_boards"),
    DialogPicture("compare", CompareStage, "compare"),
    DialogPicture("export", ExportStage, "export"),
    DialogPicture("devices-list", DevicesView, "choose_device"),
    DialogPicture("materials", MaterialsDialog, "edit_materials"),
    DialogPicture("new-patient", NewPatientDialog, "new_patient"),
    DialogPicture("backup", BackupDialog, "backup"),
    DialogPicture("restore", RestoreDialog, "restore_record"),
    DialogPicture("accounts", AccountsDialog, "accounts"),
    DialogPicture("audit-log", AuditDialog, "audit_log"),
    DialogPicture("record-place", PlaceDialog, "record_place"),
    DialogPicture("keys", KeyHelp, "keys"),
)
SCAN = DialogPicture("scan-import", ImportDialog, "open_archive")
"""Opened with a scan, by no action alone."""

OF_JOURNEYS = {
    "1-opened": "test_whole_journey",
    "2-landmarks": "test_whole_journey",
    "3-pelott": "test_whole_journey",
    "4-posting": "test_whole_journey",
    "5-section": "test_whole_journey",
    "6-checked": "test_whole_journey",
    "6-exported": "test_whole_journey",
}
"""Pictures that journeys of the tests take, which do and check what the manual tells."""
OF_WINDOWS = (
    "window-light",
    "window-dark-height-map",
    "feet-compared",
    "variants-compared",
    "foot-views",
    "foot-agreement",
    "foot-corrected",
    "devices",
    "pressure",
    "pressure-change",
    "start-page",
)
"""Pictures that `pictures` takes of the main window and the foot stage."""


def open_record(studio: ScriptedWindow) -> None:
    """Open the record, as the program does when it starts, and show its start page."""
    clinic = studio.app.services.clinic
    clinic.open()
    until(lambda: clinic.author is not None, "the record")
    studio.app.window.actions_by_key["patients"].trigger()
    QTest.qWait(1000)  # until the lists have been read
    studio.settle()


def until(is_so: Callable[[], bool], what: str) -> None:
    """Wait until something is so.

    Raises
    ------
    TimeoutError
        When it takes too long.
    """
    clock = QElapsedTimer()
    clock.start()
    while not is_so():
        if clock.hasExpired(PATIENCE_MS):
            raise TimeoutError(f"{what} does not come")
        QTest.qWait(LOOK_MS)


def take_dialogs(studio: ScriptedWindow, folder: Path) -> None:
    """Take the pictures of all dialogs and stages; the example must be open."""
    for picture in DIALOGS:
        show(studio, picture, partial(save, folder=folder, name=picture.name))


def show(studio: ScriptedWindow, picture: DialogPicture, take: Take) -> None:
    """Open what a picture shows, take the picture, and close it.

    Raises
    ------
    TimeoutError
        When the action opens no such window.
    """
    studio.app.window.actions_by_key[picture.action].trigger()
    take_and_close(picture, take)
    studio.settle()


def take_and_close(picture: DialogPicture, take: Take) -> None:
    """Wait for what a picture shows, take the picture, and close it."""
    until(lambda: next(shown_windows(picture.window), None) is not None, picture.window.__name__)
    shown = next(shown_windows(picture.window), None)
    assert shown is not None
    take(shown)
    _close(shown)


def save(shown: QWidget, folder: Path, name: str) -> None:
    """Save a picture of a window, once it shows what it is opened for."""
    if not isinstance(shown, QDialog):
        shown.resize(*STAGE)
    picture = next((picture for picture in DIALOGS if picture.name == name), SCAN)
    until(lambda: not picture.ready or _can_press(shown, tr(picture.ready)), picture.ready)
    QTest.qWait(picture.wait_ms)
    jobs = getattr(shown, "jobs", None)
    if jobs is not None:
        wait_for(jobs)
    if not grab(shown, shown.findChildren(SceneView)).save(str(folder / f"{name}.png")):
        raise OSError(f"{folder} cannot be written")


def _can_press(shown: QWidget, text: str) -> bool:
    return any(b.text() == text and b.isEnabled() for b in shown.findChildren(QPushButton))


def shown_windows(kind: type[Window]) -> Iterator[Window]:
    """Yield the windows of a kind that are shown."""
    for window in QApplication.topLevelWidgets():
        if isinstance(window, kind) and window.isVisible():
            yield window


def _close(shown: QWidget) -> None:
    if isinstance(shown, QDialog):
        shown.reject()
    else:
        shown.close()


def fill_record(paths: UserPaths, language: str) -> None:
    """Begin a record with some patients, of whom one has visits."""
    example = read_case(EXAMPLE)
    place = RecordsPlace.local(paths.records_folder)
    with closing(open_records(place, Author("Dr. Eva Holm", "desk"))) as records:
        for name, born in (
            ("Bo Ek", date(1958, 5, 3)),
            ("Cia Alm", date(1991, 11, 17)),
            ("Dan Sjö", date(1983, 7, 9)),
        ):
            records.persons.add(Person(name, born))
        anna = records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
        for days, reason in zip((120, 0), REASONS[language], strict=True):
            visit = records.visits.add(
                Visit(anna.id, date.today() - timedelta(days=days), reason=reason)
            )
            records.prescriptions.save(visit.id, example.feet[0], None)
