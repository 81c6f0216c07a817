"""The variants of the prescription: the chosen one, and actions on it."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QToolButton, QWidget

from insole_studio.document.case_names import variant_title
from insole_studio.texts import tr
from insole_studio.widgets.elided_fields import ElidedComboBox
from insole_studio.widgets.icons import icon


class VariantRow(QWidget):
    """A list of variants with buttons that run actions of the window."""

    chosen = Signal(str)
    action_requested = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.names = ElidedComboBox()
        self.names.setSizeAdjustPolicy(
            QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.names.setMinimumContentsLength(8)
        self.names.setAccessibleName(tr("Variant"))
        self.names.setToolTip(tr("The variant that is shown, checked and made"))
        self.names.activated.connect(self._choose)
        self._duplicate = self._button("variant_duplicate", "copy", tr("Duplicate as a variant"))
        self._name = self._button("variant_name", "name", tr("Name the variant…"))
        self._delete = self._button("variant_delete", "remove", tr("Delete the variant"))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(2)
        row.addWidget(self.names, 1)
        for button in (self._duplicate, self._name, self._delete):
            row.addWidget(button)

    def show_variants(self, names: Sequence[str], chosen: str) -> None:
        """Show all names, and select the chosen one."""
        with QSignalBlocker(self.names):
            self.names.clear()
            for name in names:
                self.names.addItem(variant_title(name), name)
            self.names.setCurrentIndex(self.names.findData(chosen))
        self.setEnabled(bool(names))
        self._delete.setEnabled(len(names) > 1)

    def renew_icons(self) -> None:
        """Redraw the icons in the colours of the palette."""
        for button in (self._duplicate, self._name, self._delete):
            button.setIcon(icon(button.property("icon_name")))

    def _button(self, action: str, icon_name: str, tip: str) -> QToolButton:
        button = QToolButton()
        button.setIcon(icon(icon_name))
        button.setAutoRaise(True)
        button.setToolTip(tip)
        button.setAccessibleName(tip)
        button.setProperty("action", action)
        button.setProperty("icon_name", icon_name)
        button.clicked.connect(self._request)
        return button

    def _choose(self, place: int) -> None:
        self.chosen.emit(self.names.itemData(place))

    def _request(self) -> None:
        self.action_requested.emit(self.sender().property("action"))
