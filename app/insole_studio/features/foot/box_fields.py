"""The volume of interest as numbers: its limits along each axis."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QPushButton, QWidget

from insole_core.recording.box import Box
from insole_studio.features.foot.box_dragger import LEAST_MM
from insole_studio.texts import tr
from insole_studio.widgets.number_field import NumberField

_FARTHEST_MM = 600.0
_FIELD_PX = 88


class BoxFields(QWidget):
    """Fields for the six limits of the box, mm, reference frame."""

    edited = Signal(object)
    reset_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(4)
        grid.addWidget(QLabel(tr("from")), 0, 1)
        grid.addWidget(QLabel(tr("to")), 0, 2)
        self._fields: list[tuple[NumberField, NumberField]] = []
        for row, text in enumerate((tr("Across"), tr("Along the foot"), tr("Height")), start=1):
            grid.addWidget(QLabel(text), row, 0)
            pair = (_field(f"{text}, {tr('from')}"), _field(f"{text}, {tr('to')}"))
            self._fields.append(pair)
            for column, field in enumerate(pair, start=1):
                grid.addWidget(field, row, column)
                field.edited.connect(self._edit)
        self.reset = QPushButton(tr("As recorded"))
        self.reset.clicked.connect(self.reset_requested)
        grid.addWidget(self.reset, 4, 1, 1, 2)
        grid.setColumnStretch(1, 1)
        grid.setColumnStretch(2, 1)

    def show_box(self, box: Box) -> None:
        """Show a box."""
        for (low, high), least, greatest in zip(self._fields, box.min_mm, box.max_mm, strict=True):
            low.show_value(least)
            high.show_value(greatest)

    def box(self) -> Box:
        """Return the box entered in the fields, at least as large as dragging allows."""
        lows = [low.value() for low, _ in self._fields]
        highs = [max(high.value(), low.value() + LEAST_MM) for low, high in self._fields]
        return Box((lows[0], lows[1], lows[2]), (highs[0], highs[1], highs[2]))

    def _edit(self, _value: float) -> None:
        self.edited.emit(self.box())


def _field(name: str) -> NumberField:
    field = NumberField("mm", least=-_FARTHEST_MM, greatest=_FARTHEST_MM, step=5.0, decimals=0)
    field.setAccessibleName(name)
    field.setToolTip(tr("What lies outside this box is no part of the foot"))
    field.set_room(_FIELD_PX)
    return field
