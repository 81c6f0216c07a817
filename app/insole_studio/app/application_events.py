"""What holds for the whole application: foreign text, typed text, F1, files to open."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QFileOpenEvent, QGuiApplication, QKeyEvent
from PySide6.QtWidgets import QApplication, QLabel, QWidget
from shiboken6 import isValid

from insole_studio.widgets.typed_text import commit_typed_text

_USER_TURNS = (
    QEvent.Type.MouseButtonPress,
    QEvent.Type.TouchBegin,
    QEvent.Type.TabletPress,
    QEvent.Type.Wheel,
    QEvent.Type.Shortcut,
    QEvent.Type.Close,
)
"""Events by which the user turns from the focused field to something else."""


class ApplicationEvents(QObject):
    """Filters the events of the whole application.

    Labels, those of dialogs and tooltips included, show their text as it is unless they ask for
    rich text themselves: the names of patients and files come from elsewhere, and Qt would take
    ``<img src=…>`` among them for an image to be loaded.

    What is typed into a field counts as entered as soon as the user turns to anything else:
    buttons of a toolbar, menus, shortcuts and closing a window do not take the focus from it.

    F1 asks for help in every window; a shortcut of the main window does not count in the others.
    """

    help_requested = Signal(QWidget)
    """With the widget that had the focus."""
    file_requested = Signal(str)
    """With the file that macOS asks to open, for that is how it passes on a double click."""

    def __init__(self, application: QApplication) -> None:
        super().__init__(application)
        application.installEventFilter(self)
        for widget in application.allWidgets():  # those that were made before
            if isValid(widget):  # else it goes at the next turn, with the window it was in
                _show_as_it_is(widget)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Look at an event on its way; F1 and files to open are withheld."""
        kind = event.type()
        if kind == QEvent.Type.Polish:
            _show_as_it_is(watched)
        elif kind in _USER_TURNS and _is_turned_to(watched) and not _is_in_focused_field(watched):
            commit_typed_text()
        elif isinstance(event, QKeyEvent) and _asks_for_help(event, watched):
            self.help_requested.emit(watched)
            return True
        elif isinstance(event, QFileOpenEvent) and event.file():
            self.file_requested.emit(event.file())
            return True
        return False

    def close(self) -> None:
        """Stop filtering."""
        QGuiApplication.instance().removeEventFilter(self)  # type: ignore[union-attr]
        self.deleteLater()


def _asks_for_help(event: QKeyEvent, watched: QObject) -> bool:
    is_f1 = event.key() == Qt.Key.Key_F1 and event.modifiers() == Qt.KeyboardModifier.NoModifier
    return is_f1 and event.type() == QEvent.Type.KeyPress and watched.isWidgetType()


def _show_as_it_is(watched: QObject) -> None:
    if isinstance(watched, QLabel) and watched.textFormat() == Qt.TextFormat.AutoText:
        watched.setTextFormat(Qt.TextFormat.PlainText)


def _is_turned_to(watched: QObject) -> bool:
    """Return whether a user can turn to an object, not only see it or reach others through it."""
    if watched.isWindowType():  # what it gets, it passes on to a widget, maybe the focused field
        return False
    # A tooltip closes by itself while the user goes on typing.
    is_tip = isinstance(watched, QWidget) and watched.windowType() == Qt.WindowType.ToolTip
    return not is_tip


def _is_in_focused_field(watched: QObject) -> bool:
    field = QApplication.focusWidget()
    return field is None or (
        isinstance(watched, QWidget) and (watched is field or field.isAncestorOf(watched))
    )
