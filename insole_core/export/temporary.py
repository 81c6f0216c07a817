"""Names of unfinished results beside their destination, and what ended programs left of them.

A name holds the number of the process that writes, so that another one recognises what was left by
a process that was killed.
"""

from __future__ import annotations

import ctypes
import os
import re
import secrets
import shutil
import sys
import time
from contextlib import suppress
from pathlib import Path

from insole_core.export.file_mode import PRIVATE_FILE, PRIVATE_FOLDER

GRACE_S = 3600.0
"""Age from which left files are removed: on a shared disk, a process of another computer may still
write, whose number means nothing here."""
_STEM = ".insole-studio-"
_NAME = re.compile(re.escape(_STEM) + r"(\d+)-[0-9a-f]{12}(?:\..*)?", re.DOTALL)
_IN_USE: dict[str, Path] = {}
"""What each temporary name of this process stands for. Another one of the same number ran before,
as in a container."""


def temporary_name(named: Path, suffix: str = "") -> str:
    """Return a new hidden name that is known to be this process's.

    Parameters
    ----------
    named
        What the user calls it.
    """
    name = f"{_STEM}{os.getpid()}-{secrets.token_hex(6)}{suffix}"
    _IN_USE[name] = named
    return name


def release(path: Path) -> None:
    """Forget a name that is no longer in use."""
    _IN_USE.pop(path.name, None)


def is_unfinished(path: Path) -> bool:
    """Return whether this process has made a path, or a folder that holds it, to write to."""
    return not _IN_USE.keys().isdisjoint(path.parts)


def named_path(path: Path) -> Path:
    """Return what the user calls a temporary path, or what lies in one; any other stays."""
    return next((_IN_USE[part] for part in path.parts if part in _IN_USE), path)


def replaced_name() -> str:
    """Return a new hidden name for what is replaced; only a journal says when it is removed."""
    return f"{_STEM}old-{secrets.token_hex(6)}"


def make_file(folder: Path, named: Path) -> Path:
    """Make an empty file with a temporary name and the suffix of `named`, for its owner only."""
    path = folder / temporary_name(named, named.suffix)
    try:
        os.close(os.open(path, os.O_CREAT | os.O_EXCL | os.O_WRONLY, PRIVATE_FILE))
    except OSError:
        release(path)
        raise
    return path


def make_folder(folder: Path, named: Path) -> Path:
    """Make an empty folder with a temporary name, for its owner only."""
    path = folder / temporary_name(named)
    try:
        path.mkdir(mode=PRIVATE_FOLDER)
    except OSError:
        release(path)
        raise
    return path


def remove(path: Path) -> None:
    """Remove a file, or a folder with everything in it, if it is there."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


def is_temporary(name: str) -> bool:
    """Return whether a name is one that this product gives to what it has not finished."""
    return _NAME.fullmatch(name) is not None


def is_left(name: str) -> bool:
    """Return whether a name is that of a process of this product that no longer runs."""
    match = _NAME.fullmatch(name)
    if match is None or name in _IN_USE:
        return False
    process = int(match[1])
    return process == os.getpid() or not _runs(process)


def sweep(folder: Path) -> None:
    """Remove the unfinished results in a folder that killed programs left some time ago."""
    with suppress(OSError):  # another user's, or another process sweeps as well
        for path in [path for path in folder.iterdir() if is_left(path.name)]:
            if time.time() - path.lstat().st_mtime > GRACE_S:
                remove(path)


def _runs(process: int) -> bool:
    if sys.platform == "win32":
        return _runs_on_windows(process)
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (PermissionError, OverflowError):
        return True
    return True


def _runs_on_windows(process: int) -> bool:
    kernel = ctypes.windll.kernel32  # type: ignore[attr-defined, unused-ignore]
    handle = kernel.OpenProcess(0x1000, False, process)  # PROCESS_QUERY_LIMITED_INFORMATION
    if not handle:
        return bool(kernel.GetLastError() == 5)  # ERROR_ACCESS_DENIED: it is another user's
    code = ctypes.c_ulong()
    kernel.GetExitCodeProcess(handle, ctypes.byref(code))
    kernel.CloseHandle(handle)
    return code.value == 259  # STILL_ACTIVE
