"""Tells in words that the system lacks a library, which Python tells as an error of an import."""

from __future__ import annotations

import re

from insole_core.errors import InsoleError

_LINUX = re.compile(r"(?P<name>\S+\.so[.\d]*): cannot open shared object file")
_WINDOWS = re.compile(r"DLL load failed while importing (?P<name>\w+)")


class MissingLibraryError(InsoleError):
    """The system lacks a library."""


def missing_library_error(error: Exception) -> MissingLibraryError | None:
    """Return what to tell of an error of an import; None if no library of the system is missing."""
    found = _LINUX.search(str(error))
    if found is not None:
        return MissingLibraryError(
            "The system lacks the library {name}; install Insole Studio by its package, which "
            "brings all that it needs, or ask whoever looks after this computer for that library.",
            name=found["name"],
        )
    found = _WINDOWS.search(str(error))
    if found is not None:
        return MissingLibraryError(
            "Windows cannot load a library of {name}; run the installer of Insole Studio again, "
            "and install the updates of Windows.",
            name=found["name"],
        )
    return None
