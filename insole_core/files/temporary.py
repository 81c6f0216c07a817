"""Names of unfinished results beside their destination, and what ended programs left of them."""

from __future__ import annotations

import ctypes
import hashlib
import logging
import os
import platform
import re
import secrets
import shutil
import sys
import time
import uuid
from contextlib import suppress
from functools import cache
from pathlib import Path

import platformdirs

from insole_core.files.file_safety import PRIVATE_FILE, PRIVATE_FOLDER

_DRAWN = 1 << 40
"""Bit of a number that was drawn where no network card was found; each process draws another."""
_BOOT, _NUMBERS = Path("/proc/sys/kernel/random/boot_id"), "/proc/self/ns/pid"
log = logging.getLogger(__name__)
GRACE_S = 3600.0
"""Age from which left files are removed of which only another computer knows whether their process
still runs."""
NOTE_SUFFIX = ".place"
"""Of a note that says where something unfinished is."""
_STEM = ".insole-studio-"
_NAME = re.compile(
    rf"(?P<base>{re.escape(_STEM)}(?P<process>\d+)-"
    r"(?:(?P<computer>[0-9a-f]{8})-(?P<start>[0-9a-f]+)-)?[0-9a-f]{12})(?:\..*)?",
    re.DOTALL,
)
_IN_USE: dict[str, Path] = {}
"""What each temporary name of this process stands for. Another one of the same number ran before,
as in a container."""


@cache
def this_computer() -> str:
    """Return eight hexadecimal digits: of two processes that see each other's numbers, the same."""
    known = [platform.node()]
    card = uuid.getnode()
    if not card & _DRAWN:
        known.append(str(card))
    if sys.platform == "linux":
        with suppress(OSError):  # a container that shows nothing of its system
            known += [_BOOT.read_text("ascii"), os.readlink(_NUMBERS)]  # noqa: PTH115 - no path
    return hashlib.sha256("\n".join(known).encode()).hexdigest()[:8]


def started(process: int) -> str:
    """Return when a process of this computer was started, in hexadecimal digits; "0" if unknown."""
    try:
        stat = Path(f"/proc/{process}/stat").read_bytes()
    except OSError:  # none of that number runs, or this system tells it in another way
        return "0"
    return f"{int(stat.rpartition(b')')[2].split()[19]):x}"


def runs(process: int, start: str = "0") -> bool:
    """Return whether a process of this computer runs.

    Parameters
    ----------
    start
        As `started` told it; a later process of the same number is another one.
    """
    if not _has_process(process):
        return False
    return "0" in (start, now := started(process)) or now == start


def _has_process(process: int) -> bool:
    if sys.platform == "win32":
        return _has_process_on_windows(process)
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (PermissionError, OverflowError):
        return True
    return True


def _has_process_on_windows(process: int) -> bool:
    kernel = ctypes.windll.kernel32  # type: ignore[attr-defined, unused-ignore]
    handle = kernel.OpenProcess(0x1000, False, process)  # PROCESS_QUERY_LIMITED_INFORMATION
    if not handle:
        return bool(kernel.GetLastError() == 5)  # ERROR_ACCESS_DENIED: it is another user's
    code = ctypes.c_ulong()
    kernel.GetExitCodeProcess(handle, ctypes.byref(code))
    kernel.CloseHandle(handle)
    return code.value == 259  # STILL_ACTIVE


def temporary_name(named: Path, suffix: str = "") -> str:
    """Return a new hidden name that is known to be this process's.

    Parameters
    ----------
    named
        What the user calls it.
    """
    process = os.getpid()
    made_by = f"{process}-{this_computer()}-{started(process)}"
    name = f"{_STEM}{made_by}-{secrets.token_hex(6)}{suffix}"
    _IN_USE[name] = named
    return name


def release(path: Path) -> None:
    """Forget a name that is no longer in use."""
    _IN_USE.pop(path.name, None)
    if not os.path.lexists(path):
        _forget(path)


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
    _note(path)
    try:
        os.close(os.open(path, os.O_CREAT | os.O_EXCL | os.O_WRONLY, PRIVATE_FILE))
    except OSError:
        release(path)
        raise
    return path


def make_folder(folder: Path, named: Path) -> Path:
    """Make an empty folder with a temporary name, for its owner only."""
    path = folder / temporary_name(named)
    _note(path)
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
    """Return whether a name is that of a process of this product that no longer runs here."""
    match = _NAME.fullmatch(name)
    if match is None or any(used.startswith(match["base"]) for used in tuple(_IN_USE)):
        return False
    process = int(match["process"])
    if process == os.getpid():  # not in use: an earlier process had this number, or it was released
        return True
    return not runs(process, match["start"] if _is_of_this_computer(match) else "0")


def sweep(folder: Path, needed: frozenset[Path] = frozenset()) -> None:
    """Remove the unfinished results in a folder that killed programs left.

    Parameters
    ----------
    needed
        What a journal still moves.
    """
    with suppress(OSError):  # another user's, or another process sweeps as well
        for path in [path for path in folder.iterdir() if is_left(path.name)]:
            if path not in needed and _is_dead(path):
                remove(path)


def sweep_noted(note: Path, needed: frozenset[Path]) -> None:
    """Remove what a killed program noted as unfinished, and the note.

    Raises
    ------
    OSError
        When one of them cannot be removed: the next start tries again.
    """
    path = Path(os.fsdecode(note.read_bytes()))
    if _note_in(note.parent, path) != note:
        note.unlink()  # damaged: nothing that it names is touched
    elif path.parent.is_dir() and path not in needed and _is_dead(path):
        remove(path)
        note.unlink()


def state_folder_of_user() -> Path:
    """Return the folder of this user for what the next start must know."""
    return platformdirs.user_state_path("insole-studio", appauthor=False)


def _is_dead(path: Path) -> bool:
    """Return whether a left path is known to be of a dead process, or has not changed for long."""
    try:
        status = path.lstat()
    except FileNotFoundError:
        return True
    match = _NAME.fullmatch(path.name)
    is_ours = not hasattr(os, "getuid") or status.st_uid == os.getuid()
    if is_ours and match is not None and _is_of_this_computer(match):
        return True
    return time.time() - status.st_mtime > GRACE_S


def _is_of_this_computer(match: re.Match[str]) -> bool:
    return match["computer"] == this_computer()


def _note(path: Path) -> None:
    """Note where something unfinished will be; without a note it is swept where it lies."""
    note = _note_of(path)
    if note is None or note.parent == path.parent:
        return
    try:
        note.parent.mkdir(mode=PRIVATE_FOLDER, parents=True, exist_ok=True)
        note.write_bytes(os.fsencode(path.absolute()))
    except OSError as error:
        log.info("There is no note of %s: %s", path, error)


def _forget(path: Path) -> None:
    note = _note_of(path)
    if note is not None:
        with suppress(OSError):  # the next start removes a note of nothing
            note.unlink(missing_ok=True)


def _note_of(path: Path) -> Path | None:
    return _note_in(state_folder_of_user(), path)


def _note_in(folder: Path, path: Path) -> Path | None:
    match = _NAME.fullmatch(path.name)
    return None if match is None else folder / f"{match['base']}{NOTE_SUFFIX}"
