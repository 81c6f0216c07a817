"""Who may read what is written: its owner only, or whoever could read what it replaces."""

from __future__ import annotations

import os
import stat
from pathlib import Path

PRIVATE_FILE, PRIVATE_FOLDER = 0o600, 0o700


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
