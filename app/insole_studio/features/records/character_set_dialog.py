"""The dialog that asks in which character set a table is written."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QRadioButton, QVBoxLayout, QWidget

from insole_core.records.character_sets import Reading
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.message_label import MessageLabel

_WIDTH_PX = 480


class CharacterSetDialog(QDialog):
    """Shows words of the file in every reading; none is chosen until the user has read them."""

    chosen = Signal(str)
    """The codec of the reading."""

    def __init__(
        self, name: str, readings: Sequence[Reading], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Import patients from {name}").format(name=name))
        self.setMinimumWidth(_WIDTH_PX)
        question = MessageLabel()
        question.say(
            tr("The file does not tell how its letters are stored. Which names are right?")
        )
        self.readings: dict[str, QRadioButton] = {}
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addWidget(question)
        for reading in readings:
            words, kind = ", ".join(reading.examples), translate_core_message(reading.name)
            button = QRadioButton(f"{words}   ({kind})".replace("&", "&&"))
            button.toggled.connect(self._allow)
            self.readings[reading.encoding] = button
            layout.addWidget(button)
        buttons = QDialogButtonBox()
        self.read = buttons.addButton(tr("Read it so"), QDialogButtonBox.ButtonRole.AcceptRole)
        self.read.setEnabled(False)
        buttons.addButton(tr("Cancel"), QDialogButtonBox.ButtonRole.RejectRole)
        buttons.accepted.connect(self._choose)
        buttons.rejected.connect(self.reject)
        layout.addWidget(buttons)

    def _allow(self) -> None:
        self.read.setEnabled(True)

    def _choose(self) -> None:
        self.accept()
        self.chosen.emit(next(key for key, button in self.readings.items() if button.isChecked()))
