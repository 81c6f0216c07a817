"""Files that nobody needs or that must go: what the window clears by itself, and of the erased."""

from __future__ import annotations

import json
import logging
import shutil
import uuid
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, QTimer, Signal

from insole_core.errors import InputError, InsoleError
from insole_core.files.atomic import make_output_folder, replacing_file
from insole_core.files.temporary import is_temporary
from insole_core.files.write_errors import output_errors
from insole_core.forgiving_json import rename_unreadable
from insole_core.json_object import JsonObject
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.document.journal import Recovered, find_recovered, remove_files
from insole_studio.document.waiting_work import forget_visits
from insole_studio.settings import Settings, folder_names, load_settings
from insole_studio.user_paths import UserPaths, is_older

if TYPE_CHECKING:
    from insole_core.records.content_store import SweptContents
    from insole_core.records.records import Records
    from insole_core.records.retention import Erasure, ErasureReason
    from insole_core.records.traces import Traces

log = logging.getLogger(__name__)
_UNUSED_S = 86_400.0
"""Age from which a note of somebody who is not erased is of an erasure that was refused."""
SWEEP, _FORGET = "record-sweep", "record-forget"
LOOK_MS = 5 * 60 * 1000


@dataclass(frozen=True)
class _Note:
    path: Path
    person_id: str
    traces: Traces


class ErasedLeftovers:
    """Erases persons, and removes what this computer holds of them, also after a crash.

    Parameters
    ----------
    settings
        Of the window; None for a command.
    forgotten
        Called when names of files were taken out of the settings.
    """

    def __init__(
        self,
        paths: UserPaths,
        settings: Settings | None = None,
        forgotten: Callable[[], object] = bool,
    ) -> None:
        self._paths = paths
        self._settings = settings
        self._forgotten = forgotten

    @property
    def are_noted(self) -> bool:
        """Whether there may be something to remove."""
        return next(self._paths.erasures_folder.glob("*.json"), None) is not None

    def erase(
        self, records: Records, person_id: str, reason: ErasureReason, today: date
    ) -> Erasure:
        """Erase a person from the record, as `erase_person`, with a note of what is to follow.

        Raises
        ------
        NotAllowed, RecordsError, OutputError
        """
        from insole_core.records.retention import erase_person

        def note(traces: Traces) -> None:
            folder = self._paths.erasures_folder
            make_output_folder(folder)
            noted = traces.with_files(self._scans_of(traces))
            with replacing_file(folder / f"{uuid.uuid4().hex}.json") as beside:
                content = {"person": person_id, **noted.to_json()}
                beside.write_text(json.dumps(content), encoding="utf-8", newline="\n")

        return erase_person(records.context, person_id, reason, today, note=note)

    def _scans_of(self, traces: Traces) -> list[str]:
        """Return those recent files that are scans of the person, by what they hold."""
        from insole_core.workflows.scanned_feet import digest_of_scan

        stored = self._settings or load_settings(self._paths.settings_file, leave=True)
        return [name for name in stored.recent if digest_of_scan(Path(name)) in traces.scans]

    def erased(self, records: Records) -> dict[str, bool]:
        """Return of those who are noted, and whom the record knows, whether they are erased.

        Raises
        ------
        RecordsError
        """
        from insole_core.records.retention import are_erased

        noted = [note.person_id for note in self._notes()]
        return are_erased(records.context, noted) if noted else {}

    def forget(self, erased: dict[str, bool]) -> None:
        """Remove what is left of them, and then the notes; those of other records stay.

        Raises
        ------
        OutputError
            When the settings cannot be written; the notes stay.
        """
        for note in self._notes():
            if erased.get(note.person_id):
                forget_leftovers(note.traces, self._paths, self._settings)
                remove_files(note.path)
                self._forgotten()
            elif note.person_id in erased and is_older(note.path, _UNUSED_S):
                remove_files(note.path)

    def _notes(self) -> Iterator[_Note]:
        for path in sorted(self._paths.erasures_folder.glob("*.json")):
            try:
                yield _read(path)
            except InputError as error:
                log.warning("a note of an erasure cannot be read: %s", error)
                rename_unreadable(path)


