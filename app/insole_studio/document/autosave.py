"""An autosaved copy of the open case, and its recovery after a crash.

Every running window holds a lock file beside its copy. A copy whose lock is free was left by a
program that crashed: it is offered at the next start, by a window that holds its lock from then on.
"""

from __future__ import annotations

import json
import logging
import os
import threading
import uuid
from collections.abc import Iterable
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QLockFile, QObject, QTimer, Signal

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord
from insole_core.errors import InsoleError
from insole_core.export.atomic import make_private_folder, replacing_file, write_text
from insole_core.forgiving_json import Complain, rename_unreadable
from insole_core.json_object import JsonObject
from insole_core.messages import Message
from insole_core.progress import Cancelled, Progress
from insole_core.workflows.file_kind import CASE_SUFFIX
from insole_studio.document.case import Case
from insole_studio.document.unkept_visit import UnkeptVisit
from insole_studio.jobs import Jobs

log = logging.getLogger(__name__)

CHANNEL = "autosave"
DELAY_MS = 800


@dataclass(frozen=True, eq=False)
class Recovered:
    """A case left behind by a crashed program, which no other window is offered meanwhile.

    Parameters
    ----------
    path
        The file it was opened from; None for a case never saved.
    copies
        The files to remove once the case is safe.
    lock
        Keeps other windows from the copies until it is released.
    digest
        SHA-256 of that file when it was last read or written; empty where that is unknown.
    visit
        The visit of the clinic's record that it is; None for a case of a file.
    """

    record: CaseRecord
    path: Path | None
    copies: tuple[Path, ...]
    lock: QLockFile
    digest: str = ""
    visit: UnkeptVisit | None = None

    def discard(self) -> None:
        """Remove the copies."""
        _remove(self.copies)
        self.release()

    def release(self) -> None:
        """Leave the copies, if they are still there, to the next window that starts."""
        self.lock.unlock()


@dataclass(frozen=True)
class _Origin:
    """The file of the case, as kept beside the copy; empty for a case never saved."""

    path: str = ""
    digest: str = ""
    visit: UnkeptVisit | None = None

    def to_json(self) -> dict[str, object]:
        """Return it as values for `json.dumps`."""
        content: dict[str, object] = {"path": self.path, "digest": self.digest}
        if self.visit is not None:
            content["visit"] = self.visit.to_json()
        return content


@dataclass(frozen=True)
class _Snapshot:
    """What is written: the case of one moment. A later moment has a higher number."""

    number: int
    record: CaseRecord
    origin: _Origin


class _CopyOnDisk:
    """The copy of the case, written by the window and by jobs.

    A job that is cancelled while it writes goes on to its end. Its copy then takes the place of
    an older one only: never of a newer one, and never of one that was removed meanwhile.
    """

    def __init__(self, stem: Path) -> None:
        self._stem = stem
        self._latest = 0
        self._number_on_disk = 0
        self._places = threading.Lock()  # held only while files take their places

    def next_number(self) -> int:
        """Return the number of a snapshot taken now; called in the thread of the window."""
        self._latest += 1
        return self._latest

    def write(self, snapshot: _Snapshot) -> None:
        """Write a snapshot, from any thread.

        Raises
        ------
        OutputError
            When it cannot be written.
        Cancelled
            When a later one was written or removed meanwhile.
        """
        record_copy, origin_copy = _copies(self._stem)
        with ExitStack() as until_in_place, replacing_file(record_copy) as beside:
            write_case(snapshot.record, beside)
            until_in_place.enter_context(self._places)
            if snapshot.number < self._number_on_disk:
                raise Cancelled
            write_text(json.dumps(snapshot.origin.to_json()), origin_copy)
            self._number_on_disk = snapshot.number

    def remove(self) -> None:
        """Remove the copy, also one that is still being written."""
        with self._places:
            self._number_on_disk = self.next_number()
            _remove(_copies(self._stem))


