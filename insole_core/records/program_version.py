"""The version of this program, as the record keeps it beside what it has made."""

from __future__ import annotations

from functools import cache
from importlib.metadata import version


@cache
def program_version() -> str:
    """Return the version of this program."""
    return version("insole-studio")
