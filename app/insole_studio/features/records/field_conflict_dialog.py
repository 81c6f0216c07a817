"""Fields that were changed here and at another station: both values side by side."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QButtonGroup,
    QDialog,
    QDialogButtonBox,
    QGridLayout,
    QLabel,
    QRadioButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.records.record_field import FieldChoice, Lines, Typed
from insole_studio.features.records.record_texts import shown_message
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.vertical_scroll import VerticalScroll

_SIZE: Final = (760, 360)


@dataclass(frozen=True)
class CollidedField:
    """A field with two values.

    Parameters
    ----------
    label
        What it is called.
    is_joinable
        Whether both values can be kept, one below the other.
    """

    name: str
    label: str
    mine: str
    theirs: str
    is_joinable: bool = False


AskFields: TypeAlias = Callable[
    [Sequence[CollidedField], Callable[[Mapping[str, FieldChoice]], None]], None
]
"""Asks about fields, and calls a function with the choice for each."""


def collided_fields(
    mine: Any, theirs: Any, names: Sequence[str], fields: Mapping[str, Typed]
) -> list[CollidedField]:
    """Return some fields of two persons, visits or patients as they are shown."""
    return [
        CollidedField(
            name,
            translate_core_message(fields[name].label),
            shown_message(fields[name].said(getattr(mine, name))),
            shown_message(fields[name].said(getattr(theirs, name))),
            isinstance(fields[name], Lines),
        )
        for name in names
    ]


class FieldConflictDialog(QDialog):
    """Shows both values of each field; closed without a choice, theirs stay as they are."""

    def __init__(self, fields: Sequence[CollidedField], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Two versions of the same fields"))
        self.resize(*_SIZE)
        self._fields = fields
        self._groups: dict[str, QButtonGroup] = {}
        self.choice_buttons: dict[tuple[str, FieldChoice], QRadioButton] = {}
        sentence = QLabel(
            tr(
                "Somebody else has changed the same fields while you worked on them. Choose which "
                "value counts; all others of your changes are stored."
            )
        )
        sentence.setWordWrap(True)
        content = QWidget()
        grid = QGridLayout(content)
        grid.setHorizontalSpacing(24)
        grid.setVerticalSpacing(12)
        for column in (1, 2):
            grid.setColumnStretch(column, 1)
        for number, field in enumerate(fields):
            self._add(grid, 2 * number, field)
        grid.setRowStretch(grid.rowCount(), 1)
        scroll = VerticalScroll()
        scroll.setWidget(content)
        buttons = QDialogButtonBox()
        self.store = buttons.addButton(tr("Store"), QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.addButton(tr("Keep theirs"), QDialogButtonBox.ButtonRole.RejectRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setSpacing(12)
        for part in (sentence, scroll, buttons):
            layout.addWidget(part, 1 if part is scroll else 0)

    @property
    def choices(self) -> dict[str, FieldChoice]:
        """What was chosen for each field."""
        if self.result() != QDialog.DialogCode.Accepted:
            return {field.name: FieldChoice.THEIRS for field in self._fields}
        return {
            name: choice for (name, choice), radio in self.choice_buttons.items()
            if radio.isChecked()
        }  # fmt: skip

    def _add(self, grid: QGridLayout, row: int, field: CollidedField) -> None:
        name = QLabel(field.label)
        name.setObjectName("numbers")
        grid.addWidget(name, row, 0, Qt.AlignmentFlag.AlignTop)
        group = self._groups[field.name] = QButtonGroup(self)
        for column, choice, value in (
            (1, FieldChoice.MINE, field.mine),
            (2, FieldChoice.THEIRS, field.theirs),
        ):
            cell = QVBoxLayout()
            cell.setSpacing(4)
            text = tr("My value") if choice is FieldChoice.MINE else tr("Their value")
            cell.addWidget(self._radio(group, field, choice, text))
            cell.addWidget(_value_label(value))
            grid.addLayout(cell, row, column, Qt.AlignmentFlag.AlignTop)
        if field.is_joinable:
            both = self._radio(group, field, FieldChoice.BOTH, tr("Both, one below the other"))
            grid.addWidget(both, row + 1, 1, 1, 2)
        preselected = FieldChoice.BOTH if field.is_joinable else FieldChoice.MINE
        self.choice_buttons[field.name, preselected].setChecked(True)

    def _radio(
        self, group: QButtonGroup, field: CollidedField, choice: FieldChoice, text: str
    ) -> QRadioButton:
        radio = QRadioButton(text)
        radio.setAccessibleName(f"{field.label}: {text}")
        group.addButton(radio)
        self.choice_buttons[field.name, choice] = radio
        return radio


def _value_label(value: str) -> QLabel:
    label = QLabel(value or "–")
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setWordWrap(True)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return label
