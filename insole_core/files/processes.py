"""Which process made something, and whether it still runs.

The number of a process says little by itself: another computer that shares the disk, or another
container, has its own, and the system gives it to another process later.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import platform
import sys
import uuid
from contextlib import suppress
from functools import cache
from pathlib import Path

_DRAWN = 1 << 40
"""Bit of a number that was drawn where no network card was found; each process draws another."""
_BOOT, _NUMBERS = Path("/proc/sys/kernel/random/boot_id"), "/proc/self/ns/pid"


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
