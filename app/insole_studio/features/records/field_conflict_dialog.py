"""Fields that were changed here and at another station: both values side by side."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import date
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

from insole_core.records.field_merge import FieldChoice
from insole_studio.texts import localised, tr
from insole_studio.widgets.vertical_scroll import VerticalScroll

VISIT_FIELDS: Final = ("visited_on", "reason", "findings", "weight_kg", "shoe_size_eu")
_TEXTS: Final = ("contact", "notes", "findings")
"""Fields of several lines, of which both values can be kept."""
_SIZE: Final = (760, 360)


@dataclass(frozen=True)
class CollidedField:
    """A field with two values."""

    name: str
    mine: str
    theirs: str


AskFields: TypeAlias = Callable[
    [Sequence[CollidedField], Callable[[Mapping[str, FieldChoice]], None]], None
]
"""Asks about fields, and calls a function with the choice for each."""


def collided_fields(mine: Any, theirs: Any, names: Sequence[str]) -> list[CollidedField]:
    """Return some fields of two persons or visits as they are shown."""
    return [CollidedField(n, _shown(getattr(mine, n)), _shown(getattr(theirs, n))) for n in names]


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
        name = QLabel(field_label(field.name))
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
        if field.name in _TEXTS:
            both = self._radio(group, field, FieldChoice.BOTH, tr("Both, one below the other"))
            grid.addWidget(both, row + 1, 1, 1, 2)
        preselected = FieldChoice.BOTH if field.name in _TEXTS else FieldChoice.MINE
        self.choice_buttons[field.name, preselected].setChecked(True)

    def _radio(
        self, group: QButtonGroup, field: CollidedField, choice: FieldChoice, text: str
    ) -> QRadioButton:
        radio = QRadioButton(text)
        radio.setAccessibleName(f"{field_label(field.name)}: {text}")
        group.addButton(radio)
        self.choice_buttons[field.name, choice] = radio
        return radio


def field_label(name: str) -> str:
    """Return what a field of a person or visit is called."""
    return {
        "name": tr("Name"),
        "birth_date": tr("Born"),
        "born": tr("Born"),
        "personal_number": tr("Personal number"),
        "number_kind": tr("Kind of personal number"),
        "contact": tr("Address, phone"),
        "consent_on": tr("Consent on"),
        "pseudonym": tr("Pseudonym"),
        "notes": tr("Notes"),
        "visit": tr("Day"),
        "visited_on": tr("Day"),
        "reason": tr("Reason"),
        "findings": tr("Findings"),
        "weight_kg": tr("Weight (kg)"),
        "shoe_size_eu": tr("Shoe size EU"),
    }[name]


def _value_label(value: str) -> QLabel:
    label = QLabel(value or "–")
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setWordWrap(True)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return label


def _shown(value: object) -> str:
    if isinstance(value, date):
        return value.isoformat()
    if isinstance(value, float):
        return localised(value, "g")
    return "" if value is None else str(value)