def forget_leftovers(traces: Traces, paths: UserPaths, settings: Settings | None = None) -> None:
    """Remove unsaved work, copies of captures and papers, and names of files and folders.

    What another window is writing is its own: it is dropped when that hands it over to the record.

    Parameters
    ----------
    settings
        Of this window, which writes them again; None for a command.

    Raises
    ------
    OutputError
        When the settings cannot be written.
    """
    for journal in find_recovered(paths.autosave_folder):
        if _is_about(journal, traces):
            journal.discard()
        else:
            journal.release()
    for waiting in (paths.waiting_photos_folder, paths.waiting_orders_folder):
        forget_visits(waiting, traces.visit_ids)
    for copy in paths.fetched_folder.glob("*-????????.*"):
        if any(capture.startswith(copy.stem[-8:]) for capture in traces.capture_ids):
            remove_files(copy)
    shutil.rmtree(paths.papers_folder, ignore_errors=True)  # whose they are is not known
    if settings is not None:
        for name, value in _nameless(vars(settings), traces).items():
            setattr(settings, name, value)
    stored = paths.settings_file
    for path in sorted(stored.parent.glob(f"{stored.name}*")):  # also what was set aside as damaged
        if path.is_file() and not is_temporary(path.name):
            _forget_in(path, traces)


def _forget_in(path: Path, traces: Traces) -> None:
    """Take the name out of a file of settings; all else in it stays, also what is wrong with it."""
    with output_errors(path):
        text = path.read_text("utf-8", "surrogateescape")
    try:
        stored = json.loads(text)
    except (ValueError, RecursionError):  # damaged: it may hold the name anywhere
        written = traces.without(text)
    else:
        values = stored if isinstance(stored, dict) else {}
        nameless = _nameless(values, traces)
        written = json.dumps({**values, **nameless}, indent=1) if nameless else text
    if written != text:
        with replacing_file(path.resolve()) as beside:
            beside.write_text(written, "utf-8", "surrogateescape", newline="\n")


def _nameless(settings: Mapping[str, Any], traces: Traces) -> dict[str, Any]:
    """Return those settings anew that lead to the person: recent files, and folders of dialogs."""
    nameless: dict[str, Any] = {
        name: ""
        for name in folder_names()
        if isinstance(settings.get(name), str) and traces.are_of_place(settings[name])
    }
    recent = settings.get("recent")
    if isinstance(recent, list):
        kept = [name for name in recent if not traces.are_of_place(str(name))]
        nameless |= {"recent": kept} if kept != recent else {}
    return nameless


def _read(path: Path) -> _Note:
    from insole_core.records.traces import Traces

    stored = JsonObject.read(path)
    return _Note(path, stored.text("person"), Traces.from_json(stored))


def _is_about(journal: Recovered, traces: Traces) -> bool:
    visit = journal.visit
    if visit is not None:
        return visit.visit_id in traces.visit_ids
    return traces.are_of(journal.record.patient)


class RecordMaintenance(QObject):
    """Lets unused files go once a day, and what is left of erased patients at once.

    Parameters
    ----------
    leftovers
        What earlier erasures have left on this computer.
    """

    swept = Signal()

    def __init__(
        self, clinic: ClinicRecord, leftovers: ErasedLeftovers, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._clinic = clinic
        self._leftovers = leftovers
        self._swept_on: date | None = None
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK_MS)
        self._timer.timeout.connect(self.look)
        self._timer.start()
        clinic.state_changed.connect(self._forget)
        clinic.changed.connect(self._forget)

    def look(self) -> None:
        """Sweep in the background, unless that was done today."""
        self._forget()
        today = date.today()
        if not self._clinic.is_writable or self._swept_on == today:
            return
        self._swept_on = today
        self._clinic.ask(SWEEP, _sweep, lambda _swept: self.swept.emit(), _note_failure)

    def _forget(self) -> None:
        """Remove what is left of whoever is erased by now, here or before a crash."""
        if self._clinic.is_open and self._leftovers.are_noted:
            self._clinic.ask(_FORGET, self._leftovers.erased, self._forget_erased, _note_failure)

    def _forget_erased(self, erased: dict[str, bool]) -> None:
        try:
            self._leftovers.forget(erased)
        except InsoleError as error:
            _note_failure(error)

    def close(self) -> None:
        """Look no more."""
        self._timer.stop()


def _sweep(records: Records) -> SweptContents:
    from insole_core.records.retention import sweep_contents

    return sweep_contents(records.context)


def _note_failure(error: Exception) -> None:
    log.warning("files that nobody needs are still there: %s", error)
