"""A dialog that asks for several lines of text at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLabel,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from insole_studio.texts import tr
from insole_studio.widgets.form_labels import mark_labels

_WIDTH_PX = 460


@dataclass(frozen=True)
class Field:
    """One line of text.

    Parameters
    ----------
    value
        The initial text.
    required
        Whether the dialog can only be accepted with a text here.
    """

    key: str
    label: str
    value: str = ""
    required: bool = True


class FieldsDialog(QDialog):
    """A form of lines; it can be accepted once every required one is filled in."""

    def __init__(
        self, title: str, sentence: str, fields: Sequence[Field], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.setMinimumWidth(_WIDTH_PX)
        self.lines = {field.key: QLineEdit(field.value) for field in fields}
        self._required = [field.key for field in fields if field.required]
        words = QLabel(sentence)
        words.setWordWrap(True)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        for field in fields:
            form.addRow(field.label, self.lines[field.key])
            self.lines[field.key].textChanged.connect(self._allow)
        mark_labels(form)
        self.buttons = QDialogButtonBox()
        self.accept_button = self.buttons.addButton(
            tr("Use these"), QDialogButtonBox.ButtonRole.AcceptRole
        )
        self.buttons.addButton(tr("Cancel"), QDialogButtonBox.ButtonRole.RejectRole)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        for part in (words, form, self.buttons):
            if isinstance(part, QFormLayout):
                layout.addLayout(part)
            else:
                layout.addWidget(part)
        self._allow()
        self._focus_first_gap()

    def texts(self) -> dict[str, str]:
        """Return the texts by key."""
        return {key: line.text().strip() for key, line in self.lines.items()}

    def _allow(self) -> None:
        texts = self.texts()
        self.accept_button.setEnabled(all(texts[key] for key in self._required))

    def _focus_first_gap(self) -> None:
        gaps = [key for key in self._required if not self.lines[key].text()]
        if gaps:
            self.lines[gaps[0]].setFocus()
