"""What a stage says beside its controls: sentences that hide while empty, and how far work is."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QProgressBar

from insole_studio.texts import translate_core_message


class MessageLabel(QLabel):
    """Sentences below each other; nothing is shown while there are none.

    Parameters
    ----------
    style
        How the theme draws it: "warning", "quiet" or plain.
    """

    def __init__(self, style: str = "") -> None:
        super().__init__()
        self.setObjectName(style)
        self.setWordWrap(True)
        self.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.hide()

    def say(self, sentence: str) -> None:
        """Show one sentence; an empty one hides it."""
        self.say_all([sentence] if sentence else [])

    def say_all(self, sentences: Sequence[str]) -> None:
        """Show sentences in the language of the window, each from a capital on."""
        said = map(translate_core_message, sentences)
        self.setText("\n".join(sentence[:1].upper() + sentence[1:] for sentence in said))
        self.setVisible(bool(sentences))


class ProgressBar(QProgressBar):
    """How far a long work is, and what is being done; hidden while there is none."""

    def __init__(self) -> None:
        super().__init__()
        self.setRange(0, 100)
        self.hide()

    def show_work(self, fraction: float, text: str) -> None:
        """Show the work; an empty text ends it."""
        self.setVisible(bool(text))
        self.setValue(round(100 * fraction))
        self.setFormat(translate_core_message(text))
