"""The whole program tried on this computer, from a session to a restored record (``self-test``).

All is written into one folder; patients' data and settings of the user are neither read nor
changed. Nothing is needed from tests, sources or the network, so that a bundle can test itself.
"""

from __future__ import annotations

import sys
import time
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from insole_core.cases.case_file import read_case
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.errors import InsoleError
from insole_core.files.atomic import make_output_folder
from insole_core.files.write_errors import describe
from insole_core.recording.reader import read_session
from insole_core.recording.session import Manifest, Session
from insole_core.records.author import Author
from insole_core.records.backup.back_up import back_up, set_up_backups
from insole_core.records.backup.backup_key import BackupKey
from insole_core.records.backup.restore import restore
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records, open_records
from insole_core.resources import resource_path
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_core.workflows.compare_case import (
    Wanted,
    compare_sources,
    surface_of,
    write_comparison,
)
from insole_core.workflows.records.keep_case import add_case
from insole_studio.acquisition.capture_plan import make_plan
from insole_studio.acquisition.messages import CapturePhase, CaptureStatus, Sensors, Start
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.acquisition.service_client import CaptureService
from insole_studio.app.recorded_session import record_simulated
from insole_studio.app.scripted import ScriptedAnswers, ScriptedWindow
from insole_studio.cli.time_limit import time_limit
from insole_studio.user_paths import UserPaths

RESOURCES = (
    "example/example.insole",
    "reference_systems/lego-20.json",
    "reference_systems/lego-40.json",
    "translations/sv/studio.qm",
    "icons",
    "devices",
    "forms",
    "pads",
    "rules",
    "matching_error",
)
MOST_SECONDS = 300.0
"""Of a step; they take up to 30 s on two slow processors."""
FRAMES = 3
PAD_MM = (0.0, 140.0)
MOST_DIFFERENCE_MM = 0.1
"""Between an insole and its exported file, on average; its numbers are single precision."""
_PAUSE_S = 0.02
_PASSPHRASE = "the backup of a self-test"


class SelfTestError(InsoleError):
    """A step gave another result than it must."""


@dataclass(frozen=True)
class StepResult:
    """What became of a step.

    Parameters
    ----------
    seconds
        None where the step was not tried.
    problem
        One sentence; empty where all is well.
    trace
        Where an error in the program itself comes from.
    """

    name: str
    seconds: float | None
    problem: str = ""
    trace: str = ""

    @property
    def line(self) -> str:
        """Return the line of the report."""
        took = "        " if self.seconds is None else f"{self.seconds:6.1f} s"
        state = "passed" if not self.problem else "failed" if self.seconds is not None else "-"
        return f"{state:<7} {took}  {self.name}" + (f": {self.problem}" if self.problem else "")


