"""An advisory lock that ends with the process that holds it.

The operating system keeps the lock, so one that was left by a program that crashed or was killed is
free at once; nobody has to judge by age or process number whether it is stale.
"""

from __future__ import annotations

import errno
import logging
import os
import sys
from pathlib import Path
from types import TracebackType

from insole_core.files.write_errors import output_errors

try:
    import fcntl
except ImportError:  # on Windows
    import msvcrt

    def _try_lock(handle: int) -> None:
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined, unused-ignore]
else:

    def _try_lock(handle: int) -> None:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)


log = logging.getLogger(__name__)

_HELD_ELSEWHERE = (errno.EACCES, errno.EAGAIN, errno.EDEADLK)


class FileLock:
    """A lock on a file that exists only for it; it excludes other processes and other objects.

    Parameters
    ----------
    path
        The lock's own file, in a folder that exists. It is removed when the lock is released.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._handle: int | None = None

    @property
    def held(self) -> bool:
        """Whether this object holds the lock."""
        return self._handle is not None

    def acquire(self) -> bool:
        """Take the lock if it is free, without waiting; return whether it is held.

        Raises
        ------
        OutputError
            When the lock's file cannot be written.
        """
        while self._handle is None:
            with output_errors(self._path):
                handle = os.open(self._path, os.O_RDWR | os.O_CREAT, 0o600)
            try:
                _try_lock(handle)
            except OSError as error:
                if error.errno in _HELD_ELSEWHERE:
                    os.close(handle)
                    return False
                # Some network folders know no locks; work goes on there without one.
            if _is_at(self._path, handle):
                self._handle = handle
            else:  # its last holder has removed the file meanwhile
                os.close(handle)
        return True

    def release(self) -> None:
        """Free the lock and remove its file; does nothing if it is not held."""
        if self._handle is None:
            return
        handle, self._handle = self._handle, None
        if sys.platform == "win32":  # which removes no file that is open
            os.close(handle)
            return
        try:
            self._path.unlink(missing_ok=True)  # before others can take it
        except OSError as error:  # a file that stays keeps nobody off
            log.warning("the lock %s cannot be removed: %s", self._path, error)
        os.close(handle)

    def __enter__(self) -> FileLock:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.release()


def _is_at(path: Path, handle: int) -> bool:
    try:
        return os.path.samestat(path.stat(), os.fstat(handle))
    except FileNotFoundError:
        return False
