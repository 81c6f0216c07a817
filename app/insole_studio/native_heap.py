"""Keeps the memory of a long session small where the C library would keep it.

glibc gives each thread a heap of its own and hands freed memory back only from the end of a heap:
what threads have freed in between stays with the process. Elsewhere nothing needs to be done.
"""

from __future__ import annotations

import ctypes
import os
from functools import cache

_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD, _M_ARENA_MAX = -1, -3, -8
"""Of `mallopt`, from malloc.h."""
_HEAP_BYTES, _KEPT_BYTES = 2**25, 2**26
"""Largest array that is put into the heap, and how much may stay free at the heap's end.

The C library takes these limits itself, but only after it has freed arrays of that size. Until then
it asks the system for each one anew, which clears it page by page.
"""


def share_one_heap() -> None:
    """Let all threads share one heap, for large arrays too.

    It holds for threads that have not allocated yet.
    """
    libc = _glibc()
    if libc is not None:
        libc.mallopt(_M_ARENA_MAX, 1)
        libc.mallopt(_M_MMAP_THRESHOLD, _HEAP_BYTES)
        libc.mallopt(_M_TRIM_THRESHOLD, _KEPT_BYTES)


def return_freed_memory() -> None:
    """Hand what is free inside the heap back to the system."""
    libc = _glibc()
    if libc is not None:
        libc.malloc_trim(0)


@cache
def _glibc() -> ctypes.CDLL | None:
    is_glibc = "CS_GNU_LIBC_VERSION" in getattr(os, "confstr_names", {})
    return ctypes.CDLL(None) if is_glibc else None
