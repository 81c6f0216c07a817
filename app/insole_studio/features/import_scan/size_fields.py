"""Fields for the size of a scan: its unit, or a length that is known."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QWidget

from insole_core.scans.mesh_file import Unit
from insole_core.scans.scale import KnownFootLength, KnownShoeSize, KnownSize
from insole_studio.features.import_scan.scan_texts import unit_options
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.number_field import NumberField

LENGTH, SHOE, DISTANCE = "length", "shoe", "distance"
_UNITS: tuple[Unit, ...] = ("mm", "cm", "m", "inch")
_FIELD_PX = 96


class SizeFields(QWidget):
    """A unit, or what is known in its place with its number."""

    edited = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.kind = ComboBox(_kinds())
        self.kind.setAccessibleName(tr("Unit of the file"))
        self.numbers = {
            LENGTH: _number("mm", 80, 350, 250),
            SHOE: _number("EU", 15, 55, 40),
            DISTANCE: _number("mm", 5, 1000, 85.6),
        }
        for key, name in (
            (LENGTH, tr("Length of the foot")),
            (SHOE, tr("Shoe size")),
            (DISTANCE, tr("Distance of the two points")),
        ):
            self.numbers[key].setAccessibleName(name)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.kind, 1)
        for field in self.numbers.values():
            field.edited.connect(self.edited)
            row.addWidget(field)
        self.kind.edited.connect(self._choose)
        self._show_number()

    @property
    def unit(self) -> Unit | None:
        """The unit; None where it is to be concluded, or something else is known."""
        return next((unit for unit in _UNITS if unit == self.kind.currentData()), None)

    @property
    def known(self) -> KnownFootLength | KnownShoeSize | None:
        """The length of the foot or its shoe size, if that is what is known."""
        kind = self.kind.currentData()
        if kind == LENGTH:
            return KnownFootLength(self.numbers[LENGTH].value())
        if kind == SHOE:
            return KnownShoeSize(self.numbers[SHOE].value())
        return None

    @property
    def distance_mm(self) -> float | None:
        """The distance of two points that are clicked, if that is what is known."""
        is_distance = self.kind.currentData() == DISTANCE
        return self.numbers[DISTANCE].value() if is_distance else None

    @property
    def said(self) -> tuple[object, ...]:
        """All that is chosen and typed here, to see whether it has changed."""
        return self.unit, self.known, self.distance_mm

    def show_size(self, unit: Unit | None, known: KnownSize | None) -> None:
        """Show a unit, or what is known in its place, without emitting `edited`."""
        kind: str = unit or ""
        value = 0.0
        if isinstance(known, KnownFootLength):
            kind, value = LENGTH, known.length_mm
        elif isinstance(known, KnownShoeSize):
            kind, value = SHOE, known.size_eu
        elif known is not None:
            kind, value = DISTANCE, known.distance_mm
        self.kind.show_value(kind)
        if kind in self.numbers:
            self.numbers[kind].show_value(value)
        self._show_number()

    def _choose(self, _kind: str) -> None:
        self._show_number()
        self.edited.emit()

    def _show_number(self) -> None:
        for key, field in self.numbers.items():
            field.setVisible(key == self.kind.currentData())


def _number(unit: str, least: float, greatest: float, value: float) -> NumberField:
    field = NumberField(unit, least=least, greatest=greatest, step=1.0)
    field.set_room(_FIELD_PX)
    field.show_value(value)
    return field


def _kinds() -> list[tuple[str, str]]:
    return [
        ("", tr("As the size tells")),
        *unit_options(),
        (LENGTH, tr("The foot's length is known")),
        (SHOE, tr("The shoe size is known")),
        (DISTANCE, tr("Two points of known distance")),
    ]
