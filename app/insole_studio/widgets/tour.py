"""A short tour: a bubble that moves from widget to widget and explains each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPoint, QPointF, QRect, Qt, Signal
from PySide6.QtGui import QKeyEvent, QPainter, QPaintEvent, QPolygonF
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from insole_studio.texts import tr

WIDTH_PX = 320
GAP_PX = 12
ARROW_PX = 10


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
        layout.setContentsMargins(16, 4, 16, 4)
        self._up, self._down = _Arrow(points_up=True), _Arrow(points_up=False)
        layout.addWidget(self._up)
        layout.addWidget(self._title)
        layout.addWidget(self._text)
        layout.addLayout(buttons)
        layout.addWidget(self._down)

    @property
    def shown(self) -> Stop:
        """The stop that is explained."""
        return self._stops[self._number]

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
        stop = self.shown
        self._title.setText(stop.title)
        self._text.setText(stop.text)
        last = self._number == len(self._stops) - 1
        self._next.setText(tr("Begin") if last else tr("Next"))
        self._count.setText(f"{self._number + 1} / {len(self._stops)}")
        self._point_at(stop.widget)

    def _point_at(self, widget: QWidget) -> None:
        """Stand below the widget or above it, within the window, with an arrow to it."""
        there = QRect(widget.mapToGlobal(QPoint(0, 0)), widget.size())
        room = QRect(self._window.mapToGlobal(QPoint(0, 0)), self._window.size())
        room = room.adjusted(GAP_PX, GAP_PX, -GAP_PX, -GAP_PX)
        self._up.show()
        self._down.hide()
        self.adjustSize()
        height = self.height()
        left = min(max(there.center().x() - WIDTH_PX // 2, room.left()), room.right() - WIDTH_PX)
        if there.bottom() + height < room.bottom():
            top, is_below = there.bottom(), True
        elif there.top() - height > room.top():
            top, is_below = there.top() - height, False
        else:  # it fills the window: stand within its lower part
            top, is_below = there.bottom() - height - GAP_PX, True
        self._up.setVisible(is_below)
        self._down.setVisible(not is_below)
        for arrow in (self._up, self._down):
            arrow.point_at(there.center().x() - left - 16)
        self.move(left, top)


class _Arrow(QWidget):
    """A triangle in the colour of the frame that points up or down."""

    def __init__(self, *, points_up: bool) -> None:
        super().__init__()
        self._points_up = points_up
        self._x = 0
        self.setFixedHeight(ARROW_PX)

    def point_at(self, x_px: int) -> None:
        """Set where the tip is, from the left."""
        self._x = x_px
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draw the triangle."""
        tip, base = (0, ARROW_PX) if self._points_up else (ARROW_PX, 0)
        x = min(max(self._x, ARROW_PX), self.width() - ARROW_PX)
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self.palette().highlight())
        corners = [QPointF(x - ARROW_PX, base), QPointF(x, tip), QPointF(x + ARROW_PX, base)]
        painter.drawPolygon(QPolygonF(corners))
