"""Hides what the windows show while they are locked, and keeps input from them."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication, QEvent, QObject, Qt
from PySide6.QtWidgets import QApplication, QLabel, QVBoxLayout, QWidget

_INPUT = frozenset(
    {
        QEvent.Type.KeyPress,
        QEvent.Type.KeyRelease,
        QEvent.Type.ShortcutOverride,
        QEvent.Type.Shortcut,
        QEvent.Type.MouseButtonPress,
        QEvent.Type.MouseButtonRelease,
        QEvent.Type.MouseButtonDblClick,
        QEvent.Type.MouseMove,
        QEvent.Type.Wheel,
        QEvent.Type.ContextMenu,
        QEvent.Type.TouchBegin,
        QEvent.Type.TabletPress,
        QEvent.Type.Drop,
        QEvent.Type.DragEnter,
        QEvent.Type.ToolTip,
    }
)


class LockCover(QObject):
    """Covers every window but the one that asks for a password, also windows that come later.

    Their titles, which name patients, are hidden too. `lift` shows everything as it was.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._dialog: QWidget | None = None
        self._words = ""
        self._covers: dict[QWidget, _Cover] = {}

    def put_over_all(self, words: str, *, but: QWidget) -> None:
        """Cover all windows but one.

        Parameters
        ----------
        words
            What the covers and titles say.
        """
        self._dialog, self._words = but, words
        _close_popups()
        for window in QApplication.topLevelWidgets():
            self._cover(window)
        QCoreApplication.instance().installEventFilter(self)  # type: ignore[union-attr]

    def lift(self) -> None:
        """Show the windows again."""
        QCoreApplication.instance().removeEventFilter(self)  # type: ignore[union-attr]
        covers, self._covers = self._covers, {}
        for cover in covers.values():
            cover.lift()
        self._dialog = None

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Withhold input from all but the dialog; cover windows that are shown."""
        if self._dialog is None or not isinstance(watched, QWidget):
            return False
        if event.type() == QEvent.Type.Show and watched.isWindow():
            self._cover(watched)
        elif event.type() in _INPUT:
            return watched.window() is not self._dialog
        return False

    def _cover(self, window: QWidget) -> None:
        if window is self._dialog or window in self._covers or not window.isVisible():
            return
        if window.windowType() in (Qt.WindowType.ToolTip, Qt.WindowType.Popup):
            window.hide()
            return
        cover = _Cover(window, self._words)
        self._covers[window] = cover
        cover.destroyed.connect(lambda: self._covers.pop(window, None))


class _Cover(QWidget):
    """Fills a window, and keeps its title."""

    def __init__(self, window: QWidget, words: str) -> None:
        super().__init__(window)
        self.setAutoFillBackground(True)
        label = QLabel(words)
        label.setObjectName("heading")
        label.setAlignment(Qt.AlignmentFlag.AlignCenter)
        layout = QVBoxLayout(self)
        layout.addWidget(label)
        self._covering_title = f"Insole Studio – {words}"
        self._window = window
        self._title = window.windowTitle()
        self._hide_title()
        window.installEventFilter(self)
        self.setGeometry(window.rect())
        self.raise_()
        self.show()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the size of the window, and hide a new title of it."""
        if event.type() == QEvent.Type.Resize:
            self.setGeometry(self._window.rect())
        elif event.type() == QEvent.Type.WindowTitleChange:
            self._hide_title()
        elif event.type() in (QEvent.Type.ChildPolished, QEvent.Type.LayoutRequest):
            self.raise_()
        return False

    def lift(self) -> None:
        """Show the window with its title again."""
        self._window.removeEventFilter(self)
        self._window.setWindowTitle(self._title)
        self.hide()
        self.deleteLater()

    def _hide_title(self) -> None:
        title = self._window.windowTitle()
        if title != self._covering_title:
            self._title = title
            self._window.setWindowTitle(self._covering_title)


def _close_popups() -> None:
    while (popup := QApplication.activePopupWidget()) is not None:
        if not popup.close():
            return
