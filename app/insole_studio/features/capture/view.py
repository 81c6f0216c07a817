"""View of the capture stage: a card per sensor, the options, and one large button."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QCheckBox,
    QFrame,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QProgressBar,
    QPushButton,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from insole_core.geometry.arrays import ByteArray
from insole_core.geometry.side import BOTH, Side, Sides, sides_from
from insole_studio.features.capture.rows import (
    CaptureOptions,
    CaptureRow,
    SensorRow,
    depth_coloring,
)
from insole_studio.features.capture.sensor_card import SensorCard
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.empty_page import EmptyPage
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.layouts import CardGrid, keep_room
from insole_studio.widgets.legend import Legend
from insole_studio.widgets.number_field import NumberField
from insole_studio.widgets.side_switch import SideBadge
from insole_studio.widgets.single_click_button import SingleClickButton

_FIND = "find"


class CaptureView(QWidget):
    """The capture panel; emits the user's intents."""

    capture_requested = Signal()
    cancel_requested = Signal()
    placed_requested = Signal()
    retake_requested = Signal(str)
    use_requested = Signal()
    other_foot_requested = Signal()
    find_requested = Signal()
    view_chosen = Signal(str, str)
    views_swapped = Signal(str, str)
    tilt_requested = Signal(str, float)
    level_requested = Signal(str)
    identify_requested = Signal(str, bool)
    tuning_edited = Signal(str, object)
    undo_requested = Signal()
    redo_requested = Signal()
    options_edited = Signal(object)
    resume_requested = Signal()
    discard_requested = Signal()

    def __init__(self, tilt_step_deg: float, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tilt_step_deg = tilt_step_deg
        self._options = CaptureOptions()
        self._can_tilt = True
        self._cards: dict[str, SensorCard] = {}
        self._empty = EmptyPage()
        self._empty.chosen.connect(self.find_requested)
        self._grid = CardGrid()
        self._grid.wrapped.connect(self._lay_cards)
        self._legend = Legend()
        self._legend.show_coloring(depth_coloring())
        self._pages = QStackedWidget()
        self._pages.addWidget(self._empty)
        self._pages.addWidget(self._grid)
        QShortcut(QKeySequence("Ctrl+Z"), self, self.undo_requested.emit)
        for keys in ("Ctrl+Shift+Z", "Ctrl+Y"):
            QShortcut(QKeySequence(keys), self, self.redo_requested.emit)
        self._make_options()
        self._make_buttons()
        self._make_offer()
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.setSpacing(8)
        self._visits = ComboBox([])
        self._visits.setAccessibleName(tr("Whose feet are captured"))
        self._visits.setToolTip(tr("Patients whose feet wait to be captured"))
        self._visits.edited.connect(self._decide)
        self._decided = False
        self._visits.hide()
        layout.addWidget(self._offer)
        layout.addWidget(self._visits)
        layout.addWidget(self._legend)
        layout.addWidget(self._pages, 1)
        layout.addLayout(self._option_row())
        layout.addWidget(self._sentence)
        layout.addLayout(self._button_row())

    @property
    def visit_id(self) -> str:
        """The visit of the work list that is captured for; empty for none."""
        return self._visits.currentData() or ""

    def show_visits(self, visits: Sequence[tuple[str, str]], proposed: str) -> None:
        """Show the work list; the chosen visit stays chosen.

        Parameters
        ----------
        visits
            Id and name of each; the first one is nobody.
        proposed
            The visit to choose as long as nobody has decided for whom to capture.
        """
        ids = [visit_id for visit_id, _name in visits]
        before = self.visit_id if self._decided else self.visit_id or proposed
        self._visits.clear()
        for visit_id, name in visits:
            self._visits.addItem(name, visit_id)
        self._visits.show_value(before if before in ids else "")
        self._visits.setVisible(len(visits) > 1)

    def move_visit(self, before: str, visit_id: str) -> None:
        """Let a visit that is listed be another one from now on; it stays chosen."""
        number = self._visits.findData(before)
        if number >= 0:
            self._visits.setItemData(number, visit_id)

    def _decide(self, _visit_id: str = "") -> None:
        """Propose no other patient from now on: the next foot may be of the same one."""
        self._decided = True

    def show_sensors(self, rows: Sequence[SensorRow]) -> None:
        """Show a card per sensor, in this order."""
        for serial in set(self._cards) - {row.serial for row in rows}:
            card = self._cards.pop(serial)
            card.hide()
            card.deleteLater()
        for row in rows:
            card = self._cards.get(row.serial) or self._new_card(row.serial)
            card.show_row(row)
        self._grid.show_cards([self._cards[row.serial] for row in rows])
        self._pages.setCurrentIndex(1)
        self._legend.show()

    def show_pictures(self, serial: str, depth: ByteArray | None, color: ByteArray | None) -> None:
        """Show new images of a sensor.

        Parameters
        ----------
        serial
            Serial number of the sensor.
        depth, color : (height, width, 3) uint8, RGB
            None keeps the current image.
        """
        if serial in self._cards:
            self._cards[serial].show_pictures(depth, color)

    def show_capture(self, row: CaptureRow) -> None:
        """Show the progress of the capture and the possible actions."""
        self._capture.setText(row.button)
        self._capture.setEnabled(row.can_capture)
        self._capture.setVisible(not row.waits_for_hand)
        self._cancel.setVisible(row.running)
        self._placed.setVisible(row.waits_for_hand)
        self._use.setEnabled(row.can_use)
        self._use.setDefault(row.is_whole)
        self._capture.setDefault(not row.is_whole)
        self._other.setEnabled(row.can_use)
        self._progress.setValue(round(100 * row.fraction))
        self._progress.setVisible(row.running)
        self._sentence.setText(translate_core_message(row.sentence))
        if row.offer != self._offered.text():
            self._ask_to_discard(False)
        self._offered.setText(row.offer)
        self._offer.setVisible(bool(row.offer))
        for field in self._fields:
            field.setEnabled(not row.running)
        self._can_tilt = row.can_tilt
        self._bursts.setEnabled(row.can_tilt and not row.running)
        self._show_bursts()

    def show_options(self, options: CaptureOptions) -> None:
        """Show the options."""
        self._options = options
        self._show_side(options.side)
        self._side.show_value(str(options.side))
        self._weight.show_value(options.weight_bearing)
        self._mode.show_value(options.mode)
        self._frames.show_value(options.frames)
        self._show_bursts()
        with QSignalBlocker(self._held):
            self._held.setChecked(options.held)
        self._notes.setText(options.notes)
        self._show_views(options)

    def _show_side(self, side: Sides) -> None:
        self._badge.show_side(None if side == BOTH else Side(side))
        self._other.setVisible(side != BOTH)

    def _show_views(self, options: CaptureOptions) -> None:
        self._views.setText(" ".join(options.views))
        self._views.setVisible(options.mode == "moved")

    def _show_bursts(self) -> None:
        """Show how many series a view has: one where no sensor can tilt between them."""
        self._bursts.show_value(self._options.bursts if self._can_tilt else 1)
        if self._can_tilt:
            tip = tr("Series a view, between which the motor tilts the sensor by a degree")
        else:
            tip = tr("None of the sensors has a motor, which would tilt it between bursts")
        self._bursts.setToolTip(tip)

    def show_empty(self, sentence: str) -> None:
        """Explain why there is no sensor."""
        self.show_sensors([])
        self._empty.show_offers(translate_core_message(sentence), {_FIND: tr("Look again")})
        self._pages.setCurrentIndex(0)
        self._legend.hide()

    def show_sentence(self, sentence: str) -> None:
        """Show a message to the user."""
        self._warning.setText(translate_core_message(sentence))
        self._warning.setVisible(bool(sentence))

    def _lay_cards(self, wrapped: bool) -> None:
        """Save height where there are several rows of cards."""
        for card in self._cards.values():
            card.lay_pictures(beside=wrapped)

    def _new_card(self, serial: str) -> SensorCard:
        card = SensorCard(serial, self._tilt_step_deg)
        card.lay_pictures(beside=self._grid.is_wrapped)
        card.view_chosen.connect(self.view_chosen)
        card.dropped.connect(self.views_swapped)
        card.tilt_requested.connect(self.tilt_requested)
        card.level_requested.connect(self.level_requested)
        card.identify_requested.connect(self.identify_requested)
        card.retake_requested.connect(self.retake_requested)
        card.tuning_edited.connect(self.tuning_edited)
        self._cards[serial] = card
        return card

    def _make_options(self) -> None:
        self._badge = SideBadge()
        self._side = ComboBox(
            [
                (Side.LEFT.value, tr("left")),
                (Side.RIGHT.value, tr("right")),
                (BOTH, tr("Both feet")),
            ]
        )
        self._side.edited.connect(lambda word: self._edit(side=sides_from(word)))
        self._weight = ComboBox(
            [
                ("none", tr("Not weight-bearing")),
                ("semi", tr("Semi weight-bearing")),
                ("full", tr("Weight-bearing")),
            ]
        )
        self._weight.edited.connect(lambda word: self._edit(weight_bearing=word))
        self._held = QCheckBox(tr("Held"))
        self._held.setToolTip(tr("Somebody holds the foot"))
        self._held.toggled.connect(lambda on: self._edit(held=on))
        self._notes = QLineEdit()
        self._notes.setPlaceholderText(tr("Notes"))
        self._notes.editingFinished.connect(self._enter_texts)
        self._mode = ComboBox(
            [
                ("turns", tr("One after the other")),
                ("together", tr("All at once")),
                ("moved", tr("Moved by hand")),
            ]
        )
        self._mode.edited.connect(lambda word: self._edit(mode=word))
        self._views = QLineEdit()
        self._views.setToolTip(tr("All views in order; a sensor is moved to those that have none"))
        self._views.setAccessibleName(tr("Views"))
        self._views.hide()
        self._views.editingFinished.connect(self._enter_texts)
        self._frames = NumberField(tr("frames"), least=1, greatest=200, step=1, decimals=0)
        self._frames.edited.connect(lambda number: self._edit(frames=round(number)))
        self._bursts = NumberField("", least=1, greatest=9, step=1, decimals=0)
        self._bursts.setPrefix(tr("Bursts: "))
        self._bursts.edited.connect(lambda number: self._edit(bursts=round(number)))

    def _option_row(self) -> QHBoxLayout:
        row = QHBoxLayout()
        row.setSpacing(8)
        for foot in (self._badge, self._side, self._weight, self._held):
            row.addWidget(foot)
        row.addWidget(self._notes, 1)
        for number in (self._mode, self._views, self._frames, self._bursts):
            row.addWidget(number)
        return row

    @property
    def _fields(self) -> tuple[QWidget, ...]:
        """The widgets that are disabled while a capture runs."""
        foot = (self._side, self._weight, self._held)
        return (*foot, self._mode, self._views, self._frames, self._bursts)

    def _make_offer(self) -> None:
        self._offer, self._offered = QFrame(), QLabel()
        self._offer.setFrameShape(QFrame.Shape.StyledPanel)
        self._offered.setWordWrap(True)
        go_on, discard, delete, keep = (
            SingleClickButton(text)
            for text in (
                tr("Go on with it"), tr("Discard it"),
                tr("Delete the views for good"), tr("Keep them"),
            )
        )  # fmt: skip
        self._first, self._second = (go_on, discard), (delete, keep)
        go_on.clicked.connect(self.resume_requested)
        discard.clicked.connect(lambda: self._ask_to_discard(True))
        delete.clicked.connect(self._discard)
        keep.clicked.connect(lambda: self._ask_to_discard(False))
        row = QHBoxLayout(self._offer)
        row.setContentsMargins(8, 4, 8, 4)
        row.addWidget(self._offered, 1)
        for button in (*self._first, *self._second):
            row.addWidget(button)
        self._ask_to_discard(False)
        self._offer.hide()

    def _discard(self) -> None:
        """Have what is offered deleted; what is offered next is asked about anew."""
        self._ask_to_discard(False)
        self.discard_requested.emit()

    def _ask_to_discard(self, asking: bool) -> None:
        """Ask once, in place, before anything is deleted for good."""
        for button in self._first:
            button.setVisible(not asking)
        for button in self._second:
            button.setVisible(asking)
        if asking:
            self._second[1].setFocus()

    def _make_buttons(self) -> None:
        self._sentence, self._warning = QLabel(), QLabel()
        self._sentence.setWordWrap(True)
        self._warning.setWordWrap(True)
        self._warning.setObjectName("warning")
        self._warning.hide()
        self._capture = QPushButton(tr("Capture"))
        self._capture.setToolTip(tr("Capture all views (F5)"))
        self._cancel = QPushButton(tr("Cancel"))
        self._placed = QPushButton(tr("The sensor stands"))
        self._placed.setToolTip(tr("Capture the view (F5)"))
        for large in (self._capture, self._placed):  # only one of them is visible
            large.setMinimumHeight(48)
            large.setShortcut(Qt.Key.Key_F5)
        self._use = QPushButton(tr("Use this scan"))
        self._other = QPushButton(tr("Keep, and capture the other foot"))
        self._progress = QProgressBar()
        for of_running in (self._progress, self._cancel):
            keep_room(of_running)
        for button, signal in (
            (self._capture, self.capture_requested),
            (self._cancel, self.cancel_requested),
            (self._placed, self.placed_requested),
            (self._use, self.use_requested),
            (self._other, self.other_foot_requested),
        ):
            button.clicked.connect(lambda _on=False, s=signal: self._order(s))

    def _button_row(self) -> QVBoxLayout:
        row = QHBoxLayout()
        row.setSpacing(8)
        for large in (self._capture, self._placed):
            row.addWidget(large, 1)
        for button in (self._cancel, self._use, self._other):
            row.addWidget(button)
        column = QVBoxLayout()
        column.setSpacing(8)
        column.addWidget(self._warning)
        column.addWidget(self._progress)
        column.addLayout(row)
        return column

    def _order(self, signal: Any) -> None:
        """Hide the last message and emit a signal, which may cause another one."""
        self._enter_texts()  # F5 leaves the focus where something is being typed
        self._decide()
        self.show_sentence("")
        signal.emit()

    def _enter_texts(self) -> None:
        views = tuple(self._views.text().replace(",", " ").split())
        self._edit(notes=self._notes.text(), views=views)

    def _edit(self, **changes: Any) -> None:
        options = replace(self._options, **changes)
        if options != self._options:
            self._options = options
            self._show_side(options.side)
            self._show_views(options)
            self.options_edited.emit(options)
