"""An autosaved copy of the open case: the journal of what is saved nowhere else yet.

Every running window holds the lock of its journal. One whose lock is free was left by a program
that ended unasked: it is taken up at the next start, by a window that holds its lock from then on.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Mapping
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from pathlib import Path
from weakref import WeakKeyDictionary

from PySide6.QtCore import QObject, QTimer, Signal

from insole_core.cases.case_record import CaseRecord
from insole_core.cases.stored_mesh import pack_mesh
from insole_core.errors import InsoleError, OutputError
from insole_core.files.atomic import make_private_folder, replacing_file
from insole_core.files.file_lock import FileLock
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.progress import Cancelled, Progress
from insole_studio.document.case import Case
from insole_studio.document.journal import (
    Origin,
    journal_lock,
    new_journal,
    remove_files,
    write_journal,
)
from insole_studio.document.kept_visit import UnkeptVisit
from insole_studio.jobs import Jobs

log = logging.getLogger(__name__)

CHANNEL = "autosave"
DELAY_MS, RETRY_MS = 800, 3000


@dataclass(frozen=True)
class _Snapshot:
    """What is written: the case of one moment. A later moment has a higher number."""

    number: int
    record: CaseRecord
    origin: Origin


class _PackedSurfaces:
    """Surfaces as they are stored: packing one takes most of the time that a journal takes."""

    def __init__(self) -> None:
        self._known: WeakKeyDictionary[TriangleMesh, bytes] = WeakKeyDictionary()
        self._lock = threading.Lock()

    def of(self, record: CaseRecord) -> Mapping[Side, bytes]:
        """Return the surfaces of a case, each of them packed once; from any thread."""
        return {foot.side: self._packed(foot.foot.mesh) for foot in record.feet}

    def _packed(self, mesh: TriangleMesh) -> bytes:
        with self._lock:
            known = self._known.get(mesh)
        if known is not None:
            return known
        packed = pack_mesh(mesh)
        with self._lock:
            self._known[mesh] = packed
        return packed


class _CopyOnDisk:
    """The journal of one window, written by the window and by jobs.

    A job that is cancelled while it writes goes on to its end. Its copy then takes the place of
    an older one only: never of a newer one, and never of one that was removed meanwhile.
    """

    def __init__(self, path: Path, surfaces: _PackedSurfaces) -> None:
        self._path = path
        self._surfaces = surfaces
        self._latest = 0
        self._number_on_disk = 0
        self._on_disk: CaseRecord | None = None
        self._places = threading.Lock()  # held only while files take their places

    def next_number(self) -> int:
        """Return the number of a snapshot taken now; called in the thread of the window."""
        self._latest += 1
        return self._latest

    def holds(self, record: CaseRecord) -> bool:
        """Return whether a case is on the disk as it is."""
        on_disk = self._on_disk
        return on_disk is not None and on_disk.holds_the_same(record)

    def write(self, snapshot: _Snapshot) -> None:
        """Write a snapshot, from any thread.

        Raises
        ------
        OutputError
            When it cannot be written.
        Cancelled
            When a later one was written or removed meanwhile.
        """
        packed = self._surfaces.of(snapshot.record)
        with ExitStack() as until_in_place:
            with replacing_file(self._path) as beside:
                write_journal(snapshot.record, snapshot.origin, beside, packed)
                until_in_place.enter_context(self._places)
                if snapshot.number < self._number_on_disk:
                    raise Cancelled
            self._number_on_disk, self._on_disk = snapshot.number, snapshot.record

    def let_go(self) -> None:
        """Hold the case no longer that was written last; the file stays."""
        self._on_disk = None

    def remove(self) -> None:
        """Remove the journal, also one that is still being written."""
        with self._places:
            self._number_on_disk, self._on_disk = self.next_number(), None
            remove_files(self._path)


class Autosave(QObject):
    """Writes the case to disk in the background, a moment after each change.

    Parameters
    ----------
    jobs
        Of the autosave alone, so that no long computation keeps it waiting; `close` ends them.
    """

    failed = Signal(object)
    kept_changed = Signal()
    """Emitted when `is_kept` may have changed."""

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
        self.trouble = ""
        """Why the case cannot be written; empty while it can."""
        self._surfaces = _PackedSurfaces()
        path, self._lock = _locked_journal(folder)
        self._copy = _CopyOnDisk(path, self._surfaces)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._write_beside)
        case.changed.connect(self._write_soon)
        case.opened.connect(self._note_opened)
        case.saved_changed.connect(self._note_saved)

    @property
    def is_kept(self) -> bool:
        """Whether the disk holds the case as it is now."""
        return self._copy.holds(self._case.record)

    @property
    def is_writing(self) -> bool:
        """Whether a job writes the case."""
        return self._jobs.is_running(CHANNEL)

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
            self._note_success(None)

    def ahead(self) -> Callable[[], None]:
        """Return a function, for another thread, that writes the case as it is now.

        Whoever stores the case elsewhere calls it before, so that a journal that was left is never
        older than what was stored. It does nothing if the disk holds the case already. A disk that
        takes nothing is told as always; it must not keep the case from being stored.
        """
        is_unsaved = self._case.has_unsaved_changes
        snapshot = self._snapshot()

        def write() -> None:
            if not is_unsaved or self._copy.holds(snapshot.record):
                return
            try:
                self._copy.write(snapshot)
            except Cancelled:  # a later one is there
                return
            except OutputError as error:
                log.warning("the journal cannot be written: %s", error)

        return write

    def set_aside(self) -> None:
        """Leave the case on the disk as it is, for this or another window to take up later.

        Raises
        ------
        OutputError
            When it cannot be written.
        """
        copy = _CopyOnDisk(new_journal(self._folder), self._surfaces)
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
        """Stop; unsaved work stays on the disk unless discarded."""
        # A field that loses focus while the window closes still changes the case.
        self._case.changed.disconnect(self._write_soon)
        self._case.opened.disconnect(self._note_opened)
        self._case.saved_changed.disconnect(self._note_saved)
        self._jobs.close()
        if self._wanted and self._case.has_unsaved_changes:
            self.keep_now()
        else:
            self._copy.remove()
        self._timer.stop()
        self._lock.release()

    def _note_opened(self) -> None:
        self._copy.let_go()
        self._write_soon()

    def _write_soon(self) -> None:
        """Write in a moment, however many changes follow one another."""
        if not self._timer.isActive():
            self._timer.start(DELAY_MS)
        self.kept_changed.emit()

    def _write_beside(self) -> None:
        """Write in a job; one that is under way looks at its end whether it has to go on."""
        if not self._case.has_unsaved_changes or self.is_writing:
            return
        snapshot = self._snapshot()

        def write(_progress: Progress) -> None:
            with suppress(Cancelled):  # the answer sees whether a later one is on the disk
                self._copy.write(snapshot)

        self._jobs.start(CHANNEL, write, self._note_success, self._note_failure)

    def _note_success(self, _nothing: None) -> None:
        self.trouble = ""
        if not self.is_kept:
            self._write_soon()
        self.kept_changed.emit()

    def _note_failure(self, error: Exception) -> None:
        """Tell of the first of several failures in a row, and try again."""
        has_failed, self.trouble = bool(self.trouble), str(error)
        self._timer.start(RETRY_MS)
        if not has_failed:
            self.failed.emit(str(error))
        self.kept_changed.emit()

    def _snapshot(self) -> _Snapshot:
        return _Snapshot(self._copy.next_number(), self._case.record, self._origin())

    def _origin(self) -> Origin:
        case = self._case
        if case.kept is not None:
            return Origin(visit=UnkeptVisit.of(case.kept, case.saved_record, case.record))
        is_ours = case.path is not None and not case.is_read_only
        return Origin(str(case.path), case.digest) if is_ours else Origin()

    def _note_saved(self) -> None:
        """Remove the journal of a case that is saved; otherwise write what it is based on now."""
        if self._case.has_unsaved_changes:
            self._write_soon()
            return
        self._timer.stop()
        self._jobs.cancel(CHANNEL)
        self._copy.remove()


def _locked_journal(folder: Path) -> tuple[Path, FileLock]:
    """Return the path of a new journal, with its lock taken where the folder takes any."""
    while True:
        path = new_journal(folder)
        lock = journal_lock(path)
        try:
            if lock.acquire():  # unless another window sweeps it at this moment
                return path, lock
        except OutputError as error:
            log.warning("the journal is not locked: %s", error)
            return path, lock
