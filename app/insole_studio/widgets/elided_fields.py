"""Buttons and choices whose texts end in "…" where they have no room; Qt's cut a letter in two."""

from __future__ import annotations

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QComboBox,
    QPushButton,
    QSizePolicy,
    QStyle,
    QStyleOption,
    QStyleOptionButton,
    QStyleOptionComboBox,
    QWidget,
)

_HELD = (
    Qt.KeyboardModifier.AltModifier
    | Qt.KeyboardModifier.ControlModifier
    | Qt.KeyboardModifier.MetaModifier
)


class ElidedButton(QPushButton):
    """A flat button that is as wide as there is room."""

    def __init__(self, text: str = "", parent: QWidget | None = None) -> None:
        super().__init__(text, parent)
        self.setFlat(True)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)

    def initStyleOption(self, option: QStyleOptionButton) -> None:
        """Draw as much of the text as has room."""
        super().initStyleOption(option)
        room = QStyle.SubElement.SE_PushButtonContents
        option.text = _elided(option, option.text, self.style().subElementRect(room, option, self))


class ElidedComboBox(QComboBox):
    """A combo box of a width that its texts may exceed."""

    def initStyleOption(self, option: QStyleOptionComboBox) -> None:
        """Draw as much of the chosen text as has room."""
        super().initStyleOption(option)
        room = self.style().subControlRect(
            QStyle.ComplexControl.CC_ComboBox,
            option,
            QStyle.SubControl.SC_ComboBoxEditField,
            self,
        )
        option.currentText = _elided(option, option.currentText, room)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leave letters with Alt or Ctrl to menus; Qt's goes to a text that begins with them."""
        if event.text() and event.modifiers() & _HELD:
            event.ignore()
        else:
            super().keyPressEvent(event)


def _elided(option: QStyleOption, text: str, room: QRect) -> str:
    """Return as much of a text as has room in a place; a pixel is left free at each end."""
    return option.fontMetrics.elidedText(text, Qt.TextElideMode.ElideRight, room.width() - 2)
