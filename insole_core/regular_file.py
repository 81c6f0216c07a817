"""Reading of regular files only, up to a limit.

A path may come from elsewhere: a case names its scan, a session its files, the settings the recent
cases. What lies there may be a pipe or a device, which never ends.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

_BLOCK_BYTES = 2**20
_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)


def open_regular(path: Path) -> BinaryIO:
    """Open a regular file for reading; never wait for a pipe or a device.

    Raises
    ------
    OSError
        When there is none, or it cannot be opened.
    """
    _check_regular(path.stat().st_mode)  # opening a device may already do something
    file = os.fdopen(os.open(path, _FLAGS), "rb")
    try:
        _check_regular(os.fstat(file.fileno()).st_mode)
    except OSError:
        file.close()
        raise
    return file


def read_regular(path: Path, limit: int) -> bytes:
    """Read a regular file.

    Parameters
    ----------
    limit
        Most bytes that are read.

    Raises
    ------
    OSError
        When there is none, it cannot be read, or is larger.
    """
    with open_regular(path) as file:
        return b"".join(blocks_of(file, limit))


def blocks_of(file: BinaryIO, limit: int) -> Iterator[bytes]:
    """Yield the content of a file in blocks.

    Raises
    ------
    OSError
        When it cannot be read, or has more than `limit` bytes.
    """
    rest = limit
    if os.fstat(file.fileno()).st_size > limit:
        raise _too_large()
    while block := file.read(_BLOCK_BYTES):
        rest -= len(block)
        if rest < 0:  # it grows, or its size is not what the system says
            raise _too_large()
        yield block


def _check_regular(mode: int) -> None:
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(mode):
        raise OSError(errno.EINVAL, "it is a pipe or a device, no file")


def _too_large() -> OSError:
    return OSError(errno.EFBIG, "it is far larger than such a file is")


def is_folder(path: Path) -> bool:
    """Return whether a path is that of a folder; False for what can be no path: too long, say."""
    try:
        return path.is_dir()
    except OSError:
        return False
