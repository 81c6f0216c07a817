"""The dialog that shows a scan, and asks what its file does not tell, such as its size."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QCloseEvent, QKeyEvent
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.cases.scan_source import ImportChoice
from insole_core.formats.units import Unit
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.scans.scale import KnownFootLength, KnownShoeSize, KnownSize
from insole_studio.features.import_scan.found_scan import form_options, side_text, unit_options
from insole_studio.scene.point_picker import PointPicker
from insole_studio.scene.pointer import MarkedPoint
from insole_studio.scene.view_camera import Subject
from insole_studio.texts import tr
from insole_studio.widgets.form_parts import ComboBox, mark_labels, plain_button
from insole_studio.widgets.layouts import VerticalScroll
from insole_studio.widgets.message_label import MessageLabel, ProgressBar
from insole_studio.widgets.model_view import ModelView
from insole_studio.widgets.number_field import NumberField
from insole_studio.widgets.side_switch import COLORS
from insole_studio.widgets.single_click_button import SingleClickButton

LENGTH, SHOE, _DISTANCE = "length", "shoe", "distance"
_UNITS: tuple[Unit, ...] = ("mm", "cm", "m", "inch")
_FIELD_PX = 96
_SIZE = (1120, 640)
_FORM_PX = 380
_ROWS = 4
"""Rows that a list shows without scrolling."""


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
            _DISTANCE: _number("mm", 5, 1000, 85.6),
        }
        for key, name in (
            (LENGTH, tr("Length of the foot")),
            (SHOE, tr("Shoe size")),
            (_DISTANCE, tr("Distance of the two points")),
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
        is_distance = self.kind.currentData() == _DISTANCE
        return self.numbers[_DISTANCE].value() if is_distance else None

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
            kind, value = _DISTANCE, known.distance_mm
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
        (_DISTANCE, tr("Two points of known distance")),
    ]


class ImportDialog(QDialog):
    """Shows a scan as it will be read; emits what the user says of it."""

    side_chosen = Signal(object)
    candidate_chosen = Signal(int)
    foot_shown = Signal(int)
    feet_marked = Signal()
    reading_changed = Signal()
    """Another unit, size or form was chosen."""
    unit_chosen = Signal(object)
    point_picked = Signal(object)
    clicks_wanted = Signal(bool)
    click_taken_back = Signal()
    open_wanted = Signal()

    def __init__(self, name: str, dark: bool, parent: QWidget | None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Open the scan {name}").format(name=name))
        self.resize(*_SIZE)
        self.model = ModelView(Subject.FOOT, "", dark)
        self.model.preset_requested.connect(self.model.look_from)
        self.picker = PointPicker(self.point_picked.emit)
        self.model.scene.sink = self.picker
        self.feet = _list(tr("Feet of the scan"))
        self.feet.currentRowChanged.connect(self.foot_shown)
        self.feet.itemChanged.connect(lambda _item: self.feet_marked.emit())
        self.sides = {side: self._side_button(side) for side in Side}
        self.units: dict[Unit, QPushButton] = {}
        self._units = QVBoxLayout()
        self.candidates = _list(tr("How it lies"))
        self.candidates.currentRowChanged.connect(self.candidate_chosen)
        self.clicks = plain_button(tr("Click heel, toes and sole"), self.clicks_wanted)
        self.clicks.setCheckable(True)
        self.take_back = plain_button(tr("Take the last click back"), self.click_taken_back.emit)
        self.size_fields = SizeFields()
        self.size_fields.edited.connect(self.reading_changed)
        self.form = ComboBox(form_options())
        self.form.edited.connect(lambda _form: self.reading_changed.emit())
        self.finding, self.hint = MessageLabel("heading"), MessageLabel()
        self.doubts = MessageLabel("warning")
        self.why_not = MessageLabel()
        self.notes = MessageLabel("quiet")
        self.progress = ProgressBar()
        self.buttons = QDialogButtonBox()
        self.open_button = SingleClickButton(tr("Open"))
        self.buttons.addButton(self.open_button, QDialogButtonBox.ButtonRole.AcceptRole)
        leave = self.buttons.addButton(tr("Do not open"), QDialogButtonBox.ButtonRole.RejectRole)
        leave.setAutoDefault(False)  # else Enter leaves while Open cannot be pressed
        self.buttons.accepted.connect(self.open_wanted)
        self.buttons.rejected.connect(self.reject)
        self._lay_out()
        self.open_button.setDefault(True)  # which counts only once it is in the dialog
        self.open_button.setFocus()
        self.finished.connect(self._close_scene)

    def show_reading(self, choice: ImportChoice) -> None:
        """Show with which size and form the scan is read."""
        self.size_fields.show_size(choice.unit, choice.known_size)
        self.form.show_value("" if choice.form is None else choice.form.value)

    def show_units(self, rows: Mapping[Unit, str]) -> None:
        """Ask for the unit of the file by what each would give; nothing is asked without rows."""
        for button in self.units.values():
            self._units.removeWidget(button)
            button.deleteLater()
        self.units = {unit: self._unit_button(unit, text) for unit, text in rows.items()}
        for button in self.units.values():
            self._units.addWidget(button)

    def show_surface(self, mesh: TriangleMesh | None, *, anew: bool) -> None:
        """Show the scan as it would lie.

        Parameters
        ----------
        mesh : mm, insole frame
            None where the scan has no size yet.
        anew
            Whether the camera is to show the whole of it.
        """
        self.clicks.setEnabled(mesh is not None)
        if mesh is None:
            self.model.show_empty(tr("Choose the unit of the file, or a length that is known."), {})
            return
        self.model.show_mesh(mesh)
        if anew:
            self.model.look_at_whole(mesh.bounds_mm)

    def show_side(
        self, side: Side | None, mesh: TriangleMesh | None, *, can_be_chosen: bool
    ) -> None:
        """Show which foot it is, with the anatomical directions; None where that is open."""
        for one, button in self.sides.items():
            button.setVisible(can_be_chosen)
            with QSignalBlocker(button):
                button.setChecked(one is side)
            button.setStyleSheet(_chosen_style(one) if one is side else "")
        self.model.show_side(side)
        if side is not None and mesh is not None:
            self.model.show_directions(side, mesh.bounds_mm)

    def show_feet(self, rows: Sequence[str], shown: int, unmarked: int | None = None) -> None:
        """List the feet of a scan; the list hides where there is only one.

        Parameters
        ----------
        unmarked
            One that is not marked when it appears.
        """
        self.feet.setVisible(len(rows) > 1)
        with QSignalBlocker(self.feet):
            while self.feet.count() > len(rows):
                self.feet.takeItem(self.feet.count() - 1)
            while self.feet.count() < len(rows):
                item = QListWidgetItem(self.feet)
                item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable)
                is_marked = self.feet.count() - 1 != unmarked
                item.setCheckState(Qt.CheckState.Checked if is_marked else Qt.CheckState.Unchecked)
            for number, text in enumerate(rows):
                self.feet.item(number).setText(text)
            self.feet.setCurrentRow(shown)
        _fit(self.feet)

    def is_marked(self, number: int) -> bool:
        """Return whether a foot of the list is to be opened."""
        item = self.feet.item(number)
        return item.checkState() is Qt.CheckState.Checked

    def show_candidates(self, rows: Sequence[str], chosen: int) -> None:
        """List the ways in which the scan can be a foot; the list hides where there is one."""
        self.candidates.setVisible(len(rows) > 1)
        with QSignalBlocker(self.candidates):
            self.candidates.clear()
            self.candidates.addItems(list(rows))
            self.candidates.setCurrentRow(chosen)
        _fit(self.candidates)

    def show_clicks(self, hint: str, points: Sequence[MarkedPoint], *, is_on: bool) -> None:
        """Show the clicked points, and say which comes next; an empty hint says nothing."""
        self.picker.is_on = is_on
        with QSignalBlocker(self.clicks):
            self.clicks.setChecked(is_on)
        self.take_back.setVisible(is_on and bool(points))
        self.hint.say(hint)
        if self.model.scene.is_open:
            self.model.show_key_points(points)

    def show_opening(
        self, text: str, *, is_enabled: bool, insists: bool, why_not: str = ""
    ) -> None:
        """Name the button that opens; say whether it can be pressed, and what hinders it.

        Parameters
        ----------
        insists
            Whether it opens against what was told: then Enter does not press it.
        """
        self.open_button.setText(text)
        self.open_button.setDefault(not insists)
        self.open_button.setAutoDefault(not insists)
        self.open_button.setEnabled(is_enabled)
        self.why_not.say(why_not)

    def reject(self) -> None:
        """Give up clicking first, as Escape does everywhere; then the scan."""
        if self.picker.is_on:
            self.clicks_wanted.emit(False)
        else:
            super().reject()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Leave without opening, whatever is being clicked."""
        self.picker.is_on = False
        super().closeEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Take the last click back with Backspace."""
        if event.key() == Qt.Key.Key_Backspace and self.picker.is_on:
            self.click_taken_back.emit()
        else:
            super().keyPressEvent(event)

    def _unit_button(self, unit: Unit, text: str) -> QPushButton:
        return plain_button(text, lambda: self.unit_chosen.emit(unit))

    def _side_button(self, side: Side) -> QPushButton:
        button = plain_button(side_text(side), lambda: self.side_chosen.emit(side))
        button.setCheckable(True)
        return button

    def _lay_out(self) -> None:
        sides = QHBoxLayout()
        for button in self.sides.values():
            sides.addWidget(button)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Unit or size"), self.size_fields)
        form.addRow(tr("The scan shows"), self.form)
        mark_labels(form)
        column = QVBoxLayout()
        column.setSpacing(8)
        column.addWidget(self.finding)
        column.addWidget(self.doubts)
        column.addLayout(self._units)
        column.addWidget(self.feet)
        column.addLayout(sides)
        column.addWidget(self.why_not)
        column.addWidget(self.candidates)
        for part in (self.clicks, self.hint, self.take_back):
            column.addWidget(part)
        column.addLayout(form)
        column.addWidget(self.notes)
        column.addStretch(1)
        inner = QWidget()
        inner.setLayout(column)
        scroll = VerticalScroll()
        scroll.setWidget(inner)
        scroll.setFixedWidth(_FORM_PX)
        body = QHBoxLayout()
        body.addWidget(self.model, 1)
        body.addWidget(scroll)
        layout = QVBoxLayout(self)
        layout.addLayout(body, 1)
        layout.addWidget(self.progress)
        layout.addWidget(self.buttons)

    def _close_scene(self) -> None:
        self.model.scene.close_scene()


def _chosen_style(side: Side) -> str:
    return f"background: {COLORS[side]}; color: white; font-weight: 600;"


def _list(name: str) -> QListWidget:
    rows = QListWidget()
    rows.setAccessibleName(name)
    rows.setToolTip(name)
    rows.hide()
    return rows


def _fit(rows: QListWidget) -> None:
    """Make a list as high as its rows, up to a few."""
    shown = max(1, min(rows.count(), _ROWS))
    rows.setFixedHeight(shown * rows.sizeHintForRow(0) + 2 * rows.frameWidth())
