"""Why a place cannot be written, in one sentence."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from insole_core.errors import OutputError
from insole_core.files.temporary import named_path
from insole_core.messages import Message

FULL = (errno.ENOSPC, errno.EDQUOT)
"""What a full disk says."""
_REASONS = {
    errno.EACCES: "you may not write there; choose another place or ask for permission",
    errno.EPERM: "it or its folder is protected against changes; choose another name or place",
    errno.EROFS: "this disk can only be read; choose another place",
    errno.EBUSY: "another program has it open; close it there, or choose another name",
    errno.ETXTBSY: "another program has it open; close it there, or choose another name",
    errno.ENOENT: "its folder does not exist; create the folder or choose another place",
    errno.EISDIR: "a folder of that name is there; choose another name",
    errno.ENOTDIR: "a file is there where a folder is needed; choose another name",
    errno.EEXIST: "a file is there where a folder is needed; choose another name",
    errno.ENXIO: "a device or a pipe of that name is there; choose another name",
    errno.ENAMETOOLONG: "the name is too long; choose a shorter one",
}
_OPEN_ON_WINDOWS = (5, 32, 33)
"""Codes of Windows for a file that another program has open."""


@contextmanager
def output_errors(path: Path) -> Iterator[None]:
    """Turn errors of the system into one sentence about the place that was to be written.

    Raises
    ------
    OutputError
    """
    try:
        yield
    except OSError as error:
        raise OutputError(describe(path, error)) from error


def describe(path: Path, error: OSError) -> str:
    """Return one sentence on why a place cannot be written.

    Parameters
    ----------
    path
        Where the result was to be written; of a temporary file, the name that the user gave is
        said.
    error
        Raised by the attempt.
    """
    path = named_path(path)
    if error.errno in FULL:
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


def is_there(path: Path) -> bool:
    """Return whether something is there that would be replaced.

    Why a place cannot be looked at, as its name is too long, is told by writing to it.
    """
    return os.path.exists(path)  # noqa: PTH110 - the method raises what it cannot look at


def _is_open_elsewhere(path: Path, error: OSError) -> bool:
    return getattr(error, "winerror", None) in _OPEN_ON_WINDOWS and path.is_file()
