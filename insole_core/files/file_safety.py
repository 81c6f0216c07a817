"""How a file is written: who may read it, and that it survives a power failure."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

_IS_WINDOWS = os.name == "nt"
_NOT_SYNCED = (errno.EINVAL, errno.ENOTSUP)
"""Answers of file systems, mostly of networks, that sync by themselves."""
PRIVATE_FILE, PRIVATE_FOLDER = 0o600, 0o700


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


def take_mode(beside: Path, path: Path) -> None:
    """Give `beside`, and what a folder holds, the group and the mode of what it replaces."""
    mode = _kept_mode(beside, path)
    beside.chmod(mode)
    if beside.is_dir():
        _open_content(beside, mode)


def _kept_mode(beside: Path, path: Path) -> int:
    try:
        old = path.stat()
    except FileNotFoundError:
        return PRIVATE_FOLDER if beside.is_dir() else PRIVATE_FILE
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
