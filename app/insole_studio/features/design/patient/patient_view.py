"""The patient panel: fields of the case, measures, and the list of corrections."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Signal
from PySide6.QtWidgets import (
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QPushButton,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.geometry.side import Side
from insole_studio.features.design.patient.measure_grid import MeasureGrid
from insole_studio.features.design.patient.variant_row import VariantRow
from insole_studio.features.design.rows import CorrectionRow, Measure, WarningRow
from insole_studio.texts import tr
from insole_studio.widgets.date_field import DateField
from insole_studio.widgets.elided_fields import ElidedButton
from insole_studio.widgets.form_parts import LinkLabel, mark_labels
from insole_studio.widgets.icons import icon
from insole_studio.widgets.layouts import VerticalScroll, remove_widgets
from insole_studio.widgets.side_switch import SideSwitch, side_letter
from insole_studio.widgets.text_fields import (
    NotesField,
    ValidationBubble,
    forget_typed,
    show_unless_typing,
)

LEAST_PX = 216


class PatientView(VerticalScroll):
    """The patient panel."""

    field_edited = Signal(str, str)
    side_chosen = Signal(object)
    variant_chosen = Signal(str)
    action_requested = Signal(str)
    device_selected = Signal()
    correction_selected = Signal(str)
    correction_toggled = Signal(str)
    correction_removed = Signal(str)
    correction_moved = Signal(str, int)
    correction_copied = Signal(str)
    warning_chosen = Signal(int)
    measure_chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._fields = {"name": QLineEdit(), "born": DateField(), "visit": DateField()}
        for key, field in self._fields.items():
            field.setProperty("key", key)
            field.editingFinished.connect(self._line_edited)
        self._refusals = {key: ValidationBubble(field) for key, field in self._fields.items()}
        self._notes = NotesField()
        self._typed_fields: dict[str, QLineEdit | QPlainTextEdit] = {
            **self._fields,
            "notes": self._notes,
        }
        self._notes.left.connect(self._notes_edited)
        self.sides = SideSwitch()
        self.sides.chosen.connect(self.side_chosen)
        self.sides.action_requested.connect(self.action_requested)
        self._no_side = QLabel(tr("comes with the scan"))
        self._no_side.setObjectName("quiet")
        self._later = QLabel(tr("Corrections and measures come with the scan."))
        self._later.setObjectName("quiet")
        self._later.setWordWrap(True)
        self._of_foot = QWidget()
        """The widgets shown only with a foot: corrections, warnings, measures."""
        self.variants = VariantRow()
        self.variants.chosen.connect(self.variant_chosen)
        self.variants.action_requested.connect(self.action_requested)
        self._measures = MeasureGrid()
        self._measures.chosen.connect(self.measure_chosen)
        self._device = ElidedButton()
        self._device.setObjectName("row")
        self._device.setCheckable(True)
        self._device.clicked.connect(self._select_device)
        self._rows: list[CorrectionRow] | None = None
        self._corrections = QVBoxLayout()
        self._corrections.setSpacing(2)
        self._warned: list[WarningRow] = []
        self._count = QPushButton()
        self._count.setObjectName("warning_count")
        self._count.setToolTip(tr("Show all warnings"))
        self._count.clicked.connect(self._show_all_warnings)
        self._count.hide()
        self._warnings = QVBoxLayout()
        self._warnings.setSpacing(4)
        self.setWidget(self._content())

    def minimumSizeHint(self) -> QSize:
        """Return a minimum width, whatever the content."""
        hint = super().minimumSizeHint()
        return QSize(max(LEAST_PX, hint.width()), hint.height())

    def show_fields(self, values: dict[str, str]) -> None:
        """Show the fields; text being typed is kept until it is entered or forgotten."""
        for key, field in self._typed_fields.items():
            show_unless_typing(field, values[key])

    def forget_typed(self) -> None:
        """Let the next values replace text being typed: it belongs to another patient."""
        for field in self._typed_fields.values():
            forget_typed(field)

    def show_refusal(self, key: str, sentence: str) -> None:
        """Say beside a field why what was typed is not taken."""
        self._refusals[key].say(sentence)

    def show_feet(self, at_hand: Side | None, present: Sequence[Side]) -> None:
        """Show which feet the case has, and which of them is active."""
        self.sides.show_feet(at_hand, present)
        self._form.setRowVisible(self._no_side, at_hand is None)
        self._of_foot.setVisible(at_hand is not None)
        self._later.setVisible(at_hand is None)

    def show_variants(self, names: Sequence[str], chosen: str) -> None:
        """Show the variants of the active foot."""
        self.variants.show_variants(names, chosen)

    def show_measures(self, measures: Sequence[Measure]) -> None:
        """Show the measures of the foot."""
        self._measures.show_measures(measures)

    def show_device(self, text: str, selected: bool) -> None:
        """Show the device above the corrections; selected are its values below."""
        self._device.setText(text)
        self._device.setToolTip(text)
        self._device.setChecked(selected)

    def show_corrections(self, rows: Sequence[CorrectionRow]) -> None:
        """Show the corrections, one per row; the same rows stay, with a button being pressed."""
        if list(rows) == self._rows:
            return
        self._rows = list(rows)
        remove_widgets(self._corrections)
        for row in rows:
            self._corrections.addWidget(self._correction_line(row))
        if not rows:
            empty = QLabel(tr("None yet. Choose the pelott tool and click on the sole."))
            empty.setWordWrap(True)
            empty.setObjectName("quiet")
            self._corrections.addWidget(empty)

    def renew_icons(self) -> None:
        """Redraw the icons in the colours of the palette."""
        self.variants.renew_icons()
        rows, self._rows = self._rows, None
        self.show_corrections(rows or [])

    def show_warnings(self, rows: Sequence[WarningRow]) -> None:
        """Show the warnings; a click goes to the cause. The same ones stay while pressed."""
        if list(rows) == self._warned:
            return
        self._warned = list(rows)
        one = len(rows) == 1
        self._count.setText(
            tr("1 warning") if one else tr("{count} warnings").format(count=len(rows))
        )
        self._count.setVisible(bool(rows))
        remove_widgets(self._warnings)
        for number, row in enumerate(rows):
            label = LinkLabel(row.text, str(number)) if row.leads else QLabel(row.text)
            label.setObjectName("warning")
            label.setWordWrap(True)
            label.linkActivated.connect(self._choose_warning)
            self._warnings.addWidget(label)

    def _show_all_warnings(self) -> None:
        """Scroll until all warnings are visible, or the first ones if not all have room."""
        for place in (self._warnings.count() - 1, 0):
            item = self._warnings.itemAt(place)
            if item is not None and (warning := item.widget()) is not None:
                self.ensureWidgetVisible(warning)

    def _choose_warning(self, number: str) -> None:
        self.warning_chosen.emit(int(number))

    def _content(self) -> QWidget:
        self._form = form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.setVerticalSpacing(8)
        form.addRow(tr("Name"), self._fields["name"])
        form.addRow(tr("Born"), self._fields["born"])
        form.addRow(tr("Side"), self._no_side)
        form.addRow(tr("Visit"), self._fields["visit"])
        form.addRow(tr("Notes"), self._notes)
        mark_labels(form)
        content = QWidget()
        layout = QVBoxLayout(content)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.setSpacing(8)
        layout.addWidget(self.sides)
        layout.addLayout(form)
        layout.addWidget(self._later)
        layout.addWidget(self._of_foot)
        layout.addStretch(1)
        self._lay_out_of_foot()
        return content

    def _lay_out_of_foot(self) -> None:
        layout = QVBoxLayout(self._of_foot)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(8)
        title = QHBoxLayout()
        title.addWidget(_heading(tr("Corrections")))
        title.addStretch(1)
        title.addWidget(self._count)  # here, since the warnings themselves may be below the panel
        layout.addLayout(title)
        layout.addWidget(self.variants)
        layout.addWidget(self._device)
        layout.addLayout(self._corrections)
        layout.addLayout(self._warnings)
        layout.addWidget(_heading(tr("Measures")))
        layout.addWidget(self._measures)

    def _correction_line(self, row: CorrectionRow) -> QWidget:
        eye = _button(row, "eye" if row.enabled else "eye-off", tr("Switch on or off"))
        eye.clicked.connect(self._toggle)
        name = ElidedButton(row.text)
        name.setProperty("correction", row.id)
        name.setCheckable(True)
        name.setChecked(row.selected)
        name.setObjectName("row")
        name.setToolTip(row.text)
        name.clicked.connect(self._select)
        remove = _button(row, "remove", tr("Remove"))
        remove.clicked.connect(self._remove)
        line = QWidget()
        rows = QVBoxLayout(line)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(0)
        layout = QHBoxLayout()
        layout.setSpacing(2)
        layout.addWidget(eye)
        layout.addWidget(side_letter(row.side))
        layout.addWidget(name, 1)
        layout.addWidget(remove)
        rows.addLayout(layout)
        if row.selected:
            rows.addLayout(self._more_buttons(row))
        return line

    def _more_buttons(self, row: CorrectionRow) -> QHBoxLayout:
        """Return a row with the further actions on the selected correction."""
        copy = _button(row, "copy", tr("Copy"))
        copy.clicked.connect(self._copy)
        buttons = [copy]
        if row.ordered:
            up, down = _button(row, "up", tr("Move up")), _button(row, "down", tr("Move down"))
            up.clicked.connect(self._move_up)
            down.clicked.connect(self._move_down)
            buttons = [up, down, copy]
        layout = QHBoxLayout()
        layout.setSpacing(2)
        layout.addStretch(1)
        for button in buttons:
            layout.addWidget(button)
        return layout

    def _line_edited(self) -> None:
        field = self.sender()
        assert isinstance(field, QLineEdit)
        field.setModified(False)
        self.field_edited.emit(field.property("key"), field.text())

    def _notes_edited(self) -> None:
        self._notes.document().setModified(False)
        self.field_edited.emit("notes", self._notes.toPlainText())

    def _select_device(self) -> None:
        self._device.setChecked(True)  # what is selected below decides, not the click
        self.device_selected.emit()

    def _select(self) -> None:
        self.correction_selected.emit(self.sender().property("correction"))

    def _toggle(self) -> None:
        self.correction_toggled.emit(self.sender().property("correction"))

    def _move_up(self) -> None:
        self.correction_moved.emit(self.sender().property("correction"), -1)

    def _move_down(self) -> None:
        self.correction_moved.emit(self.sender().property("correction"), 1)

    def _copy(self) -> None:
        self.correction_copied.emit(self.sender().property("correction"))

    def _remove(self) -> None:
        self.correction_removed.emit(self.sender().property("correction"))


def _heading(text: str) -> QLabel:
    heading = QLabel(text)
    heading.setObjectName("heading")
    return heading


def _button(row: CorrectionRow, icon_name: str, tip: str) -> QToolButton:
    button = QToolButton()
    button.setIcon(icon(icon_name))
    button.setAutoRaise(True)
    button.setToolTip(tip)
    button.setAccessibleName(f"{tip}: {row.text}")
    button.setProperty("correction", row.id)
    return button
