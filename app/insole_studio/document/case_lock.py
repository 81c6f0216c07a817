"""The lock of a case file while a window has it open (decision 0032)."""

from __future__ import annotations

import hashlib
import logging
import os
from pathlib import Path

from PySide6.QtCore import QLockFile, QSysInfo

from insole_core.errors import InsoleError
from insole_core.files.atomic import make_private_folder

log = logging.getLogger(__name__)

STALE_MS = 600_000
"""Age of a lock of another computer from which on it counts as left behind."""
REFRESH_MS = 60_000
"""How often an open case shows that it still is."""


class CaseInUseError(InsoleError):
    """Another window has the case open."""


class CaseLock:
    """Lock of one case file, until it is released or dropped.

    Parameters
    ----------
    path
        The case file, resolved.
    lock
        None where no place takes a lock; a change on the disk is noticed all the same.
    """

    def __init__(self, path: Path, lock: QLockFile | None) -> None:
        self._path = path
        self._lock = lock

    def is_of(self, path: Path) -> bool:
        """Return whether this is the lock of a file, under whatever name."""
        return self._path == path.resolve()

    def refresh(self) -> None:
        """Show other computers that the case is still open."""
        if self._lock is not None:
            try:
                os.utime(self._lock.fileName())
            except OSError as error:
                log.warning("the lock of %s cannot be refreshed: %s", self._path, error)

    def release(self) -> None:
        """Remove the lock."""
        if self._lock is not None:
            self._lock.unlock()


def take_lock(path: Path, spare_folder: Path) -> CaseLock:
    """Lock a case file.

    Parameters
    ----------
    spare_folder
        Takes the lock where the folder of the case takes none, as one that can only be read.

    Raises
    ------
    CaseInUseError
        When another window has the case open. A lock whose program has ended, or whose computer
        was started anew, does not count; nor one of another computer that is no longer refreshed.
    """
    resolved = path.resolve()
    for place in (_beside(resolved), _spare(resolved, spare_folder)):
        lock = QLockFile(str(place))
        lock.setStaleLockTime(STALE_MS)
        if lock.tryLock(0):
            return CaseLock(resolved, lock)
        if lock.error() is QLockFile.LockError.LockFailedError:
            raise _in_use(path, lock)
    log.warning("%s is not locked: neither its folder nor %s takes a file", path, spare_folder)
    return CaseLock(resolved, None)


def _beside(path: Path) -> Path:
    return path.with_name(f".~lock.{path.name}#")


def _spare(path: Path, folder: Path) -> Path:
    try:
        make_private_folder(folder)
    except OSError as error:
        log.warning("%s cannot be made: %s", folder, error)
    name = hashlib.sha256(os.fsencode(path)).hexdigest()
    return folder / f"{name}.lock"


def _in_use(path: Path, lock: QLockFile) -> CaseInUseError:
    _process, host, _program = lock.getLockInfo()[-3:]
    if not host or host == QSysInfo.machineHostName():
        return CaseInUseError("{path} is open in another window.", path=path)
    return CaseInUseError("{path} is open on another computer, {host}.", path=path, host=host)
