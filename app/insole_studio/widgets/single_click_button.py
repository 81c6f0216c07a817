"""A button that takes the place of another one, or stays where what it acted on has gone."""

from __future__ import annotations

from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QPushButton


class SingleClickButton(QPushButton):
    """Is not pressed by the second click of a double-click, which was meant for what was there."""

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Swallow the click, which Qt's own button takes for one more."""
        event.accept()
