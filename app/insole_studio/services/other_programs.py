"""Opens files in other programs of the user, such as the browser."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices

_SAVED = "_ORIG"
"""Ends the names of variables in which PyInstaller keeps what the user had set."""
_OF_LOADER = "_PYI_"
"""Begins the names of variables by which PyInstaller's processes know each other."""


def open_file(path: Path) -> bool:
    """Open a file in the program that the user has for its kind; return whether there is one."""
    with _users_environment():
        return QDesktopServices.openUrl(QUrl.fromLocalFile(str(path)))


def outside_bundle(environment: Mapping[str, str], bundle: Path) -> dict[str, str]:
    """Return the environment variables for a program that does not belong to the bundle.

    With those of a frozen program it would load our libraries and Qt plugins in place of its own.

    Parameters
    ----------
    environment
        Of this process.
    bundle
        The folder of the frozen program's libraries.
    """
    kept = {}
    for name, value in environment.items():
        if name.startswith(_OF_LOADER) or name.removesuffix(_SAVED) in environment.keys() - {name}:
            continue
        saved = environment.get(name + _SAVED)
        parts = value.split(os.pathsep)
        others = [part for part in parts if not part or not Path(part).is_relative_to(bundle)]
        if saved is not None:
            kept[name] = saved
        elif len(others) == len(parts):
            kept[name] = value
        elif others:
            kept[name] = os.pathsep.join(others)
    return kept


@contextmanager
def _users_environment() -> Iterator[None]:
    """Let programs that are started within have the variables that this one was started with."""
    bundle = getattr(sys, "_MEIPASS", None)
    if bundle is None:
        yield
        return
    before = dict(os.environ)
    _set_environment(outside_bundle(before, Path(bundle)))
    try:
        yield
    finally:
        _set_environment(before)


def _set_environment(variables: Mapping[str, str]) -> None:
    for name in os.environ.keys() - variables.keys():
        del os.environ[name]
    os.environ.update(variables)
