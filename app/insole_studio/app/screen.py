"""Whether windows can be shown here, found out before Qt, which ends the process if they cannot."""

from __future__ import annotations

import ctypes
import os
import sys
from pathlib import Path

from insole_core.errors import InsoleError
from insole_studio.missing_library import missing_library_error

_DRAWN_BY = ("xcb", "wayland")


class NoScreenError(InsoleError):
    """No window can be shown."""


def has_screen() -> bool:
    """Return whether windows can be shown to somebody."""
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def check_screen() -> None:
    """Check that Qt will find a screen, and the libraries to draw on it.

    Raises
    ------
    NoScreenError
        When there is no screen, or it does not answer.
    MissingLibraryError
        When the system lacks a library that Qt draws with.
    """
    if sys.platform in ("win32", "darwin"):
        return
    platform = os.environ.get("QT_QPA_PLATFORM", "").split(":")[0]
    if platform not in ("", *_DRAWN_BY):  # such as offscreen: for no screen, or one of its own
        return
    if not has_screen():
        raise NoScreenError(
            "There is no screen to open a window on; start Insole Studio at the desktop of the "
            "computer. What works without one says insole-studio --help."
        )
    if platform == "xcb" or not os.environ.get("WAYLAND_DISPLAY"):
        _load_plugin("xcb")
        _check_x_server()


def _load_plugin(name: str) -> None:
    from PySide6.QtCore import QLibraryInfo

    folder = QLibraryInfo.path(QLibraryInfo.LibraryPath.PluginsPath)
    plugin = Path(folder) / "platforms" / f"libq{name}.so"
    if not plugin.exists():  # a Qt of the system, which looks elsewhere
        return
    try:
        ctypes.CDLL(str(plugin))
    except OSError as error:
        raise missing_library_error(error) or error from error


def _check_x_server() -> None:
    xcb = ctypes.CDLL("libxcb.so.1")  # the plugin has it
    xcb.xcb_connect.restype = ctypes.c_void_p
    connection = ctypes.c_void_p(xcb.xcb_connect(None, None))
    failed = xcb.xcb_connection_has_error(connection)
    xcb.xcb_disconnect(connection)
    if failed:
        raise NoScreenError(
            "The screen {screen} does not answer; start Insole Studio at the desktop of the "
            "computer, as the user who is signed in there.",
            screen=os.environ.get("DISPLAY", ""),
        )
