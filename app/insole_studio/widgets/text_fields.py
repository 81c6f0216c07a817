"""Text fields: what is typed and not yet entered, notes, and why an input was rejected."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication, QEvent, QPoint, QSignalBlocker, Qt, QTimer, Signal
from PySide6.QtGui import QFocusEvent, QGuiApplication
from PySide6.QtWidgets import QApplication, QLabel, QLineEdit, QPlainTextEdit, QWidget
from shiboken6 import isValid

_HEIGHT_PX = 64
SHOWN_MS = 8000
WIDTH_PX = 260
GAP_PX = 4


def commit_typed_text() -> None:
    """Let the focused field enter what is being typed, as if the focus had left it.

    The field keeps the focus, its cursor and its selection.
    """
    field = QApplication.focusWidget()
    if field is None or not field.testAttribute(Qt.WidgetAttribute.WA_InputMethodEnabled):
        return
    QGuiApplication.inputMethod().commit()
    for kind in (QEvent.Type.FocusOut, QEvent.Type.FocusIn):
        if isValid(field):  # entering a value may replace the fields of a panel
            event = QFocusEvent(kind, Qt.FocusReason.ActiveWindowFocusReason)
            QCoreApplication.sendEvent(field, event)


def is_typing() -> bool:
    """Return whether the focused field holds typed text that it has not entered yet."""
    field = QApplication.focusWidget()
    if isinstance(field, QPlainTextEdit):
        return field.document().isModified()
    line = field if field is None or isinstance(field, QLineEdit) else field.findChild(QLineEdit)
    return line is not None and line.isModified()


def show_unless_typing(field: QLineEdit | QPlainTextEdit, text: str) -> None:
    """Show a text in a field, unless one is being typed there that it has not entered yet."""
    if isinstance(field, QLineEdit):
        if field.text() != text and not field.isModified():
            field.setText(text)
    elif field.toPlainText() != text and not field.document().isModified():
        with QSignalBlocker(field):
            field.setPlainText(text)


def forget_typed(field: QLineEdit | QPlainTextEdit) -> None:
    """Let the next text that is shown replace what is being typed."""
    if isinstance(field, QLineEdit):
        field.setModified(False)
    else:
        field.document().setModified(False)


class NotesField(QPlainTextEdit):
    """A text field of a few lines; Tab moves the focus."""

    left = Signal()
    """The focus has left the field, whose text may have changed."""

    def __init__(self) -> None:
        super().__init__()
        self.setTabChangesFocus(True)
        self.setFixedHeight(_HEIGHT_PX)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Announce that the text may have changed."""
        super().focusOutEvent(event)
        self.left.emit()


class ValidationBubble(QLabel):
    """A bubble above its field, or below if there is no space; hides after a while.

    It is a window of its own: a native 3-D view would cover any widget of the same window.
    """

    def __init__(self, field: QWidget) -> None:
        super().__init__(field, Qt.WindowType.ToolTip)
        self.setObjectName("warning")
        self.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
        self.setWordWrap(True)
        self.setFixedWidth(WIDTH_PX)
        self._field = field
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(SHOWN_MS)
        self._timer.timeout.connect(self.hide)

    def say(self, sentence: str) -> None:
        """Show a sentence beside the field if the field is visible."""
        if not self._field.isVisible():
            return
        self.setText(sentence)
        self.adjustSize()
        self.move(self._beside())
        self.show()
        self._timer.start()

    def _beside(self) -> QPoint:
        field, window = self._field, self._field.window()
        there = field.mapToGlobal(QPoint(0, 0))
        right = window.mapToGlobal(QPoint(window.width() - self.width(), 0)).x()
        above = there.y() - self.height() - GAP_PX
        fits = above >= window.mapToGlobal(QPoint(0, 0)).y()
        y = above if fits else there.y() + field.height() + GAP_PX
        return QPoint(min(there.x(), right), y)
