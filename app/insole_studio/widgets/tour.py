"""A tour: a bubble that points at what to do next, and goes on once the user has done it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPoint, QPointF, QRect, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QPainter, QPaintEvent, QPolygonF
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from insole_studio.texts import tr

WIDTH_PX = 336
GAP_PX = 12
ARROW_PX = 10
MARGIN_PX = 16
LOOK_MS = 150
"""How often the bubble looks at what the user has done, and where its widget is."""

IsDone = Callable[[], bool]


@dataclass(frozen=True, eq=False)
class Stop:
    """One stop of the tour.

    Parameters
    ----------
    target
        Gives the widget to point at; None while there is none.
    watch
        Called as the stop begins; gives what tells whether the user has done it. Without it, the
        user reads on.
    skip
        Does what the stops that follow need, if the user leaves this one out.
    """

    title: str
    text: str
    target: Callable[[], QWidget | None]
    watch: Callable[[], IsDone] | None = None
    skip: Callable[[], object] | None = None


class Tour(QFrame):
    """The bubble of the tour; ended after the last stop, by Escape, or by its button.

    It is a window of its own: a native 3-D view would cover any widget of the same window. It never
    takes the focus by itself, and blocks nothing.

    Parameters
    ----------
    otherwise
        What to point at where the widget of a stop is not shown: the way there.
    """

    ended = Signal()

    def __init__(self, stops: Sequence[Stop], window: QWidget, otherwise: QWidget) -> None:
        super().__init__(window, Qt.WindowType.Tool | Qt.WindowType.FramelessWindowHint)
        self.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
        self.setObjectName("tour")
        self.setWindowTitle(tr("Tour"))
        self.setFixedWidth(WIDTH_PX)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._stops = stops
        self._window = window
        self._otherwise = otherwise
        self._number = 0
        self._is_done: IsDone | None = None
        self._title, self._text, self._count = QLabel(), QLabel(), QLabel()
        self._title.setObjectName("heading")
        self._count.setObjectName("quiet")
        self._text.setWordWrap(True)
        self._next = QPushButton()
        self._next.clicked.connect(self._leave_stop)
        leave = QPushButton(tr("End the tour"))
        leave.clicked.connect(self.end)
        buttons = QHBoxLayout()
        for widget in (self._count, leave, self._next):
            buttons.addWidget(widget)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(MARGIN_PX, 4, MARGIN_PX, 4)
        self._up, self._down = _Arrow(points_up=True), _Arrow(points_up=False)
        layout.addWidget(self._up)
        layout.addWidget(self._title)
        layout.addWidget(self._text)
        layout.addLayout(buttons)
        layout.addWidget(self._down)
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK_MS)
        self._timer.timeout.connect(self._look)

    @property
    def shown(self) -> Stop:
        """The stop that is explained."""
        return self._stops[self._number]

    def begin(self) -> None:
        """Show the first stop."""
        self._show_stop()
        self.show()
        self._timer.start()

    def take_focus(self) -> None:
        """Let the keys reach the bubble."""
        self.raise_()
        self.activateWindow()
        self._next.setFocus()

    def _leave_stop(self) -> None:
        if self.shown.skip is not None:
            self.shown.skip()
        self.go_on()

    def go_on(self) -> None:
        """Show the next stop, or end after the last."""
        if self._number + 1 == len(self._stops):
            self.end()
        else:
            self._number += 1
            self._show_stop()

    def end(self) -> None:
        """Close and delete the tour."""
        self._timer.stop()
        self.hide()
        self.ended.emit()
        self.deleteLater()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """End the tour on Escape."""
        if event.key() == Qt.Key.Key_Escape:
            self.end()
        else:
            super().keyPressEvent(event)

    def _look(self) -> None:
        """Go on if the user has done it; else follow the widget, which may have moved."""
        if self._is_done is not None and self._is_done():
            self.go_on()
        else:
            self._point()

    def _show_stop(self) -> None:
        stop = self.shown
        self._is_done = None if stop.watch is None else stop.watch()
        self._title.setText(stop.title)
        self._text.setText(stop.text)
        last = self._number == len(self._stops) - 1
        reads = stop.watch is None
        self._next.setText(tr("Finish") if last else tr("Next") if reads else tr("Skip"))
        self._count.setText(f"{self._number + 1} / {len(self._stops)}")
        self.setAccessibleName(f"{stop.title}. {stop.text}")
        self._point()

    def _point(self) -> None:
        """Stand at the widget with an arrow to it, or at the way there."""
        widget = self.shown.target()
        is_shown = widget is not None and widget.isVisible()
        self._stand_at(widget if widget is not None and is_shown else self._otherwise)

    def _stand_at(self, widget: QWidget) -> None:
        """Stand below the widget or above it, within its window."""
        window = widget.window()
        self._stay_above(window)
        there = QRect(widget.mapToGlobal(QPoint(0, 0)), widget.size())
        room = QRect(window.mapToGlobal(QPoint(0, 0)), window.size())
        room = room.adjusted(GAP_PX, GAP_PX, -GAP_PX, -GAP_PX)
        self._show_arrows(up=True, down=False)
        height = self.height()
        left = min(max(there.center().x() - WIDTH_PX // 2, room.left()), room.right() - WIDTH_PX)
        if there.bottom() + height < room.bottom():
            top, is_below = there.bottom(), True
        elif there.top() - height > room.top():
            top, is_below = there.top() - height, False
        else:  # it fills the window: stand within its lower part
            top, is_below = there.bottom() - height - GAP_PX, True
        self._show_arrows(up=is_below, down=not is_below)
        for arrow in (self._up, self._down):
            arrow.point_at(there.center().x() - left - MARGIN_PX)
        self._go_to(left, top)

    def _show_arrows(self, *, up: bool, down: bool) -> None:
        if (self._up.isHidden(), self._down.isHidden()) != (not up, not down):
            self._up.setVisible(up)
            self._down.setVisible(down)
        self.adjustSize()

    def _go_to(self, left: int, top: int) -> None:
        if self.pos() != QPoint(left, top):
            self.move(left, top)

    def _stay_above(self, window: QWidget) -> None:
        """Stand above the window that is pointed at, without becoming a part of it."""
        self.winId()  # creates what the window manager knows of it
        own, other = self.windowHandle(), window.windowHandle()
        if other is not None and own.transientParent() is not other:
            own.setTransientParent(other)
            self.raise_()


class _Arrow(QWidget):
    """A triangle in the colour of the frame that points up or down."""

    def __init__(self, *, points_up: bool) -> None:
        super().__init__()
        self._points_up = points_up
        self._x = 0
        self.setFixedHeight(ARROW_PX)

    def point_at(self, x_px: int) -> None:
        """Set where the tip is, from the left."""
        if x_px != self._x:
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