class SelfTest:
    """Tries one step after the other; steps that need a failed one are not tried.

    Parameters
    ----------
    folder
        For everything that is written.
    session
        A recorded session to play; None simulates one.
    tell
        Called with each result as soon as it is there.
    give_up
        Called, in another thread, with the result of a step that does not end; ends the process.
    """

    def __init__(
        self,
        folder: Path,
        session: Path | None,
        tell: Callable[[StepResult], None],
        give_up: Callable[[StepResult], None],
    ) -> None:
        self._folder = folder
        self._recorded = session or folder / "recorded.zip"
        self._is_simulated = session is None
        self._tell = tell
        self._give_up = give_up
        self._captured = folder / "captured"
        self._window: ScriptedWindow | None = None
        self._stl: Path | None = None
        self._faults: list[BaseException] = []

    def run(self) -> list[StepResult]:
        """Try all steps and return their results; no error is raised."""
        results: list[StepResult] = []
        failed: set[str] = set()
        try:
            with self._catching_faults():
                for name, needs, step in self._steps():
                    missing = [need for need in needs if need in failed]
                    result = (
                        StepResult(name, None, f"not tried, because “{missing[0]}” failed")
                        if missing
                        else self._try(name, step)
                    )
                    if result.problem:
                        failed.add(name)
                    results.append(result)
                    self._tell(result)
        finally:
            self._close_window()
        return results

    def _steps(self) -> tuple[tuple[str, tuple[str, ...], Callable[[], None]], ...]:
        """Return name, names of the steps that it needs, and function of each step."""
        folder, files, play = "make the folder", "find the program's files", "play it as sensors"
        record, window = "record a session", "open the window"
        make, design = "reconstruct the foot", "design the insole"
        export, save = "check, export and print the job sheet", "save the case and read it"
        keep = "write the record"
        return (
            (files, (), self._find_files),
            (folder, (), lambda: make_output_folder(self._folder)),
            (record, (folder,), self._record),
            (play, (folder, record), self._play),
            (window, (folder, files), self._open_window),
            (make, (window, play), self._reconstruct),
            (design, (make,), self._design),
            (export, (design,), self._export),
            ("compare the exported file with the insole", (export,), self._compare),
            (save, (design,), self._save),
            (keep, (save,), self._keep),
            ("back the record up and restore it", (keep,), self._restore),
            ("open the example", (window,), self._open_example),
            ("close the window", (window,), self._close_window),
        )

    def _try(self, name: str, step: Callable[[], None]) -> StepResult:
        started_s = time.perf_counter()
        problem = trace = ""

        def give_up(where: str) -> None:
            sentence = f"it did not end within {MOST_SECONDS:.0f} s"
            self._give_up(StepResult(name, MOST_SECONDS, sentence, where))

        try:
            with time_limit(MOST_SECONDS, give_up):
                step()
            self._raise_what_the_window_told()
        except InsoleError as error:
            problem = str(error)
        except OSError as error:
            problem = describe(Path(error.filename), error) if error.filename else str(error)
        except Exception as error:  # noqa: BLE001 - whatever it is, the report names the step
            problem = f"an error in the program itself ({error!r}); please report it"
            trace = "".join(traceback.format_exception(error))
        return StepResult(name, time.perf_counter() - started_s, problem, trace)

    @contextmanager
    def _catching_faults(self) -> Iterator[None]:
        """Collect what is raised in the window's own functions, which Qt only prints."""
        before = sys.excepthook
        sys.excepthook = lambda _kind, error, _trace: self._faults.append(error)
        try:
            yield
        finally:
            sys.excepthook = before

    def _raise_what_the_window_told(self) -> None:
        if self._faults:
            faults, self._faults = self._faults, []
            raise faults[0]
        if self._window is not None and (dialogs := self._window.app.services.messages.dialogs):
            told = dialogs[0].report
            for dialog in list(dialogs):
                dialog.close()
            raise SelfTestError("{sentence}", sentence=told)

    def _find_files(self) -> None:
        for name in RESOURCES:
            resource_path(name)

    def _record(self) -> None:
        if self._is_simulated:
            record_simulated(self._recorded)
        read_session(self._recorded)

    def _play(self) -> None:
        """Capture from emulated sensors, in the process that reads real ones as well."""
        recorded = read_session(self._recorded)
        store = SensorStore(self._folder / "data" / "sensors")
        service = CaptureService(SensorSource(store, self._recorded))
        try:
            service.send(_start(recorded, self._captured))
            ended = _wait_for_end(service)
        finally:
            service.close()
        if ended.phase is not CapturePhase.DONE:
            raise SelfTestError("{sentence}", sentence=ended.sentence)
        views = read_session(self._captured).manifest.views
        if set(views) != set(recorded.manifest.views):
            raise SelfTestError("The captured session has other views than the recorded one.")

    def _open_window(self) -> None:
        settings = self._folder / "settings" / "settings.json"
        paths = UserPaths(settings, self._folder / "data" / "autosave")
        window = ScriptedWindow(paths, answers=ScriptedAnswers(replace=True))
        self._window = window.__enter__()
        self._studio.app.features.records.show_start()
        self._studio.screenshot(self._folder / "start.png")

    def _close_window(self) -> None:
        if self._window is not None:
            window, self._window = self._window, None
            window.__exit__(None, None, None)

    @property
    def _studio(self) -> ScriptedWindow:
        assert self._window is not None
        return self._window

    @property
    def _case(self) -> CaseRecord:
        return self._studio.app.case.record

    def _open_example(self) -> None:
        self._studio.open(resource_path("example/example.insole"))
        self._raise_what_the_window_told()
        self._require(self._case.current is not None, "The example has no foot.")

    def _reconstruct(self) -> None:
        self._studio.open(self._captured)
        self._raise_what_the_window_told()
        side = read_session(self._captured).manifest.one_side
        self._require(self._case.of_side(side) is not None, "The session gave no foot of its side.")

    def _design(self) -> None:
        before = _correction_count(self._case)
        self._studio.place_pelott(*PAD_MM)
        self._require(_correction_count(self._case) == before + 1, "The pelott was not placed.")
        self._studio.screenshot(self._folder / "insole.png")

    def _export(self) -> None:
        for path in self._studio.export(self._folder / "insole.stl"):
            self._stl = path
        sheets = list(self._folder.glob("insole*.pdf"))
        self._require(bool(sheets), "No job sheet was written.")
        for sheet in sheets:
            is_paper = sheet.read_bytes().startswith(b"%PDF-")
            self._require(is_paper, "The job sheet is not a PDF file.")

    def _compare(self) -> None:
        assert self._stl is not None
        side = self._at_hand.side
        a = surface_of(self._case, Wanted("insole", side))
        b = surface_of(self._case, Wanted("file", path=self._stl))
        compared = compare_sources(a, b, "best", 1)
        write_comparison(compared, (a.name, self._stl.name), self._folder / "comparison.pdf")
        mean_mm = compared.difference.statistics["mean_abs"]
        self._require(
            mean_mm <= MOST_DIFFERENCE_MM,
            f"The exported file differs from the insole by {mean_mm:.2f} mm on average.",
        )

    def _save(self) -> None:
        path = self._folder / "case.insole"
        self._studio.save(path)
        self._raise_what_the_window_told()
        self._require(
            _correction_count(read_case(path)) == _correction_count(self._case),
            "The saved case is not the one that was open.",
        )

    def _keep(self) -> None:
        with self._open_record("record") as records:
            record = read_case(self._folder / "case.insole")
            add_case(records, replace(record, patient=Patient("Self-test")))

    def _restore(self) -> None:
        folder, restored = self._folder / "backup", self._folder / "restored"
        with self._open_record("record") as records:
            set_up_backups(records.context, BackupKey.with_passphrase(_PASSPHRASE))
            back_up(records.context, folder)
        restore(folder, _PASSPHRASE, RecordsPlace.local(restored), Author.of_user())
        with self._open_record("record") as before, self._open_record("restored") as after:
            self._require(
                _kept_feet(before) == _kept_feet(after) != [],
                "The restored record is not the one that was backed up.",
            )

    @contextmanager
    def _open_record(self, name: str) -> Iterator[Records]:
        records = open_records(RecordsPlace.local(self._folder / name), self._author)
        try:
            yield records
        finally:
            records.close()

    @cached_property
    def _author(self) -> Author:
        return Author.of_user()

    @property
    def _at_hand(self) -> FootRecord:
        foot = self._case.current
        assert foot is not None
        return foot

    def _require(self, holds: bool, sentence: str) -> None:
        if not holds:
            raise SelfTestError("{sentence}", sentence=sentence)


