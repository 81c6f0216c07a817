"""The parameters panel: the numbers of what is selected, and those of the insole."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from insole_studio.stages.design.rows import ChoiceSpec, FieldGroup, FieldSpec
from insole_studio.widgets.choice import Choice
from insole_studio.widgets.flow import FlowLayout
from insole_studio.widgets.number_field import NumberField

ROWS = 2
ROW_HEIGHT_PX = 26
FIELD_PX = 96
SHORT_TEXT, SHORT_PX = 3, 44
CHOICE_PX = 132
LEAST_PX, MOST_PX = 112, 176


class ParametersView(QScrollArea):
    """Lays out groups of number fields beside each other, in lines as wide as the panel."""

    field_edited = Signal(str, object)
    offer_chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._shape: tuple[object, ...] = ()
        self._fields: dict[str, NumberField | Choice] = {}
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setMinimumHeight(LEAST_PX)

    def show_groups(self, groups: Sequence[FieldGroup]) -> None:
        """Show groups; while only values differ, the fields stay where they are."""
        shape = tuple(group.shape for group in groups)
        if shape != self._shape:
            self._shape = shape
            self._lay_out(groups)
        for group in groups:
            for spec in group.fields:
                self._show_value(spec)

    def _show_value(self, spec: FieldSpec | ChoiceSpec) -> None:
        field = self._fields[spec.key]
        if isinstance(field, NumberField):
            assert isinstance(spec, FieldSpec)
            field.show_value(spec.value)
        else:
            field.show_value(str(spec.value))

    def _lay_out(self, groups: Sequence[FieldGroup]) -> None:
        self._fields = {}
        content = QWidget()
        flow = FlowLayout(content, margin_px=8, gap_px=16)
        for group in groups:
            flow.addWidget(self._group(group))
        self.setWidget(content)
        # The first line is always whole, also with targets for fingers.
        self.setMinimumHeight(min(max(flow.minimumSize().height(), LEAST_PX), MOST_PX))

    def _group(self, group: FieldGroup) -> QWidget:
        widget = QWidget()
        column = QVBoxLayout(widget)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        for text, name in ((group.title, "heading"), (group.note, "quiet")):
            if text:
                label = QLabel(text)
                label.setObjectName(name)
                column.addWidget(label)
        grid = QGridLayout()
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(4)
        for row in range(ROWS):
            grid.setRowMinimumHeight(row, ROW_HEIGHT_PX)
        self._add_offers(grid, group)
        before = _columns(group)
        for number, spec in enumerate(group.fields):
            self._add_field(grid, spec, number, before)
        column.addLayout(grid)
        column.addStretch(1)
        return widget

    def _add_field(
        self, grid: QGridLayout, spec: FieldSpec | ChoiceSpec, number: int, before: int
    ) -> None:
        field = _make_field(spec)
        field.setProperty("key", spec.key)
        field.setAccessibleName(spec.label)
        field.setFixedWidth(CHOICE_PX if isinstance(spec, ChoiceSpec) else FIELD_PX)
        field.edited.connect(self._edited)
        self._fields[spec.key] = field
        label = QLabel(spec.label)
        label.setBuddy(field)
        label.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        row, column = number % ROWS, before + 2 * (number // ROWS)
        grid.addWidget(label, row, column)
        grid.addWidget(field, row, column + 1)

    def _add_offers(self, grid: QGridLayout, group: FieldGroup) -> None:
        cells = [(row, column) for row in range(ROWS) for column in range(_columns(group))]
        if group.caption:
            grid.addWidget(QLabel(group.caption), *cells.pop(0))
        for offer, cell in zip(group.offers, cells, strict=False):
            button = QPushButton(offer.text)
            button.setToolTip(offer.tip)
            button.setAccessibleName(offer.tip or offer.text)
            button.setProperty("offer", offer.key)
            if len(offer.text) <= SHORT_TEXT:
                button.setFixedWidth(SHORT_PX)
            button.clicked.connect(self._choose)
            grid.addWidget(button, *cell)

    def _edited(self, value: object) -> None:
        self.field_edited.emit(self.sender().property("key"), value)

    def _choose(self) -> None:
        self.offer_chosen.emit(self.sender().property("offer"))


def _columns(group: FieldGroup) -> int:
    """How many columns the offers take before the fields."""
    return (len(group.offers) + bool(group.caption) + ROWS - 1) // ROWS


def _make_field(spec: FieldSpec | ChoiceSpec) -> NumberField | Choice:
    if isinstance(spec, ChoiceSpec):
        return Choice(spec.options)
    return NumberField(
        spec.unit,
        least=spec.least,
        greatest=spec.greatest,
        step=spec.step,
        decimals=spec.decimals,
    )
