"""The pointer of an X server moved from outside: its events wait while the program is busy."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QWidget


@contextmanager
def server() -> Iterator[tuple[ctypes.CDLL, ctypes.CDLL, ctypes.c_void_p]]:
    x11, xtst = (ctypes.CDLL(name) for name in ("libX11.so.6", "libXtst.so.6"))
    x11.XOpenDisplay.restype = ctypes.c_void_p
    display = ctypes.c_void_p(x11.XOpenDisplay(None))
    assert display, "a test marked `display` has an X server"
    try:
        yield x11, xtst, display
    finally:
        x11.XCloseDisplay(display)


def drag_at_once(widget: QWidget, way: Sequence[QPoint]) -> None:
    """Press, move along a way and release; the program sees nothing before all has happened."""
    ratio = widget.devicePixelRatioF()
    places = [widget.mapToGlobal(place) * ratio for place in way]
    with server() as (x11, xtst, display):
        for number, place in enumerate(places):
            xtst.XTestFakeMotionEvent(display, -1, place.x(), place.y(), 0)
            if number == 0:
                xtst.XTestFakeButtonEvent(display, 1, 1, 0)
        xtst.XTestFakeButtonEvent(display, 1, 0, 0)
        x11.XSync(display, 0)
