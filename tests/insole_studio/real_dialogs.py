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
    """Answers the dialogs that come, in their order; every text that was asked is kept,
    and every folder that a file dialog showed.

    A path is typed into a file dialog; a text is the label of a button of a message box.
    """

    def __init__(self, *answers: Path | str) -> None:
        self.left = list(answers)
        self.asked: list[str] = []
        self.folders: list[Path] = []

    def look(self) -> None:
        """Answer the dialog that is in front, if there is one that waits."""
        dialog = QApplication.activeModalWidget()
        if dialog is None or not _is_exposed(dialog) or not self.left:
            return
        answer = self.left[0]
        if isinstance(dialog, QFileDialog) and isinstance(answer, Path):
            folder = Path(dialog.directory().absolutePath())
            if _type_name(dialog, answer):
                self.left.pop(0)
                self.folders.append(folder)
        elif isinstance(dialog, QMessageBox) and isinstance(answer, str):
            self.left.pop(0)
            self.asked.append(dialog.text())
            (button,) = [b for b in dialog.buttons() if b.text() == answer]
            QTest.mouseClick(button, Qt.MouseButton.LeftButton)


def _is_exposed(dialog: QWidget) -> bool:
    window = dialog.windowHandle()
    return window is not None and window.isExposed()


def _type_name(dialog: QFileDialog, path: Path) -> bool:
    """Enter a path; return whether the dialog took it (a completion may take Enter)."""
    (field,) = dialog.findChildren(QLineEdit, "fileNameEdit")
    paste_path(field, path)
    QTest.keyClick(field, Qt.Key.Key_Return)
    return not dialog.isVisible()


def paste_path(field: QLineEdit, path: Path) -> None:
    """Paste a path into the field of a file dialog, in place of what is there.

    Letter by letter, Qt selects the folders on the way in its list if that is slow to follow, and
    opens the folder instead of the file.
    """
    field.selectAll()
    QApplication.clipboard().setText(str(path))
    QTest.keyClick(field, Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)


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
    assert given.left == [], f"{given.left} not asked for after {given.asked}"
