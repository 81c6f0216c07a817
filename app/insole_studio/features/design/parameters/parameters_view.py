"""View of the parameters panel: the values of the selection and of the insole."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias

from PySide6.QtCore import QEvent, Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QApplication,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from insole_studio.features.design.rows import ChoiceSpec, FieldGroup, FieldSpec, Proposal
from insole_studio.widgets.form_parts import ComboBox, Fold
from insole_studio.widgets.layouts import FlowLayout, scroll_by_finger
from insole_studio.widgets.number_field import NumberField, SliderField

ValueField: TypeAlias = NumberField | SliderField | ComboBox

ROWS, TOUCH_ROWS = 3, 2
"""Rows of fields that fit a low screen with a mouse, and with touch."""
ROW_HEIGHT_PX = 26
FIELD_PX = 88
GAP_PX, MARGIN_PX = 12, 8
SHORT_TEXT, SHORT_PX, TOUCH_SHORT_PX = 3, 32, 46
CHOICE_PX = 116
LEAST_PX, MOST_PX = 112, 176
LOW_SCREEN_PX, LOWEST_PX = 600, 64
"""Height below which a screen has no room for a whole line of fields, and what they get there."""
MOST_KEPT = 16
"""Groups that are kept to be shown again: making fields takes longer than all else of a selection.
"""


@dataclass(frozen=True, eq=False)
class _LaidOutGroup:
    """The widget of a group, its fields by their keys, and its labels or the fold that head it."""

    shape: FieldGroup
    widget: QWidget
    fields: dict[str, ValueField]
    heading: tuple[QLabel, ...] = ()
    """Labels of title and note."""
    fold: Fold | None = None

    def show(self, open_titles: Collection[str]) -> None:
        """Show the group, its fields with their keys, and open if its title is one of these."""
        self._set_keys(shown=True)
        if self.fold is not None:
            self.fold.setChecked(self.fold.text() in open_titles)
        self.widget.show()

    def hide(self) -> None:
        """Hide the group; another one may show a field of the same key meanwhile."""
        self.widget.hide()
        self._set_keys(shown=False)

    @property
    def can_return(self) -> bool:
        """Whether it has fields, and no slider in the hand; hiding ends what is typed."""
        sliders = [f.slider for f in self.fields.values() if isinstance(f, SliderField)]
        return bool(self.fields) and not any(slider.isSliderDown() for slider in sliders)

    def _set_keys(self, *, shown: bool) -> None:
        """Let the fields be found by their keys, or not while they are hidden."""
        for key, field in self.fields.items():
            field.setProperty("key", key if shown else None)
            if isinstance(field, SliderField):
                field.number.setProperty("key", key if shown else None)


class ParametersView(QScrollArea):
    """Groups of fields side by side, wrapped at the width of the panel."""

    field_edited = Signal(str, object)
    field_moved = Signal(str, float)
    """A slider is being dragged: what a release would enter."""
    move_cancelled = Signal()
    proposal_chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._groups: Sequence[FieldGroup] = ()
        self._laid_out: list[_LaidOutGroup] = []
        self._kept: list[_LaidOutGroup] = []
        """Hidden, the last one first."""
        self._fields: dict[str, ValueField] = {}
        self._open: set[str] = set()
        """Titles of the groups for experts that were opened."""
        self._rows = ROWS
        self._is_restyled = True
        self._restyled = QTimer(self)
        self._restyled.setSingleShot(True)
        self._restyled.timeout.connect(self._show_again)
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        content = QWidget()
        self._flow = FlowLayout(content, margin_px=4, gap_px=GAP_PX)
        self._flow.setContentsMargins(MARGIN_PX, 4, 4, 4)  # aligned with the titles of the panels
        self.setWidget(content)
        scroll_by_finger(self)

    def show_groups(self, groups: Sequence[FieldGroup]) -> None:
        """Show the groups; the fields of a group of which only values changed are reused."""
        self._groups = groups
        shapes = [group.shape for group in groups]
        if self._is_restyled or shapes != [shown.shape for shown in self._laid_out]:
            self._lay_out(groups, shapes)
        for group, shown in zip(groups, self._laid_out, strict=True):
            for label, text in zip(shown.heading, (group.title, group.note), strict=False):
                label.setText(text)
                label.setVisible(bool(text))
            for spec in group.fields:
                self._show_value(spec)

    def _show_again(self) -> None:
        self.show_groups(self._groups)

    def width_up_to(self, key: str) -> int:
        """Return the width in which the groups up to the one with a field stand in one line."""
        width = 0
        for shown in self._laid_out:
            width += shown.widget.sizeHint().width() + GAP_PX
            if key in shown.fields:
                return width + MARGIN_PX + self.verticalScrollBar().sizeHint().width()
        return 0

    def changeEvent(self, event: QEvent) -> None:
        """Lay the fields out again when touch mode begins or ends: fewer rows fit then."""
        super().changeEvent(event)
        if event.type() is QEvent.Type.StyleChange:
            self._is_restyled = True
            self._restyled.start()  # Qt still goes through the fields that would be replaced

    def _show_value(self, spec: FieldSpec | ChoiceSpec) -> None:
        field = self._fields[spec.key]
        if isinstance(field, NumberField | SliderField):
            assert isinstance(spec, FieldSpec)
            field.show_range(spec.least, spec.greatest)
            field.show_value(spec.value)
        else:
            field.show_value(str(spec.value))

    def _lay_out(self, groups: Sequence[FieldGroup], shapes: Sequence[FieldGroup]) -> None:
        outdated = self._fit_rows()
        before, unused = self._laid_out, [*self._laid_out, *self._kept]
        self._laid_out = [
            _taken(unused, shape) or self._group(group, shape)
            for group, shape in zip(groups, shapes, strict=True)
        ]
        self._fields = {
            key: field for shown in self._laid_out for key, field in shown.fields.items()
        }
        while self._flow.takeAt(0) is not None:
            pass
        for shown in self._laid_out:
            self._flow.addWidget(shown.widget)
            shown.show(self._open)
        self._kept = [group for group in self._kept if group in unused]
        for gone in before:
            if gone in unused:
                self._let_go(gone)
        for gone in outdated:
            self._hide(gone)
            gone.widget.deleteLater()
        for shown in self._laid_out:
            if shown not in before:
                for widget in shown.widget.findChildren(QWidget):
                    widget.ensurePolished()  # its size for touch comes from the style
        # The first line is always fully visible, with touch as well.
        first_px = min(max(self._flow.minimumSize().height() + 8, LEAST_PX), MOST_PX)
        is_low = self.screen().availableGeometry().height() < LOW_SCREEN_PX
        self.setMinimumHeight(LOWEST_PX if is_low else first_px)

    def _fit_rows(self) -> list[_LaidOutGroup]:
        """Count the rows that fit in a new style; return the groups of another number."""
        rows = self._rows_now if self._is_restyled else self._rows
        self._is_restyled = False
        if rows == self._rows:
            return []
        outdated = [*self._laid_out, *self._kept]
        self._rows, self._laid_out, self._kept = rows, [], []
        return outdated

    def _let_go(self, group: _LaidOutGroup) -> None:
        """Hide a group, and keep it for later if it can be shown again."""
        self._hide(group)
        if group.can_return:
            self._kept.insert(0, group)
        else:
            group.widget.deleteLater()  # one of its fields may be in the midst of a key
        for surplus in self._kept[MOST_KEPT:]:
            self._kept.remove(surplus)
            surplus.widget.deleteLater()

    def _hide(self, group: _LaidOutGroup) -> None:
        """Hide a group; its field that has the keyboard focus hands it to the one of its key."""
        focused = QApplication.focusWidget()
        if focused is not None and group.widget.isAncestorOf(focused):
            successor = self._fields.get(str(focused.property("key") or ""))
            if successor is None:
                focused.clearFocus()  # else the next field would take what is typed
            else:
                successor.setFocus()
        group.hide()

    def _group(self, group: FieldGroup, shape: FieldGroup) -> _LaidOutGroup:
        widget = QWidget()
        column = QVBoxLayout(widget)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        grid = QGridLayout()
        grid.setContentsMargins(0, 0, 0, 0)
        heading: tuple[QLabel, ...] = ()
        fold: Fold | None = None
        if group.folds:
            cells = QWidget(widget)
            cells.setLayout(grid)
            fold = self._fold(group.title, cells)
            column.addWidget(fold, alignment=Qt.AlignmentFlag.AlignLeft)
            column.addWidget(cells)
        else:
            heading = QLabel(), QLabel()
            column.addLayout(_heading(*heading))
            column.addLayout(grid)
        grid.setHorizontalSpacing(6)
        grid.setVerticalSpacing(4)
        for row in range(self._rows):
            grid.setRowMinimumHeight(row, ROW_HEIGHT_PX)
        before = self._add_offers(grid, group)
        fields = {
            spec.key: self._add_field(grid, spec, number, before)
            for number, spec in enumerate(group.fields)
        }
        grid.setColumnStretch(grid.columnCount(), 1)
        column.addStretch(1)
        return _LaidOutGroup(shape, widget, fields, heading, fold)

    def _fold(self, title: str, content: QWidget) -> Fold:
        """Return the heading of a group for experts, which stays open once it was opened."""
        fold = Fold(title, (content,))
        fold.toggled.connect(partial(self._note_fold, title))
        return fold

    def _note_fold(self, title: str, is_open: bool) -> None:
        if is_open:
            self._open.add(title)
        else:
            self._open.discard(title)

    @property
    def _rows_now(self) -> int:
        """The number of rows that fit in the style of today."""
        field = NumberField("", least=0, greatest=1, step=1)
        return TOUCH_ROWS if field.is_for_fingers else ROWS

    def _add_field(
        self, grid: QGridLayout, spec: FieldSpec | ChoiceSpec, number: int, before: int
    ) -> ValueField:
        field = _make_field(spec)
        _describe(field, spec)
        if isinstance(field, ComboBox):
            field.setFixedWidth(CHOICE_PX)
        else:
            field.set_room(FIELD_PX)
        field.edited.connect(self._edited)
        if isinstance(field, SliderField):
            field.moved.connect(self._moved)
            field.cancelled.connect(self.move_cancelled)
        label = QLabel(spec.label)
        label.setBuddy(field)
        label.setToolTip(spec.tip)
        label.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        row, column = number % self._rows, before + 2 * (number // self._rows)
        grid.addWidget(label, row, column)
        grid.addWidget(field, row, column + 1)
        return field

    def _add_offers(self, grid: QGridLayout, group: FieldGroup) -> int:
        """Add the buttons before the fields; return the number of columns they take."""
        buttons = [self._button(offer) for offer in group.offers]
        short = bool(buttons) and all(len(offer.text) <= SHORT_TEXT for offer in group.offers)
        cells: list[QWidget] = [QLabel(group.caption)] if group.caption else []
        cells += [_row(buttons)] if short else buttons
        for number, cell in enumerate(cells):
            grid.addWidget(cell, number % self._rows, number // self._rows)
        return (len(cells) + self._rows - 1) // self._rows

    def _button(self, offer: Proposal) -> QPushButton:
        button = QPushButton(offer.text)
        button.setToolTip(offer.tip)
        button.setAccessibleName(offer.tip or offer.text)
        button.setProperty("offer", offer.key)
        if len(offer.text) <= SHORT_TEXT:
            button.setFixedWidth(TOUCH_SHORT_PX if self._rows == TOUCH_ROWS else SHORT_PX)
        button.clicked.connect(self._choose)
        return button

    def _edited(self, value: object) -> None:
        self.field_edited.emit(self.sender().property("key"), value)

    def _moved(self, value: float) -> None:
        self.field_moved.emit(self.sender().property("key"), value)

    def _choose(self) -> None:
        self.proposal_chosen.emit(self.sender().property("offer"))


def _taken(unused: list[_LaidOutGroup], shape: FieldGroup) -> _LaidOutGroup | None:
    """Take out and return one of the same shape; None if there is none."""
    for number, group in enumerate(unused):
        if group.shape == shape:
            return unused.pop(number)
    return None


def _heading(title: QLabel, note: QLabel) -> QHBoxLayout:
    """Return title and note in one line, so that the fields of all groups align."""
    row = QHBoxLayout()
    row.setSpacing(8)
    for label, name in ((title, "heading"), (note, "quiet")):
        label.setObjectName(name)
        row.addWidget(label)
    row.addStretch(1)
    return row


def _row(widgets: Sequence[QWidget]) -> QWidget:
    whole = QWidget()
    row = QHBoxLayout(whole)
    row.setContentsMargins(0, 0, 0, 0)
    row.setSpacing(4)
    for widget in widgets:
        row.addWidget(widget)
    return whole


def _describe(field: ValueField, spec: FieldSpec | ChoiceSpec) -> None:
    if isinstance(field, SliderField):
        field.describe(spec.label, spec.tip)
        return
    field.setAccessibleName(spec.label)
    field.setAccessibleDescription(spec.tip)
    field.setToolTip(spec.tip)


def _make_field(spec: FieldSpec | ChoiceSpec) -> ValueField:
    if isinstance(spec, ChoiceSpec):
        return ComboBox(spec.options)
    make = SliderField if spec.slider else NumberField
    field = make(
        spec.unit,
        least=spec.least,
        greatest=spec.greatest,
        step=spec.step,
        decimals=spec.decimals,
    )
    if isinstance(field, NumberField):
        field.allow_unknown(spec.least_known)
    return field