def _start(recorded: Session, folder: Path) -> Start:
    views = [(view.name, view.sensor.serial) for view in recorded.views]
    plan = make_plan(views, frames=FRAMES)
    manifest = Manifest(
        recorded.manifest.recorded_at,
        recorded.manifest.side,
        recorded.manifest.reference_system,
        (),
        volume_of_interest=recorded.manifest.volume_of_interest,
    )
    return Start(plan, folder, manifest, plan.views)


def _wait_for_end(service: CaptureService) -> CaptureStatus:
    """Wait until the capture has ended, of which the service tells also if it dies."""
    while True:
        for event in service.news():
            if isinstance(event, CaptureStatus) and event.phase.is_end:
                return event
            if isinstance(event, Sensors) and event.problem:
                raise SelfTestError("{sentence}", sentence=event.problem)
        time.sleep(_PAUSE_S)


def _correction_count(record: CaseRecord) -> int:
    return sum(len(foot.design.corrections) for foot in record.feet)


def _kept_feet(records: Records) -> list[tuple[str, int, int]]:
    """Return person, number of corrections and corners of the scans of each visit."""
    kept = []
    for person in records.persons.everybody():
        for visit in records.visits.of_person(person.id):
            record = records.visits.open_case(visit.id).record
            corners = sum(len(foot.foot.mesh.vertices) for foot in record.feet)
            kept.append((person.id, _correction_count(record), corners))
    return kept