class Autosave(QObject):
    """Writes the case to disk in the background, a moment after each change."""

    failed = Signal(object)

    def __init__(self, case: Case, jobs: Jobs, folder: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._case = case
        self._jobs = jobs
        self._folder = folder
        try:
            make_private_folder(folder)
        except OSError as error:  # told at the first attempt to write there
            log.warning("%s cannot be made: %s", folder, error)
        self._wanted = True
        self._has_failed = False
        stem = folder / uuid.uuid4().hex
        self._copy = _CopyOnDisk(stem)
        self._lock = _lock(stem)
        self._lock.tryLock(0)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(DELAY_MS)
        self._timer.timeout.connect(self._write_beside)
        case.changed.connect(self._timer.start)
        case.opened.connect(self._timer.start)
        case.saved_changed.connect(self._forget_if_saved)

    def write_now(self) -> None:
        """Write at once, in the calling thread.

        Raises
        ------
        OutputError
            When the copy cannot be written.
        """
        self._timer.stop()
        self._jobs.cancel(CHANNEL)
        if self._case.has_unsaved_changes:
            self._copy.write(self._snapshot())

    def set_aside(self) -> None:
        """Leave the case on the disk as it is, for this or another window to take up later.

        Raises
        ------
        OutputError
            When it cannot be written.
        """
        copy = _CopyOnDisk(self._folder / uuid.uuid4().hex)
        copy.write(_Snapshot(copy.next_number(), self._case.record, self._origin()))

    def keep_now(self) -> None:
        """Write at once what may be lost, because the program may be ended at any moment."""
        if not self._wanted:
            return
        try:
            self.write_now()
        except InsoleError as error:
            log.warning("unsaved work cannot be kept: %s", error)

    def forget(self) -> None:
        """Remove the copy permanently: the user has saved the case, or does not want it."""
        self._timer.stop()
        self._jobs.cancel(CHANNEL)
        self._wanted = False

    def close(self) -> None:
        """Stop, after the jobs have ended; unsaved work stays on the disk unless discarded."""
        # A field that loses focus while the window closes still changes the case.
        self._case.changed.disconnect(self._timer.start)
        self._case.opened.disconnect(self._timer.start)
        if self._wanted and self._case.has_unsaved_changes:
            self.keep_now()
        else:
            self._copy.remove()
        self._timer.stop()
        self._lock.unlock()

    def _write_beside(self) -> None:
        if not self._case.has_unsaved_changes:
            return
        snapshot = self._snapshot()

        def write(_progress: Progress) -> None:
            self._copy.write(snapshot)

        self._jobs.start(CHANNEL, write, self._note_success, self._note_failure)

    def _note_success(self, _nothing: None) -> None:
        self._has_failed = False

    def _note_failure(self, error: Exception) -> None:
        """Tell of the first of several failures in a row; every change tries again."""
        if not self._has_failed:
            self.failed.emit(str(error))
        self._has_failed = True

    def _snapshot(self) -> _Snapshot:
        return _Snapshot(self._copy.next_number(), self._case.record, self._origin())

    def _origin(self) -> _Origin:
        case = self._case
        if case.kept is not None:
            return _Origin(visit=UnkeptVisit.of(case.kept, case.saved_record, case.record))
        is_ours = case.path is not None and not case.is_read_only
        return _Origin(str(case.path), case.digest) if is_ours else _Origin()

    def _forget_if_saved(self) -> None:
        if not self._case.has_unsaved_changes:
            self._timer.stop()
            self._jobs.cancel(CHANNEL)
            self._copy.remove()


def find_recovered(folder: Path, complain: Complain = log.warning) -> list[Recovered]:
    """Return the cases left by programs that no longer run, newest first, each of them held.

    Parameters
    ----------
    complain
        Called with a sentence for the user on each copy that is damaged, and is kept aside.
    """
    found = []
    for copy in _copies_in(folder):
        stem = copy.with_suffix("")
        lock = _lock(stem)
        if _is_held_elsewhere(lock):
            continue
        try:
            found.append(_recover(stem, lock))
        except InsoleError as error:
            lock.unlock()
            log.warning("%s cannot be recovered: %s", copy, error)
            complain(
                Message(
                    "The copy {path} of unsaved work is damaged; it is kept as {kept}.",
                    path=copy,
                    kept=rename_unreadable(copy),
                )
            )
    return found


def _copies_in(folder: Path) -> list[Path]:
    """Return the copies in a folder, newest first; none where it cannot be looked into."""
    try:
        copies = [(copy.stat().st_mtime, copy) for copy in folder.glob("*.insole")]
    except OSError as error:
        log.warning("%s cannot be looked into: %s", folder, error)
        return []
    return [copy for _time, copy in sorted(copies, reverse=True)]


def _is_held_elsewhere(lock: QLockFile) -> bool:
    """Take a lock if it is free; return whether a running program has it.

    It does not count as held if the folder takes no lock at all.
    """
    return not lock.tryLock(0) and lock.error() is QLockFile.LockError.LockFailedError


def _recover(stem: Path, lock: QLockFile) -> Recovered:
    record_copy, origin_copy = _copies(stem)
    record = read_case(record_copy)
    origin = _read_origin(origin_copy)
    path = Path(origin.path) if origin.path else None
    copies = record_copy, origin_copy
    return Recovered(record, path, copies, lock, origin.digest, origin.visit)


def _read_origin(path: Path) -> _Origin:
    """Read where a copy comes from; the copy is intact, so a loss of this must not hide it."""
    try:
        stored = JsonObject.read(path)
        place, digest = (stored.text(key, empty=True) for key in ("path", "digest"))
        if stored.has("visit"):
            return _Origin(visit=UnkeptVisit.from_json(stored.object("visit")))
    except InsoleError as error:
        log.warning("the file of a recovered case is not known: %s", error)
        return _Origin()
    return _Origin(place, digest) if _is_case_file(place) else _Origin()


def _is_case_file(text: str) -> bool:
    """Return whether a text is the absolute path of a case file."""
    try:
        os.fsencode(text)
    except UnicodeEncodeError:
        return False
    path = Path(text)
    return path.is_absolute() and path.suffix.lower() == CASE_SUFFIX and "\0" not in text


def _copies(stem: Path) -> tuple[Path, Path]:
    return stem.with_suffix(".insole"), stem.with_suffix(".json")


def _remove(copies: Iterable[Path]) -> None:
    for copy in copies:
        try:
            copy.unlink(missing_ok=True)
        except OSError as error:
            log.warning("%s cannot be removed: %s", copy, error)


def _lock(stem: Path) -> QLockFile:
    lock = QLockFile(str(stem.with_suffix(".lock")))
    lock.setStaleLockTime(0)  # a lock is stale only if its process has ended
    return lock
