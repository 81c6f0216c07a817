"""A short tour: a bubble that moves from widget to widget and explains each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPoint, QRect, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from insole_studio.texts import tr

WIDTH_PX = 320
GAP_PX = 12


@dataclass(frozen=True, eq=False)
class Stop:
    """One stop of the tour."""

    widget: QWidget
    title: str
    text: str


class Tour(QFrame):
    """The bubble of the tour; closed at the last stop, by Escape, or by its button.

    It is a window of its own: a native 3-D view would cover any widget of the same window.
    """

    ended = Signal()

    def __init__(self, stops: Sequence[Stop], window: QWidget) -> None:
        super().__init__(window, Qt.WindowType.Tool | Qt.WindowType.FramelessWindowHint)
        self.setObjectName("tour")
        self.setFixedWidth(WIDTH_PX)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._stops = stops
        self._window = window
        self._number = 0
        self._title, self._text, self._count = QLabel(), QLabel(), QLabel()
        self._title.setObjectName("heading")
        self._count.setObjectName("quiet")
        self._text.setWordWrap(True)
        self._next = QPushButton()
        self._next.setDefault(True)
        self._next.clicked.connect(self.go_on)
        skip = QPushButton(tr("End the tour"))
        skip.clicked.connect(self.end)
        buttons = QHBoxLayout()
        for widget in (self._count, skip, self._next):
            buttons.addWidget(widget)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(16, 12, 16, 12)
        layout.addWidget(self._title)
        layout.addWidget(self._text)
        layout.addLayout(buttons)

    def begin(self) -> None:
        """Show the first stop."""
        self._show_stop()
        self.show()
        self.raise_()
        self._next.setFocus()

    def go_on(self) -> None:
        """Show the next stop, or end after the last."""
        self._number += 1
        if self._number == len(self._stops):
            self.end()
        else:
            self._show_stop()

    def end(self) -> None:
        """Close and delete the tour."""
        self.hide()
        self.ended.emit()
        self.deleteLater()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """End the tour on Escape."""
        if event.key() == Qt.Key.Key_Escape:
            self.end()
        else:
            super().keyPressEvent(event)

    def _show_stop(self) -> None:
        stop = self._stops[self._number]
        self._title.setText(stop.title)
        self._text.setText(stop.text)
        last = self._number == len(self._stops) - 1
        self._next.setText(tr("Begin") if last else tr("Next"))
        self._count.setText(f"{self._number + 1} / {len(self._stops)}")
        self.adjustSize()
        self.move(self._beside(stop.widget))

    def _beside(self, widget: QWidget) -> QPoint:
        """Return a position below, above or beside a widget, wherever the window has space."""
        window = self._window
        there = QRect(widget.mapToGlobal(QPoint(0, 0)), widget.size())
        whole = QRect(window.mapToGlobal(QPoint(0, 0)), window.size())
        room = whole.adjusted(GAP_PX, GAP_PX, -GAP_PX, -GAP_PX)
        left = min(max(there.center().x() - WIDTH_PX // 2, room.left()), room.right() - WIDTH_PX)
        if there.bottom() + GAP_PX + self.height() < room.bottom():
            return QPoint(left, there.bottom() + GAP_PX)
        if there.top() - GAP_PX - self.height() > room.top():
            return QPoint(left, there.top() - GAP_PX - self.height())
        return QPoint(left, there.center().y() - self.height() // 2)
