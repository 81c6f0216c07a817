"""The window that the tests of a module share: to each of them it is as when it was started.

What a product's window costs to start, most tests have no need to pay anew: a new case clears what
hung on the one before, which `test_cases_in_turn.py` proves. What users change besides that, a test
puts back by the actions of the window, and what then still differs from the start fails the test.
"""

from __future__ import annotations

import threading
from copy import deepcopy
from dataclasses import asdict, fields
from pathlib import Path
from shutil import rmtree

from canned_questions import CannedQuestions
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication, QDialog, QDockWidget, QWidget
from shown_texts import differences, shown

from insole_studio.app.bootstrap import Application, build_application, qt_application
from insole_studio.app.scripted import wait_for
from insole_studio.document.clinic_record import RecordState
from insole_studio.settings import Settings
from insole_studio.user_paths import UserPaths
from tests import patience

SIZE = 960, 640
"""Fewer pixels for the software renderer."""
OF_LAYOUT = ("window_geometry", "window_docks")
READ_WHEN_USED = (
    "export.json", "order.json", "blocks.json", "default_device.json", "devices", "forms",
)  # fmt: skip
"""What a window keeps for the next start and reads each time it needs it: gone is as at first."""


class OneWindow:
    """A window that tests share, built for the first of them, and what it was like then."""

    def __init__(self, folder: Path) -> None:
        self.paths = UserPaths(folder / "config" / "settings.json", folder / "data" / "autosave")
        self._folder = folder
        self._built: _Built | None = None
        self._threads: set[threading.Thread] = set()

    def take(self, questions: CannedQuestions) -> Application:
        """Let a test have the window."""
        if self._built is None:
            self._threads = set(threading.enumerate())
            self._built = _Built(build_application(qt_application(), self.paths), self._folder)
        self._built.app.services.messages.questions = questions  # type: ignore[assignment]
        self._built.show()
        return self._built.app

    def put_back(self) -> None:
        """Close what is open, and let all be as at the start; end the window where it is not."""
        assert self._built is not None
        try:
            self._built.put_back()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """End the window, if there is one, with its threads: the next test gets another."""
        if self._built is None:
            return
        self._built.app.autosave.forget()
        self._built.app.close()
        self._built = None
        left = [each.name for each in set(threading.enumerate()) - self._threads]
        assert [name for name in left if name.startswith("studio-job")] == []

    def holds(self, widget: QWidget | None) -> bool:
        """Return whether a widget is the window, or belongs to it."""
        if self._built is None or widget is None:
            return False
        return widget is self._built.app.window or self.holds(widget.parentWidget())


class _Built:
    def __init__(self, app: Application, folder: Path) -> None:
        self.app = app
        self._paths = app.services.paths
        self._folder = folder
        self._settings = deepcopy(app.settings)
        self._checked = {
            key: action.isChecked()
            for key, action in app.window.actions_by_key.items()
            if action.isCheckable()
        }
        self.show()
        self._begun = self._put_back()

    def show(self) -> None:
        self.app.window.resize(*SIZE)
        self.app.window.show()
        self.app.window.activateWindow()
        QApplication.processEvents()

    def put_back(self) -> None:
        missing, added = differences(self._begun, self._put_back())
        assert not missing + added, f"the test left the window without {missing}, with {added}"

    def _put_back(self) -> list[str]:
        app = self.app
        app.services.messages.questions = CannedQuestions()  # type: ignore[assignment]
        for dialog in list(app.services.messages.dialogs):
            dialog.done(0)
        for dialog in app.window.findChildren(QDialog):
            if dialog.isVisible():
                dialog.reject()
        app.features.close_windows()
        app.window.show_panels()
        self._wait()
        for key, checked in self._checked.items():
            if key.startswith("tool_"):  # the next case takes it out of the hand
                continue
            action = app.window.actions_by_key[key]
            if action.isChecked() != checked and (checked or action.actionGroup() is None):
                action.trigger()
        app.features.case_files.opener.new_case()
        self._forget_record()
        for field in fields(Settings):
            setattr(app.settings, field.name, deepcopy(getattr(self._settings, field.name)))
        for name in READ_WHEN_USED:
            path = self._paths.settings_folder / name
            rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
        app.services.recent.changed.emit()
        app.services.messages.clear()
        app.services.notices.drop_all()
        app.window.restore_layout("", "")
        self.show()
        self._wait()
        app.window.arrange()
        QApplication.processEvents()
        patience.wait_for(self._has_written)  # else it writes after it has forgotten
        app.autosave.forget()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        app.window.statusBar().clearMessage()  # a hint of what is below the pointer comes and goes
        return self._state()

    def _forget_record(self) -> None:
        """Let go of the clinic's record, and of what was kept beside it: the next one is new."""
        clinic = self.app.services.clinic
        if clinic.state is RecordState.CLOSED:
            return
        self._wait()
        clinic.let_go()
        for folder in (
            self._paths.records_folder,
            self._paths.fetched_folder,
            self._paths.papers_folder,
            self._paths.waiting_photos_folder.parent,
            self._paths.erasures_folder,
        ):
            rmtree(folder, ignore_errors=True)

    def _wait(self) -> None:
        both = self.app.jobs, self.app.services.clinic.jobs
        while running := [jobs for jobs in both if jobs.is_running()]:
            wait_for(running[0])

    def _has_written(self) -> bool:
        QApplication.processEvents()
        return not self.app.autosave.is_writing

    def _state(self) -> list[str]:
        app, window = self.app, self.app.window
        settings = {k: v for k, v in asdict(app.settings).items() if k not in OF_LAYOUT}
        case, history = app.case, app.case.history
        docks = [
            (dock.objectName(), dock.isFloating(), dock.geometry().getRect())
            for dock in window.findChildren(QDockWidget)
            if dock.isVisible()
        ]
        return [
            *shown(app),
            f"settings {settings}",
            f"undo {history.undo_sentence} {history.redo_sentence}",
            f"case {case.is_empty} {case.path} {case.kept} {case.is_read_only}",
            f"page {window.page} clinic {app.services.clinic.is_open}",
            f"docks {docks}",
            f"dialogs {sorted(type(w).__name__ for w in window.findChildren(QDialog))}",
            f"files {sorted(str(p) for p in self._folder.rglob('*') if p.is_file())}",
        ]
