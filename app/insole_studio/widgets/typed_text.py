"""What is being typed into a field, and not yet entered."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication, QEvent, QSignalBlocker, Qt
from PySide6.QtGui import QFocusEvent, QGuiApplication
from PySide6.QtWidgets import QApplication, QLineEdit, QPlainTextEdit
from shiboken6 import isValid


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
