"""Messages and questions to the user."""

from __future__ import annotations

import traceback
from functools import partial

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QMainWindow, QWidget

from insole_core.errors import InsoleError
from insole_studio.services.files import LastFolders
from insole_studio.services.questions import Questions
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.message_label import ErrorDialog

BRIEF_MS, LONG_MS = 5_000, 15_000


class UserMessages(QObject):
    """Dialogs, the status line, and the questions."""

    def __init__(self, window: QMainWindow, folders: LastFolders | None = None) -> None:
        super().__init__(window)
        self._window = window
        self.questions = Questions(window, folders)
        self.dialogs: list[ErrorDialog] = []

    def say(self, text: str, for_ms: int = BRIEF_MS) -> None:
        """Show a text in the status line.

        Parameters
        ----------
        for_ms
            How long it stays, ms.
        """
        self._window.statusBar().showMessage(text, for_ms)

    def clear(self) -> None:
        """Empty the status line."""
        self._window.statusBar().clearMessage()

    def show_error(self, error: Exception, over: QWidget | None = None) -> None:
        """Show an error, with details only if its message was not written for the user.

        Parameters
        ----------
        over
            The window that the error comes from; by default the main window.
        """
        if isinstance(error, InsoleError):
            self._show_dialog(str(error), _cause(error), over)
        else:
            sentence = tr("Something unexpected happened; your work is kept. Please report it.")
            self._show_dialog(sentence, "".join(traceback.format_exception(error)), over)

    def show_sentence(self, sentence: str) -> None:
        """Show a sentence in a dialog."""
        self._show_dialog(sentence, "")

    def _show_dialog(self, sentence: str, details: str, over: QWidget | None = None) -> None:
        dialog = ErrorDialog(translate_core_message(sentence), details, over or self._window)
        self.dialogs.append(dialog)
        dialog.finished.connect(dialog.deleteLater)
        dialog.finished.connect(partial(self._forget_dialog, dialog))
        # A dialog also goes with the window that it is over.
        dialog.destroyed.connect(partial(self._forget_dialog, dialog))
        dialog.open()

    def _forget_dialog(self, dialog: ErrorDialog, _result: object = None) -> None:
        if dialog in self.dialogs:
            self.dialogs.remove(dialog)


def _cause(error: Exception) -> str:
    return repr(error.__cause__) if error.__cause__ is not None else ""
