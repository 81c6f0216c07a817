"""Room on the screen: no window is larger than the screen that it is shown on."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QGuiApplication, QResizeEvent
from PySide6.QtWidgets import QFrame, QScrollArea, QStyle, QWidget

UNSEEN = ("offscreen", "minimal")
"""Platforms that draw for no screen: a window may have any size there, and has no OpenGL."""
_FRAMED = (Qt.WindowType.Window, Qt.WindowType.Dialog, Qt.WindowType.Sheet, Qt.WindowType.Tool)


def bounded(window: QWidget, wanted: QSize) -> QSize:
    """Return a size for a window that its screen has room for, with a frame around it."""
    if QGuiApplication.platformName() in UNSEEN:
        return wanted
    room = window.screen().availableGeometry().size()
    # The frame itself is known only once the window has been shown.
    title_px = window.style().pixelMetric(QStyle.PixelMetric.PM_TitleBarHeight, None, window)
    return wanted.boundedTo(room - QSize(0, title_px))


def fit_to_screen(window: QWidget) -> None:
    """Let a window that is about to be shown be no larger than its screen."""
    is_framed = window.windowType() in _FRAMED
    if is_framed and not (window.windowState() & ~Qt.WindowState.WindowActive):
        window.resize(bounded(window, window.size()))


class Scrolled(QScrollArea):
    """Shows a widget whole, or scrolls it where there is no room for it."""

    def __init__(self, content: QWidget) -> None:
        super().__init__()
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setWidget(content)


class Shrunk(QWidget):
    """Holds a widget that scrolls parts of itself, and lets it be as low as these allow.

    A scroll area around it would else give it the height that it would like at this width.
    """

    def __init__(self, content: QWidget) -> None:
        super().__init__()
        self._content = content
        content.setParent(self)

    def minimumSizeHint(self) -> QSize:
        """Return the least width, and the least height at the present width."""
        layout, least = self._content.layout(), self._content.minimumSizeHint()
        if layout is None or not layout.hasHeightForWidth():
            return least
        width_px = max(self.width(), least.width())
        return QSize(least.width(), layout.minimumHeightForWidth(width_px))

    def sizeHint(self) -> QSize:
        """Return the size that the content would like."""
        return self._content.sizeHint()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the content the whole room."""
        super().resizeEvent(event)
        self._content.setGeometry(self.rect())
