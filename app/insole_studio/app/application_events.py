"""What holds for the whole application: foreign text, typed text, the wheel, windows, F1, files."""

from __future__ import annotations

import math
import time

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QFileOpenEvent, QGuiApplication, QKeyEvent, QWheelEvent
from PySide6.QtWidgets import (
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLabel,
    QScrollBar,
    QWidget,
)
from shiboken6 import isValid

from insole_studio.widgets.screen_room import fit_to_screen
from insole_studio.widgets.text_fields import commit_typed_text

_USER_TURNS = (
    QEvent.Type.MouseButtonPress,
    QEvent.Type.TouchBegin,
    QEvent.Type.TabletPress,
    QEvent.Type.Wheel,
    QEvent.Type.Shortcut,
    QEvent.Type.Close,
)
"""Events by which the user turns from the focused field to something else."""
_PRESSES = (
    QEvent.Type.MouseButtonPress,
    QEvent.Type.MouseButtonDblClick,
    QEvent.Type.TouchBegin,
    QEvent.Type.TabletPress,
)
_LOOKED_AT = frozenset(
    (
        *_USER_TURNS,
        *_PRESSES,
        QEvent.Type.KeyPress,
        QEvent.Type.Polish,
        QEvent.Type.Show,
        QEvent.Type.FileOpen,
    )
)
"""Of the thousands of events of a second, those that are more than passed on."""
WHEEL_REST_S = 0.7
"""A wheel that rests longer than this begins another run."""


class ApplicationEvents(QObject):
    """Filters the events of the whole application.

    Labels, those of dialogs and tooltips included, show their text as it is unless they ask for
    rich text themselves: the names of patients and files come from elsewhere, and Qt would take
    ``<img src=…>`` among them for an image to be loaded.

    What is typed into a field counts as entered as soon as the user turns to anything else:
    buttons of a toolbar, menus, shortcuts and closing a window do not take the focus from it.

    The wheel changes the value of a field only if the field has the focus; else the panel scrolls.

    No window is shown larger than its screen.

    F1 asks for help in every window; a shortcut of the main window does not count in the others.
    """

    gesture_began = Signal()
    """Emitted when the user begins to do another thing: presses a button or a key, or turns the
    wheel after a rest. A drag, a held key and a run of the wheel are one gesture each."""
    help_requested = Signal(QWidget)
    """With the widget that had the focus."""
    file_requested = Signal(str)
    """With the file that macOS asks to open, for that is how it passes on a double click."""

    def __init__(self, application: QApplication) -> None:
        super().__init__(application)
        self._wheel_turned_at_s = -math.inf
        application.installEventFilter(self)
        for widget in application.allWidgets():  # those that were made before
            if isValid(widget):  # else it goes at the next turn, with the window it was in
                _prepare(widget)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Look at an event on its way; F1 and files to open are withheld."""
        kind = event.type()
        if kind not in _LOOKED_AT:
            return False
        if self._begins_gesture(kind, event):
            self.gesture_began.emit()
        if kind == QEvent.Type.Polish:
            _prepare(watched)
        elif kind == QEvent.Type.Show and isinstance(watched, QWidget) and watched.isWindow():
            fit_to_screen(watched)
        elif kind in _USER_TURNS and _is_turned_to(watched) and not _is_in_focus(watched):
            commit_typed_text()
            if kind == QEvent.Type.Wheel and _is_in_field(watched):
                event.ignore()  # so that it goes on to what scrolls
                return True
        elif isinstance(event, QKeyEvent) and _asks_for_help(event, watched):
            self.help_requested.emit(watched)
            return True
        elif isinstance(event, QFileOpenEvent) and event.file():
            self.file_requested.emit(event.file())
            return True
        return False

    def _begins_gesture(self, kind: QEvent.Type, event: QEvent) -> bool:
        if isinstance(event, QKeyEvent):
            return kind == QEvent.Type.KeyPress and not event.isAutoRepeat()
        if not isinstance(event, QWheelEvent):
            return kind in _PRESSES
        # When it was turned, not when a busy window gets to it; not every platform tells.
        turned_at_s = event.timestamp() / 1000 or time.monotonic()
        rest_s, self._wheel_turned_at_s = turned_at_s - self._wheel_turned_at_s, turned_at_s
        return abs(rest_s) > WHEEL_REST_S

    def close(self) -> None:
        """Stop filtering."""
        QGuiApplication.instance().removeEventFilter(self)  # type: ignore[union-attr]
        self.deleteLater()


def _asks_for_help(event: QKeyEvent, watched: QObject) -> bool:
    is_f1 = event.key() == Qt.Key.Key_F1 and event.modifiers() == Qt.KeyboardModifier.NoModifier
    return is_f1 and event.type() == QEvent.Type.KeyPress and watched.isWidgetType()


def _prepare(watched: QObject) -> None:
    if isinstance(watched, QLabel) and watched.textFormat() == Qt.TextFormat.AutoText:
        watched.setTextFormat(Qt.TextFormat.PlainText)
    elif isinstance(watched, QWidget) and watched.focusPolicy() == Qt.FocusPolicy.WheelFocus:
        watched.setFocusPolicy(Qt.FocusPolicy.StrongFocus)


def _is_turned_to(watched: QObject) -> bool:
    """Return whether a user can turn to an object, not only see it or reach others through it."""
    if watched.isWindowType():  # what it gets, it passes on to a widget, maybe the focused field
        return False
    # A tooltip closes by itself while the user goes on typing.
    is_tip = isinstance(watched, QWidget) and watched.windowType() == Qt.WindowType.ToolTip
    return not is_tip


def _is_in_focus(watched: QObject) -> bool:
    field = QApplication.focusWidget()
    is_within = field is not None and isinstance(watched, QWidget) and field.isAncestorOf(watched)
    return watched is field or is_within


def _is_in_field(watched: QObject) -> bool:
    """Return whether a widget is, or is part of, a field whose value the wheel would change."""
    widget = watched if isinstance(watched, QWidget) else None
    while widget is not None:
        if isinstance(widget, QAbstractSpinBox | QComboBox | QAbstractSlider):
            return not isinstance(widget, QScrollBar)
        if widget.isWindow():  # the list of a combo box is a window of its own, and scrolls
            return False
        widget = widget.parentWidget()
    return False
