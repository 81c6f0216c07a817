"""How messages are told: beside what they are about, or, for an error, in a dialog with details."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QLabel, QMessageBox, QProgressBar, QPushButton, QWidget

from insole_studio.texts import tr, translate_core_message, with_capital
from insole_studio.widgets.layouts import keep_room


class MessageLabel(QLabel):
    """A label of sentences, one below the other; hidden while there are none.

    Parameters
    ----------
    style
        Style in the theme: "warning", "quiet" or plain.
    """

    def __init__(self, style: str = "") -> None:
        super().__init__()
        self.setObjectName(style)
        self.setWordWrap(True)
        self.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.hide()

    def say(self, sentence: str) -> None:
        """Show one sentence; an empty one hides the label."""
        self.say_all([sentence] if sentence else [])

    def say_all(self, sentences: Sequence[str]) -> None:
        """Show sentences, translated and capitalised."""
        said = map(translate_core_message, sentences)
        self.setText("\n".join(with_capital(sentence) for sentence in said))
        self.setVisible(bool(sentences))


class ProgressBar(QProgressBar):
    """Progress and description of a long job; hidden while none runs, its room kept."""

    def __init__(self) -> None:
        super().__init__()
        self.setRange(0, 100)
        keep_room(self)
        self.hide()

    def show_work(self, fraction: float, text: str) -> None:
        """Show the progress.

        Parameters
        ----------
        fraction
            Completed share, 0 to 1.
        text
            What is being done; empty hides the bar.
        """
        self.setVisible(bool(text))
        self.setValue(round(100 * fraction))
        self.setFormat(translate_core_message(text))


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
