"""Keeps the file of the open case locked, and writes it only if nobody else has changed it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QObject, QTimer

from insole_core.cases.case_file import digest_of_case, read_case_and_digest, write_case
from insole_core.cases.case_record import CaseRecord
from insole_core.errors import OutputError
from insole_core.workflows.foot_landmarks import with_landmarks
from insole_studio.document.case import Case
from insole_studio.document.case_lock import REFRESH_MS, CaseLock, take_lock


class ChangedOnDiskError(OutputError):
    """Another program has written the file since it was read."""


@dataclass(frozen=True, eq=False)
class FileState:
    """A case file as it was read or written, and its lock."""

    record: CaseRecord
    digest: str
    lock: CaseLock


class CaseGuard(QObject):
    """Holds the lock of the open case, and releases it with the case.

    Parameters
    ----------
    spare_folder
        Takes locks where the folder of a case takes none.
    """

    def __init__(self, case: Case, spare_folder: Path, parent: QObject) -> None:
        super().__init__(parent)
        self._case = case
        self._spare_folder = spare_folder
        self._lock: CaseLock | None = None
        self._timer = QTimer(self)
        self._timer.setInterval(REFRESH_MS)
        self._timer.timeout.connect(self._refresh)
        self._timer.start()
        case.opened.connect(self._release_if_left)

    def lock_of(self, path: Path) -> CaseLock | None:
        """Return the lock of a file if this window holds it."""
        return self._lock if self._lock is not None and self._lock.is_of(path) else None

    def take(self, path: Path) -> CaseLock:
        """Lock a file, unless this window has it locked already.

        Raises
        ------
        CaseInUseError
            When another window has it open.
        """
        return self.lock_of(path) or take_lock(path, self._spare_folder)

    def read(self, path: Path) -> FileState:
        """Lock a case and read it; may run in another thread.

        Raises
        ------
        CaseInUseError
            When another window has it open.
        InputError
            When it cannot be read.
        """
        with self._taken(path) as lock:
            record, digest = read_case_and_digest(path)
            return FileState(with_landmarks(record), digest, lock)

    def write(self, record: CaseRecord, path: Path, known_digest: str) -> FileState:
        """Lock a case and write it; may run in another thread.

        Parameters
        ----------
        known_digest
            SHA-256 of the file that may be replaced; empty for whatever is there.

        Raises
        ------
        CaseInUseError
            When another window has it open.
        ChangedOnDiskError
            When another program has written it.
        OutputError
            When it cannot be written.
        """
        with self._taken(path) as lock:
            if known_digest and digest_of_case(path) not in (known_digest, ""):
                raise ChangedOnDiskError(
                    "{path} was changed by another program since it was opened here.", path=path
                )
            return FileState(record, write_case(record, path), lock)

    def hold(self, lock: CaseLock) -> None:
        """Keep a lock for the case that is now open, in place of the one before."""
        if lock is not self._lock:
            self.release()
            self._lock = lock

    def release(self) -> None:
        """Release the lock."""
        if self._lock is not None:
            self._lock.release()
            self._lock = None

    @contextmanager
    def _taken(self, path: Path) -> Iterator[CaseLock]:
        """Lock a file; a new lock is released again if what follows fails."""
        lock = self.take(path)
        try:
            yield lock
        except BaseException:
            if lock is not self._lock:
                lock.release()
            raise

    def _release_if_left(self) -> None:
        path = self._case.path
        if path is None or self._case.is_read_only or self.lock_of(path) is None:
            self.release()

    def _refresh(self) -> None:
        if self._lock is not None:
            self._lock.refresh()
