"""An error: one sentence, the details behind a disclosure, and a button that copies both."""

from __future__ import annotations

from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QMessageBox, QPushButton, QWidget

from insole_studio.texts import tr, with_capital


class ErrorDialog(QMessageBox):
    """A non-modal error dialog."""

    def __init__(self, sentence: str, details: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.report = f"{sentence}\n\n{details}".strip()
        self.setWindowTitle(tr("Insole Studio"))
        self.setIcon(QMessageBox.Icon.Warning)
        self.setText(with_capital(sentence))
        if details:
            self.setDetailedText(details)
        self.setModal(True)
        close = self.addButton(tr("Close"), QMessageBox.ButtonRole.AcceptRole)
        self.setDefaultButton(close)
        self.setEscapeButton(close)
        self._copy: QPushButton = self.addButton(tr("Copy"), QMessageBox.ButtonRole.ActionRole)
        # A message box closes on every button, but copying must not close it.
        self._copy.clicked.disconnect()
        self._copy.clicked.connect(self.copy_report)

    def copy_report(self) -> None:
        """Copy sentence and details to the clipboard."""
        QGuiApplication.clipboard().setText(self.report)
