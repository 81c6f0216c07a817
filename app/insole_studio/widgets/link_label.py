"""A clickable text."""

from __future__ import annotations

from html import escape

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QLabel


class LinkLabel(QLabel):
    """A link for mouse and keyboard, in the theme's colour of plain text.

    Rich text does not inherit its colour: without this it would be black on a dark background.

    Parameters
    ----------
    words
        The text of the link.
    target
        Argument of `linkActivated`.
    underlined
        Whether to underline the text.
    """

    def __init__(self, words: str, target: str, underlined: bool = True) -> None:
        super().__init__()
        self._words, self._target = words, target
        self._decoration = "underline" if underlined else "none"
        self.setTextFormat(Qt.TextFormat.RichText)
        self.setWordWrap(True)
        by = Qt.TextInteractionFlag
        self.setTextInteractionFlags(by.LinksAccessibleByMouse | by.LinksAccessibleByKeyboard)
        self._write()

    def changeEvent(self, event: QEvent) -> None:
        """Follow changes of the theme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._write()

    def _write(self) -> None:
        color = self.palette().color(self.foregroundRole()).name()
        style = f"color: {color}; text-decoration: {self._decoration}"
        self.setText(f'<a href="{escape(self._target)}" style="{style}">{escape(self._words)}</a>')
