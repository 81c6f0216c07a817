"""Atomic output: write beside the destination, then rename.

What is written concerns a patient: only its owner may read it, from the first byte on. Whoever
shares a file or a folder with others sets its mode once; replacing it keeps the mode.
"""

from __future__ import annotations

import errno
import os
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from insole_core.errors import OutputError
from insole_core.messages import Message

PRIVATE_FILE, PRIVATE_FOLDER = 0o600, 0o700


@contextmanager
def replacing_file(path: Path) -> Iterator[Path]:
    """Yield a path beside `path` to write to; on success it replaces `path`.

    Raises
    ------
    OutputError
        When the place cannot be written (no such folder, no permission, no space). Whatever was
        there before is untouched, and no temporary file remains.
    """
    beside: Path | None = None
    try:
        _check_replaceable(path)
        handle, name = tempfile.mkstemp(
            dir=path.parent, prefix=f".{path.name}.", suffix=path.suffix
        )
        os.close(handle)
        beside = Path(name)
        yield beside
        _take_mode(beside, path, PRIVATE_FILE)
        beside.replace(path)
    except OSError as error:
        raise OutputError(describe(path, error)) from error
    finally:
        if beside is not None:
            beside.unlink(missing_ok=True)


@contextmanager
def replacing_folder(path: Path) -> Iterator[Path]:
    """Do the same as `replacing_file` for a folder with everything in it."""
    beside: Path | None = None
    try:
        if path.exists() and not path.is_dir():
            raise _os_error(errno.ENOTDIR)
        beside = Path(tempfile.mkdtemp(dir=path.parent, prefix=f".{path.name}."))
        yield beside
        mode = _take_mode(beside, path, PRIVATE_FOLDER)
        _open_content(beside, mode)
        _swap(beside, path)
    except OSError as error:
        raise OutputError(describe(path, error)) from error
    finally:
        if beside is not None and beside.exists():
            shutil.rmtree(beside)


def make_private_folder(path: Path) -> None:
    """Make a folder, and those above it that are missing, for its owner only.

    Raises
    ------
    OSError
        When it cannot be made. A folder that is there stays as it is.
    """
    if not path.is_dir():
        make_private_folder(path.parent)
        path.mkdir(mode=PRIVATE_FOLDER, exist_ok=True)


def write_private(path: Path, content: bytes) -> None:
    """Write a file into an unfinished folder, for its owner only.

    Raises
    ------
    OSError
        When it cannot be written.
    """
    with open(path, "wb", opener=_private) as file:
        file.write(content)


def _private(path: str, flags: int) -> int:
    return os.open(path, flags, PRIVATE_FILE)


def _swap(beside: Path, path: Path) -> None:
    """Put `beside` in the place of `path`; delete the old folder only afterwards."""
    if not path.exists():
        beside.rename(path)
        return
    old = Path(tempfile.mkdtemp(dir=path.parent, prefix=f".{path.name}."))
    path.rename(old / "old")
    try:
        beside.rename(path)
    except OSError:
        (old / "old").rename(path)
        raise
    finally:
        shutil.rmtree(old)


def _check_replaceable(path: Path) -> None:
    """Raise what writing to an existing file would raise, although renaming might succeed."""
    if path.is_dir():
        raise _os_error(errno.EISDIR)
    if path.is_file():
        os.close(os.open(path, os.O_WRONLY))
    elif path.exists():
        raise _os_error(errno.ENXIO)


def _os_error(number: int) -> OSError:
    return OSError(number, os.strerror(number))


def _take_mode(beside: Path, path: Path, private: int) -> int:
    """Give `beside` the group and the mode of what it replaces; return the mode."""
    mode = _kept_mode(beside, path, private)
    beside.chmod(mode)
    return mode


def _kept_mode(beside: Path, path: Path, private: int) -> int:
    try:
        old = path.stat()
    except FileNotFoundError:
        return private
    mode = stat.S_IMODE(old.st_mode) & 0o777
    if old.st_gid == beside.stat().st_gid:
        return mode
    try:
        os.chown(beside, -1, old.st_gid)
    except PermissionError:
        return mode & ~stat.S_IRWXG  # never open to a group that it was not open to
    return mode


def _open_content(folder: Path, mode: int) -> None:
    """Make all that a folder holds as accessible as the folder itself."""
    for place, folders, files in os.walk(folder):
        for name in folders:
            (Path(place) / name).chmod(mode)
        for name in files:
            (Path(place) / name).chmod(mode & 0o666)


_FULL = (errno.ENOSPC, errno.EDQUOT)
_REASONS = {
    errno.EACCES: "you may not write there; choose another place or ask for permission",
    errno.EPERM: "it or its folder is protected against changes; choose another name or place",
    errno.EROFS: "this disk can only be read; choose another place",
    errno.EBUSY: "another program has it open; close it there, or choose another name",
    errno.ETXTBSY: "another program has it open; close it there, or choose another name",
    errno.ENOENT: "its folder does not exist; create the folder or choose another place",
    errno.EISDIR: "a folder of that name is there; choose another name",
    errno.ENOTDIR: "a file is there where a folder is needed; choose another name",
    errno.ENXIO: "a device or a pipe of that name is there; choose another name",
    errno.ENAMETOOLONG: "the name is too long; choose a shorter one",
}
_OPEN_ON_WINDOWS = (5, 32, 33)
"""Codes of Windows for a file that another program has open."""


def describe(path: Path, error: OSError) -> str:
    """Return one sentence on why a place cannot be written.

    Parameters
    ----------
    path
        Where the result was to be written.
    error
        Raised by the attempt.
    """
    if error.errno in _FULL:
        return Message(
            "{path} cannot be written: the disk is full; free some space and try again.", path=path
        )
    if error.errno == errno.ENOENT and path.parent.is_dir():
        return Message(
            "{path} cannot be written: this place takes no files; choose another place.", path=path
        )
    cause = errno.EBUSY if _is_open_elsewhere(path, error) else error.errno
    if cause in _REASONS:
        reason = _REASONS[cause]
        return Message("{path} cannot be written: {reason}.", path=path, reason=reason)
    return Message(
        "{path} cannot be written: {reason}; choose another place.",
        path=path,
        reason=error.strerror or str(error),
    )


def _is_open_elsewhere(path: Path, error: OSError) -> bool:
    return getattr(error, "winerror", None) in _OPEN_ON_WINDOWS and path.is_file()
