"""A plugin of pytest that hides from the product what only POSIX systems have.

Windows itself is not here, so its lack is made up, with Windows' way of locks on top. The modules
and the names are absent for the product alone: pytest and the standard library go on as they are.
The whole pure part runs this way by ``make test-without-posix``.
"""

from __future__ import annotations

import asyncio  # noqa: F401 - these look for msvcrt to learn where they are
import builtins
import errno
import importlib
import multiprocessing.connection  # noqa: F401
import subprocess  # noqa: F401
import sys
import types
from collections.abc import Mapping, Sequence
from typing import Any

from tests.names_of_posix import MODULES, NAMES

UNREACHED = frozenset({"chown"})
"""What the product calls only where files have groups, as they have for these tests."""
IMPORTERS = ("insole_core", "insole_studio", "kinect_v1")
ASKED_FOR_THE_PRODUCT = ("getpass",)
"""Modules of Python that ask for the user's name where the product has to."""


class WithoutPosix(types.ModuleType):
    """A module as the product sees it; what a test puts into the real one is seen through it."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self._real = importlib.import_module(name)
        self._hidden = frozenset(NAMES[name].split()) - UNREACHED

    def __getattr__(self, name: str) -> Any:
        if name in self._hidden:
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r} here")
        return getattr(self._real, name)


def _locking(handle: int, _mode: int, _count: int) -> None:
    fcntl = importlib.import_module("fcntl")
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise PermissionError(errno.EACCES, "held") from error


_LIMITED = {name: WithoutPosix(name) for name in NAMES}
_import = builtins.__import__


def _import_without(
    name: str,
    module: Mapping[str, object] | None = None,
    names: Mapping[str, object] | None = None,
    fromlist: Sequence[str] | None = (),
    level: int = 0,
) -> types.ModuleType:
    importer = str((module or {}).get("__name__", ""))
    product = importer.split(".", maxsplit=1)[0] in IMPORTERS
    if name in MODULES and (product or importer in ASKED_FOR_THE_PRODUCT):
        raise ImportError(f"there is no {name} here")
    if product and level == 0 and name in _LIMITED:
        return _LIMITED[name]
    return _import(name, module, names, fromlist or (), level)


sys.modules["msvcrt"] = types.ModuleType("msvcrt")
sys.modules["msvcrt"].__dict__.update(locking=_locking, LK_NBLCK=2)
builtins.__import__ = _import_without
