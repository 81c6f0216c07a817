"""Messages and questions to the user, and the current notices with what their buttons do."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QMainWindow, QWidget

from insole_core.errors import InsoleError
from insole_studio.services.files import LastFolders
from insole_studio.services.questions import Questions
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.message_label import ErrorDialog
from insole_studio.widgets.notice_bar import Notice, NoticeBar

Offer: TypeAlias = tuple[str, Callable[[], object]]
"""Label of a button, and what it does."""
_BRIEF_MS, LONG_MS = 5_000, 15_000


@dataclass(frozen=True)
class _Shown:
    notice: Notice
    offers: tuple[Offer, ...]
    stays: bool
    on_pages: bool


class Notices(QObject):
    """Maintains the notice bar; a notice replaces an earlier one with the same key."""

    def __init__(self, bar: NoticeBar, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._bar = bar
        self._shown: dict[str, _Shown] = {}
        self._on_page = False
        bar.taken.connect(self.take)
        bar.dismissed.connect(self.drop)

    @property
    def notices(self) -> list[Notice]:
        """Return the shown notices."""
        return [
            shown.notice
            for shown in self._shown.values()
            if shown.stays or shown.on_pages or not self._on_page
        ]

    def put(
        self, key: str, text: str, *offers: Offer, stays: bool = False, on_pages: bool = False
    ) -> None:
        """Show a notice, with a button for each offer.

        Parameters
        ----------
        key
            A later notice with the same key replaces this one.
        offers
            Label and action of each button.
        stays
            Whether it outlives the open case, because it does not concern it.
        on_pages
            Whether it is shown on the pages of the record too, though it goes with the open case;
            what stays always is.
        """
        labels = tuple(label for label, _ in offers)
        self._shown[key] = _Shown(Notice(key, text, labels), offers, stays, on_pages)
        self._bar.show_notices(self.notices)

    def hide_of_case(self, hidden: bool) -> None:
        """Hide what concerns the open case while a page of the record takes its place."""
        self._on_page = hidden
        self._bar.show_notices(self.notices)

    def drop(self, key: str) -> None:
        """Remove a notice."""
        if self._shown.pop(key, None) is not None:
            self._bar.show_notices(self.notices)

    def clear(self) -> None:
        """Remove all notices that concern the open case."""
        self._shown = {key: shown for key, shown in self._shown.items() if shown.stays}
        self._bar.show_notices(self.notices)

    def drop_all(self) -> None:
        """Remove all notices."""
        self._shown.clear()
        self._bar.show_notices([])

    def take(self, key: str, number: int = 0) -> None:
        """Remove a notice, and carry out one of its offers."""
        _, run = self._shown[key].offers[number]
        self.drop(key)
        run()


class UserMessages(QObject):
    """Dialogs, the status line, and the questions."""

    def __init__(self, window: QMainWindow, folders: LastFolders | None = None) -> None:
        super().__init__(window)
        self._window = window
        self.questions = Questions(window, folders)
        self.dialogs: list[ErrorDialog] = []

    def say(self, text: str, for_ms: int = _BRIEF_MS) -> None:
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
