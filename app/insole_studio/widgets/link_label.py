"""Words that lead somewhere."""

from __future__ import annotations

from html import escape

from PySide6.QtCore import QEvent, Qt
from PySide6.QtWidgets import QLabel


class LinkLabel(QLabel):
    """A link by mouse and by keys, in the colour of plain text, whatever the theme.

    Rich text knows no inherited colour: it would be black on dark ground.

    Parameters
    ----------
    words
    target
        What `linkActivated` tells.
    underlined
    """

    def __init__(self, words: str, target: str, underlined: bool = True) -> None:
        super().__init__()
        self._words, self._target = words, target
        self._decoration = "underline" if underlined else "none"
        self.setWordWrap(True)
        by = Qt.TextInteractionFlag
        self.setTextInteractionFlags(by.LinksAccessibleByMouse | by.LinksAccessibleByKeyboard)
        self._write()

    def changeEvent(self, event: QEvent) -> None:
        """Follow the theme."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange:
            self._write()

    def _write(self) -> None:
        color = self.palette().color(self.foregroundRole()).name()
        style = f"color: {color}; text-decoration: {self._decoration}"
        self.setText(f'<a href="{escape(self._target)}" style="{style}">{escape(self._words)}</a>')
