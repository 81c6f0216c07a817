"""A text to read, copied or saved by a button."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QDialog, QHBoxLayout, QPushButton, QTextBrowser, QVBoxLayout, QWidget

from insole_core.errors import InsoleError
from insole_core.files.atomic import write_text
from insole_studio.services.files import Kept
from insole_studio.services.user_messages import UserMessages
from insole_studio.texts import tr

_SIZE = (720, 560)


class TextDialog(QDialog):
    """A non-modal window with a text; deleted when closed.

    Parameters
    ----------
    file_name
        Proposed when the text is saved.
    """

    def __init__(self, title: str, file_name: str, messages: UserMessages, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(title)
        self.resize(*_SIZE)
        self._file_name = file_name
        self._messages = messages
        self._plain = ""
        self.text = QTextBrowser()
        self.text.setAccessibleName(title)
        self.buttons = QHBoxLayout()
        self.buttons.setSpacing(8)
        self.copy = self.add_button(tr("Copy"), self._copy)
        self.save = self.add_button(tr("Save…"), self._save)
        self.buttons.addStretch(1)
        self.close_button = self.add_button(tr("Close"), self.close)
        self.close_button.setDefault(True)
        layout = QVBoxLayout(self)
        layout.addWidget(self.text, 1)
        layout.addLayout(self.buttons)

    def add_button(self, text: str, action: Callable[[], object]) -> QPushButton:
        """Add a button at the end of the row."""
        button = QPushButton(text)
        button.clicked.connect(lambda _checked=False: action())
        self.buttons.addWidget(button)
        return button

    def show_html(self, html: str, plain: str) -> None:
        """Show a text.

        Parameters
        ----------
        plain
            What is copied and saved of it.
        """
        self._plain = plain
        self.text.setHtml(html)

    def _copy(self) -> None:
        QGuiApplication.clipboard().setText(self._plain)

    def _save(self) -> None:
        questions = self._messages.questions.on(self)
        path = questions.file_to_write(self._file_name, tr("Text") + " (*.txt)", Kept.PAPERS)
        if path is None:
            return
        try:
            write_text(self._plain, path)
        except InsoleError as error:
            self._messages.show_error(error, self)
