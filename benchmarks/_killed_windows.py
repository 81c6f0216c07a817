"""Windows that work on one visit until they are killed, and note what they said was kept."""

from __future__ import annotations

import json
import os
import random
import signal
import sys
import traceback
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication

from insole_studio.app.bootstrap import Application, build_application, qt_application
from insole_studio.document.record_keeper import KeepState
from insole_studio.scene.canvas import ImageCanvas
from insole_studio.settings import Settings, save_settings
from insole_studio.user_paths import UserPaths

FIRST_MM: Final = 3.0
STEP_MM: Final = 0.001
_TICK_MS = 10
_PAUSES_MS = (20, 2500)
_KEPT = ("Saved in the record", "your work is kept here")


def thickness_of(number: int) -> float:
    """Return the thickness that a change sets."""
    return round(FIRST_MM + number * STEP_MM, 3)


def _number(thickness_mm: float) -> int:
    return round((thickness_mm - FIRST_MM) / STEP_MM)


@dataclass(frozen=True)
class Station:
    """A computer with the windows of one user.

    Parameters
    ----------
    notes
        File of what the windows said: lines such as ``{"kept": 12}``.
    """

    folder: Path
    visit_id: str
    notes: Path

    @property
    def paths(self) -> UserPaths:
        return UserPaths(self.folder / "config/settings.json", self.folder / "data/autosave")

    def set_up(self, url: str, contents: Path) -> None:
        """Let the windows open the record of a server."""
        self.paths.make_private()
        settings = Settings(language="en", record_database=url, record_contents=str(contents))
        save_settings(settings, self.paths.settings_file)

    def start(self, seed: str, *, edits: bool) -> int:
        """Start a window in a process of its own; return its number."""
        process = os.fork()
        if process:
            return process
        code = 1
        try:
            code = _Window(self, random.Random(seed), edits=edits).run()
        except BaseException:  # noqa: BLE001 - the process ends here, whatever it was
            traceback.print_exc()
        finally:
            sys.stderr.flush()
            os._exit(code)

    def said(self, key: str) -> list[Any]:
        """Return what the windows said of a kind."""
        lines = self.notes.read_text().splitlines() if self.notes.exists() else []
        found = [json.loads(line) for line in lines]
        return [line[key] for line in found if key in line]


class _Window:
    """The window of the product; a user who changes the foot, or one who only looks."""

    def __init__(self, station: Station, rng: random.Random, *, edits: bool) -> None:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        ImageCanvas.render_now = _aim_only  # type: ignore[method-assign]
        self._station = station
        self._rng = rng
        self._edits = edits
        self._notes = os.open(station.notes, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o600)
        self._qt: QApplication = qt_application()
        self._app: Application = build_application(self._qt, station.paths)
        self._is_editing = self._has_asked = False
        self._last: object = None

    def run(self) -> int:
        """Work until the process is killed."""
        app = self._app
        app.features.records.show_start()
        app.window.show()
        app.recover()
        app.services.clinic.open()
        timers = [_every(_TICK_MS, self._look)]
        if self._edits:
            timers.append(_every(_TICK_MS, self._open_visit))
        return self._qt.exec()

    def _note(self, key: str, value: object) -> None:
        os.write(self._notes, f"{json.dumps({key: value})}\n".encode())

    def _look(self) -> None:
        """Note what the status line says is kept, and what should not be said at all."""
        app = self._app
        text = app.window.status.kept_text
        if self._is_editing and any(text.endswith(words) for words in _KEPT):
            design = app.case.record.design
            assert design is not None
            if design is not self._last:
                self._last = design
                self._note("kept", _number(design.thickness_mm))
        if app.services.keeper.state is KeepState.CONFLICT:
            self._note("fault", "a conflict with nobody")
            os._exit(2)
        for dialog in list(app.services.messages.dialogs):
            self._note("told", dialog.text())
            dialog.done(0)
        for sentence in app.complaints:
            self._note("fault", sentence)
        app.complaints.clear()

    def _open_visit(self) -> None:
        """Open the visit once nothing waits to be handed over, and begin to change it."""
        app, clinic = self._app, self._app.services.clinic
        if self._is_editing or not clinic.is_open:
            return
        if app.case.kept is not None:
            self._is_editing = True
            design = app.case.record.design
            assert design is not None
            self._note("opened", _number(design.thickness_mm))
            self._edit()
        elif not self._has_asked and not list(
            self._station.paths.autosave_folder.glob("[!.]*.insole")
        ):
            self._has_asked = True
            app.services.keeper.open_visit(self._station.visit_id, self._missed)

    def _missed(self, _error: Exception) -> None:
        self._has_asked = False

    def _edit(self) -> None:
        case = self._app.case
        design = case.record.design
        assert design is not None
        number = _number(design.thickness_mm) + 1
        case.apply(replace(design, thickness_mm=thickness_of(number)), f"Change {number}")
        QTimer.singleShot(self._rng.randint(*_PAUSES_MS), self._edit)


def _every(interval_ms: int, run: Callable[[], None]) -> QTimer:
    timer = QTimer()
    timer.setInterval(interval_ms)
    timer.timeout.connect(run)
    timer.start()
    return timer


def _aim_only(canvas: ImageCanvas) -> None:
    """Do all of drawing but the pixels."""
    if canvas.plotter is not None and canvas.isVisible():
        canvas.aim()
