"""Answers real dialogs by real events, as a user does."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from PySide6.QtCore import Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QLineEdit, QMessageBox, QWidget

LOOK_EVERY_MS = 50


class DialogAnswers:
    """Answers the dialogs that come, in their order; every text that was asked is kept.

    A path is typed into a file dialog; a text is the label of a button of a message box.
    """

    def __init__(self, *answers: Path | str) -> None:
        self.left = list(answers)
        self.asked: list[str] = []
        self._answered: QWidget | None = None

    def look(self) -> None:
        """Answer the dialog that is in front, if there is one that waits."""
        dialog = QApplication.activeModalWidget()
        if dialog is None or dialog is self._answered or not self.left:
            return
        if isinstance(dialog, QFileDialog):
            path = self.left.pop(0)
            assert isinstance(path, Path), f"a file dialog came, {path!r} was expected"
            self._answered = dialog
            _type_name(dialog, path)
        elif isinstance(dialog, QMessageBox):
            label = self.left.pop(0)
            self.asked.append(dialog.text())
            self._answered = dialog
            (button,) = [b for b in dialog.buttons() if b.text() == label]
            QTest.mouseClick(button, Qt.MouseButton.LeftButton)


def _type_name(dialog: QFileDialog, path: Path) -> None:
    (field,) = dialog.findChildren(QLineEdit, "fileNameEdit")
    field.selectAll()
    QTest.keyClicks(field, str(path))
    QTest.keyClick(field, Qt.Key.Key_Return)
    if dialog.isVisible():  # the first Enter took the completion
        QTest.keyClick(field, Qt.Key.Key_Return)


@contextmanager
def answering(*answers: Path | str) -> Iterator[DialogAnswers]:
    """Answer the dialogs that come inside the context; all answers must be used."""
    given = DialogAnswers(*answers)
    timer = QTimer()
    timer.timeout.connect(given.look)
    timer.start(LOOK_EVERY_MS)
    try:
        yield given
    finally:
        timer.stop()
    assert given.left == []
