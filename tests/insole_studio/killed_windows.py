"""Windows that work on one visit until they are killed, and what they said was kept.

``python killed_windows.py KILLS SEED`` tries so many kills while the server goes and comes; see the
benchmark `autosave_kills`. The windows are forked from a process that has none yet.
"""

from __future__ import annotations

import json
import os
import random
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from datetime import date
from importlib import import_module
from pathlib import Path
from typing import Any, Final

sys.path.insert(0, str(Path(__file__).parents[1] / "insole_core/records"))
from postgres_server import PostgresServer, binaries, running_server
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
from round_foot import round_foot

from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.geometry.side import Side
from insole_core.records.author import Author
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import open_records
from insole_core.records.visit import Visit
from insole_studio.app.between_events import MODULES
from insole_studio.app.bootstrap import Application, build_application, qt_application
from insole_studio.document.record_keeper import KeepState
from insole_studio.scene.canvas import ImageCanvas
from insole_studio.settings import Settings, save_settings
from insole_studio.user_paths import UserPaths

__all__ = ["FAULTS", "binaries", "main"]

FAULTS = ("lost", "fault", "damaged", "hang", "ended")
_PATIENCE_S = 240.0
_LONGEST_S = 5.0
_LOOK_S = 0.02
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
        ImageCanvas.render_now = _aim_only  # type: ignore[method-assign, assignment]
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


@dataclass
class Site:
    """A station, its server, and the windows that run."""

    station: Station
    server: PostgresServer
    rng: random.Random
    windows: list[int] = field(default_factory=list)

    def start_window(self, *, edits: bool) -> None:
        self.windows.append(self.station.start(str(self.rng.random()), edits=edits))

    def switch_server(self) -> None:
        """Stop the server without warning, or start it."""
        if self.server.is_running():
            self.server.stop("immediate")
        else:
            self.server.start()

    def kill_windows(self) -> int:
        """Kill all windows in any order; return how many had ended by themselves."""
        self.rng.shuffle(self.windows)
        ended = 0
        for process in self.windows:
            os.kill(process, signal.SIGKILL)
            code = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
            ended += code != -signal.SIGKILL
        self.windows.clear()
        return ended


def main(kills: int, seed: str) -> Counter[str]:
    """Kill windows so many times over a server of their own; return how often what happened."""
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    for module in MODULES:  # once, before the processes are forked
        import_module(module)
    with tempfile.TemporaryDirectory(prefix="autosave-kills-") as name:
        folder = Path(name)
        folder.chmod(0o755)  # the server is another user
        with running_server(durable=True, parent=folder) as server:
            return tried(folder, server, kills, seed)


def tried(folder: Path, server: PostgresServer, kills: int, seed: str) -> Counter[str]:
    """Kill windows so many times; return how often what happened."""
    station = _set_up(folder, server)
    site = Site(station, server, random.Random(seed))
    counts: Counter[str] = Counter()
    try:
        for number in range(kills):
            _open(site, counts)
            _disturb(site, counts)
            counts["kills"] += 1
            counts["ended"] += site.kill_windows()
            if number % 10 == 9:
                print(f"{number + 1} kills: {dict(counts)}", flush=True)
        _open(site, counts)
    finally:
        site.kill_windows()
    counts["said to be kept"] = len(station.said("kept"))
    counts["fault"] = len(station.said("fault"))
    counts["damaged"] = len(list(station.paths.autosave_folder.glob("*.broken-*")))
    for sentence, times in Counter([*station.said("told"), *station.said("fault")]).items():
        print(f"told {times} times: {sentence}")
    return counts


def _set_up(folder: Path, server: PostgresServer) -> Station:
    """Make a patient with a visit and a foot, and a station whose windows open their record."""
    url, contents = server.url("postgres"), folder / "contents"
    source = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
    foot = FootRecord.begun(round_foot(Side.LEFT), source)
    foot = foot.with_design(replace(foot.design, thickness_mm=FIRST_MM))
    records = open_records(RecordsPlace.of_url(url, contents), Author("setup", "setup"))
    person = records.persons.add(Person("Anna Berg"))
    visit = records.visits.add(Visit(person.id, date.today()))
    records.prescriptions.save(visit.id, foot, None)
    records.close()
    station = Station(folder, visit.id, folder / "notes")
    station.set_up(url, contents)
    return station


def _open(site: Site, counts: Counter[str]) -> None:
    """Start a window, and see whether the visit that it opens holds all that was kept."""
    station, rng = site.station, site.rng
    kept = max(station.said("kept"), default=0)
    before = len(station.said("opened"))
    counts["handed over"] += bool(list(station.paths.autosave_folder.glob("[!.]*.insole")))
    site.start_window(edits=True)
    if not site.server.is_running():
        time.sleep(rng.uniform(0.0, 3.0))
        site.server.start()
    until = time.monotonic() + _PATIENCE_S
    while len(station.said("opened")) == before:
        if time.monotonic() > until:
            counts["hang"] += 1
            return
        time.sleep(_LOOK_S)
    opened = station.said("opened")[-1]
    if opened < kept:
        counts["lost"] += 1
        print(f"lost: {kept} was said to be kept, {opened} is there", flush=True)


def _disturb(site: Site, counts: Counter[str]) -> None:
    """Let the server go and come, and a second window start, until the windows are killed."""
    rng = site.rng
    moments = sorted(rng.uniform(0.0, _LONGEST_S) for _ in range(rng.choice((1, 1, 2, 3))))
    second = rng.uniform(0.0, _LONGEST_S) if rng.random() < 0.3 else None
    end = rng.uniform(0.2, _LONGEST_S)
    begun = time.monotonic()
    while (now := time.monotonic() - begun) < end:
        if moments and now >= moments[0]:
            moments.pop(0)
            counts["stops"] += site.server.is_running()
            site.switch_server()
        if second is not None and now >= second:
            second = None
            counts["second windows"] += 1
            site.start_window(edits=False)
        time.sleep(_LOOK_S)


if __name__ == "__main__":
    happened = main(int(sys.argv[1]), sys.argv[2])
    print(dict(happened))
    sys.exit(any(happened[fault] for fault in FAULTS))
