"""An autosaved copy of the open case, and its recovery after a crash.

Every running window holds a lock file beside its copy. A copy whose lock is free was left by a
program that crashed: it is offered at the next start.
"""

from __future__ import annotations

import json
import logging
import uuid
from dataclasses import asdict, dataclass
from pathlib import Path

from PySide6.QtCore import QLockFile, QObject, QTimer, Signal

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord
from insole_core.errors import InsoleError
from insole_core.export.atomic import make_private_folder, replacing_file
from insole_core.forgiving_json import read_remembered, understood
from insole_core.progress import Progress
from insole_studio.document.case import Case
from insole_studio.jobs import Jobs

log = logging.getLogger(__name__)

CHANNEL = "autosave"
DELAY_MS = 800


@dataclass(frozen=True, eq=False)
class Recovered:
    """A case left behind by a crashed program.

    Parameters
    ----------
    path
        The file it was opened from; None for a case never saved.
    digest
        SHA-256 of that file when it was last read or written; empty where that is unknown.
    copies
        The files to remove once the case is safe.
    """

    record: CaseRecord
    path: Path | None
    digest: str
    copies: tuple[Path, ...]

    def discard(self) -> None:
        """Remove the copies."""
        for copy in self.copies:
            copy.unlink(missing_ok=True)


@dataclass(frozen=True)
class _Origin:
    """The file of the case, as kept beside the copy; empty for a case never saved."""

    path: str = ""
    digest: str = ""


class Autosave(QObject):
    """Writes the case to disk in the background, a moment after each change."""

    failed = Signal(object)

    def __init__(self, case: Case, jobs: Jobs, folder: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._case = case
        self._jobs = jobs
        make_private_folder(folder)
        self._wanted = True
        self._stem = folder / uuid.uuid4().hex
        self._lock = _lock(self._stem)
        self._lock.tryLock(0)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(DELAY_MS)
        self._timer.timeout.connect(self._write_beside)
        case.changed.connect(self._timer.start)
        case.opened.connect(self._timer.start)
        case.saved_changed.connect(self._forget_if_saved)

    def write_now(self) -> None:
        """Write at once, in the calling thread."""
        self._timer.stop()
        self._jobs.cancel(CHANNEL)
        if self._case.has_unsaved_changes:
            _write_copy(self._stem, self._case.record, self._origin())

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
            self.write_now()
        else:
            self._remove_copies()
        self._timer.stop()
        self._lock.unlock()

    def _write_beside(self) -> None:
        if not self._case.has_unsaved_changes:
            return
        record, origin = self._case.record, self._origin()

        def write(_progress: Progress) -> None:
            _write_copy(self._stem, record, origin)

        def fail(error: Exception) -> None:
            self.failed.emit(str(error))

        self._jobs.start(CHANNEL, write, lambda _nothing: None, fail)

    def _origin(self) -> _Origin:
        case = self._case
        is_ours = case.path is not None and not case.is_read_only
        return _Origin(str(case.path), case.digest) if is_ours else _Origin()

    def _forget_if_saved(self) -> None:
        if not self._case.has_unsaved_changes:
            self._timer.stop()
            self._jobs.cancel(CHANNEL)
            self._remove_copies()

    def _remove_copies(self) -> None:
        for copy in _copies(self._stem):
            copy.unlink(missing_ok=True)


def find_recovered(folder: Path) -> list[Recovered]:
    """Return the cases left by programs that no longer run, newest first."""
    if not folder.is_dir():
        return []
    found = []
    copies = sorted(folder.glob("*.insole"), key=lambda p: p.stat().st_mtime, reverse=True)
    for copy in copies:
        stem = copy.with_suffix("")
        lock = _lock(stem)
        if not lock.tryLock(0):
            continue
        lock.unlock()
        recovered = _recover(stem)
        if recovered is not None:
            found.append(recovered)
    return found


def _recover(stem: Path) -> Recovered | None:
    record_copy, origin_copy = _copies(stem)
    try:
        record = read_case(record_copy)
    except InsoleError as error:
        log.warning("%s cannot be recovered: %s", record_copy, error)
        return None
    # The case itself is intact: what is remembered of its file must not hide it.
    origin = _Origin(**understood(read_remembered(origin_copy), _Origin, origin_copy))
    path = Path(origin.path) if origin.path else None
    return Recovered(record, path, origin.digest, (record_copy, origin_copy))


def _write_copy(stem: Path, record: CaseRecord, origin: _Origin) -> None:
    record_copy, origin_copy = _copies(stem)
    with replacing_file(origin_copy) as beside:
        beside.write_text(json.dumps(asdict(origin)), encoding="utf-8")
    write_case(record, record_copy)


def _copies(stem: Path) -> tuple[Path, Path]:
    return stem.with_suffix(".insole"), stem.with_suffix(".json")


def _lock(stem: Path) -> QLockFile:
    lock = QLockFile(str(stem.with_suffix(".lock")))
    lock.setStaleLockTime(0)  # a lock is stale only if its process has ended
    return lock
