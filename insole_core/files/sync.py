"""Hand what was written to the disk, so that it survives a power failure."""

from __future__ import annotations

import errno
import os
from pathlib import Path

_IS_WINDOWS = os.name == "nt"
_NOT_SYNCED = (errno.EINVAL, errno.ENOTSUP)
"""Answers of file systems, mostly of networks, that sync by themselves."""


def sync(path: Path) -> None:
    """Wait until the content of a file, or the names in a folder, are on the disk.

    Folders that may not be read cannot be synced, nor those of some networks.

    Raises
    ------
    OSError
        When the disk cannot take them.
    """
    if _IS_WINDOWS and path.is_dir():  # its names are written with the files
        return
    try:
        handle = os.open(path, os.O_RDWR if _IS_WINDOWS else os.O_RDONLY)
    except PermissionError:
        if path.is_dir():  # its names may be written, but not read: the disk writes them in time
            return
        handle = os.open(path, os.O_WRONLY)
    try:
        os.fsync(handle)
    except OSError as error:
        if error.errno not in _NOT_SYNCED:
            raise
    finally:
        os.close(handle)


def sync_tree(path: Path) -> None:
    """Do the same as `sync` for a file, or for a folder with everything in it."""
    for folder, _, files in os.walk(path):
        for name in files:
            sync(Path(folder, name))
        sync(Path(folder))
    if not path.is_dir():
        sync(path)
