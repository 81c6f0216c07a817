"""Atomic output: write beside the destination, then rename."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from insole_core.errors import OutputError
from insole_core.messages import Message


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
        if path.is_dir():
            raise IsADirectoryError
        handle, name = tempfile.mkstemp(
            dir=path.parent, prefix=f".{path.name}.", suffix=path.suffix
        )
        os.close(handle)
        beside = Path(name)
        yield beside
        beside.chmod(0o666 & ~_umask())
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
            raise NotADirectoryError
        beside = Path(tempfile.mkdtemp(dir=path.parent, prefix=f".{path.name}."))
        yield beside
        beside.chmod(0o777 & ~_umask())
        _swap(beside, path)
    except OSError as error:
        raise OutputError(describe(path, error)) from error
    finally:
        if beside is not None and beside.exists():
            shutil.rmtree(beside)


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


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _not_allowed(path: Path) -> str:
    if path.is_file() and os.access(path.parent, os.W_OK):  # as on Windows while it is open
        return "another program has it open; close it there, or choose another name"
    return "you may not write there; choose another place or ask for permission"


def describe(path: Path, error: OSError) -> str:
    """Return one sentence on why a place cannot be written.

    Parameters
    ----------
    path
        Where the result was to be written.
    error
        Raised by the attempt.
    """
    reasons: list[tuple[type[OSError], str]] = [
        (FileNotFoundError, "its folder does not exist; create the folder or choose another place"),
        (PermissionError, _not_allowed(path)),
        (IsADirectoryError, "a folder of that name is there; choose another name"),
        (NotADirectoryError, "a file is there where a folder is needed; choose another name"),
    ]
    if isinstance(error, FileNotFoundError) and path.parent.is_dir():
        return Message(
            "{path} cannot be written: this place takes no files; choose another place.", path=path
        )
    for kind, reason in reasons:
        if isinstance(error, kind):
            return Message("{path} cannot be written: {reason}.", path=path, reason=reason)
    if error.errno in (28, 122):
        return Message(
            "{path} cannot be written: the disk is full; free some space and try again.", path=path
        )
    return Message(
        "{path} cannot be written: {reason}; choose another place.",
        path=path,
        reason=error.strerror or str(error),
    )
