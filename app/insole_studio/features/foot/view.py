"""View of the foot stage: image left, foot right, table of views and controls below."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QComboBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSplitter,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.geometry.arrays import ByteArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import ViewEdits
from insole_studio.features.foot.marker_panel import MarkerPanel
from insole_studio.features.foot.rows import FootButtons, FootMap, Limits, Mark, ViewRow
from insole_studio.features.foot.view_table import ViewTable
from insole_studio.features.foot.volume_box import BoxFields, box_edges, box_handles
from insole_studio.scene.coloring import Coloring
from insole_studio.scene.scene_view import GRAB_PX, TOUCH_GRAB_PX
from insole_studio.scene.view_camera import Preset, Subject
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.elided_fields import ElidedComboBox
from insole_studio.widgets.form_parts import ComboBox, Fold, mark_labels
from insole_studio.widgets.icons import icon
from insole_studio.widgets.message_label import MessageLabel, ProgressBar
from insole_studio.widgets.model_view import ModelView
from insole_studio.widgets.number_field import NumberField

_SIDE_PX = 300
_LIMIT_PX = 96
_WIDE_PX = 1000
_BAR_PX = 12


class FootStageView(QWidget):
    """The panel of the foot stage; emits the user's intents."""

    foot_chosen = Signal(object)
    view_chosen = Signal(str)
    view_switched = Signal(str, bool)
    marker_toggled = Signal(str)
    marker_named = Signal(str, object, bool)
    marker_released = Signal(str)
    marker_moved = Signal(str, object)
    marker_dropped = Signal(str, object)
    spot_ignored = Signal(object)
    region_ignored = Signal(object)
    region_searched = Signal(object)
    regions_cleared = Signal()
    box_edited = Signal(object)
    box_reset = Signal()
    map_chosen = Signal(object)
    limits_edited = Signal(object)
    undo_requested = Signal()
    redo_requested = Signal()
    make_requested = Signal()
    cancel_requested = Signal()
    go_on_requested = Signal()

    def __init__(self, dark: bool, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.markers = MarkerPanel()
        self.foot = ModelView(Subject.FOOT, "", dark)
        self.table = ViewTable()
        self.box = BoxFields()
        self.maps = ElidedComboBox()
        self.maps.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.maps.setAccessibleName(tr("Colours of the foot"))
        self.maps.setToolTip(tr("What the colours of the foot show"))
        self.undo = _tool_button("undo", "Ctrl+Z")
        self.redo = _tool_button("redo", "Ctrl+Shift+Z")
        QShortcut(QKeySequence("Ctrl+Y"), self, self.redo.click)
        self.limits = tuple(_limit_field(unit) for unit in ("mm", "px", "mm"))
        self.make = QPushButton(tr("Reconstruct again"))
        self.cancel = QPushButton(tr("Cancel"))
        self.go_on = QPushButton(tr("Go on to design"))
        self.go_on.setObjectName("primary")
        self.go_on.setShortcut(QKeySequence("Ctrl+Return"))
        self.go_on.setToolTip(tr("Work on this foot") + " (Ctrl+Enter)")
        self.feet = ComboBox([(side.value, text) for side, text in _foot_texts().items()])
        self.feet.setAccessibleName(tr("Foot that is shown"))
        self.feet.setToolTip(tr("Which of both feet of the session is shown"))
        self._name = QLabel()
        self._name.setObjectName("heading")
        self._sentences = MessageLabel("warning")
        self._progress = ProgressBar()
        self._work = QLabel()
        self._work.setObjectName("quiet")
        self._fitted = False
        self._bounds: FloatArray | None = None
        self._layout()
        self._connect()

    def show_session(self, name: str, sides: Sequence[Side]) -> None:
        """Show the name of the open session; of both feet, let the user choose the one shown."""
        self._name.setText(name)
        self.feet.setVisible(len(sides) > 1)

    def show_side(self, side: Side) -> None:
        """Show which foot is shown."""
        self.feet.show_value(side.value)
        self.foot.show_side(side)
        self._fitted = False

    def show_views(self, rows: Sequence[ViewRow], selected: str) -> None:
        """Show the table of the views."""
        self.table.show_rows(rows, selected)

    def show_picture(self, picture: ByteArray) -> None:
        """Show an image, (height, width, 3) uint8, RGB."""
        self.markers.show_picture(picture)

    def show_markers(self, marks: Sequence[Mark], ids: Sequence[str], edits: ViewEdits) -> None:
        """Show the markers of the chosen view.

        Parameters
        ----------
        marks
            The marks on the image.
        ids
            Ids of all markers, for the menu.
        edits
            The manual corrections of the view.
        """
        self.markers.show_markers(marks, ids, edits)

    def show_foot(self, mesh: TriangleMesh, coloring: Coloring | None) -> None:
        """Show the foot, or only the views; the first time complete and from below."""
        self.foot.show_mesh(mesh, coloring)
        if not self._fitted:
            self._fitted = True
            self._look(Preset.PLANTAR)

    def show_nothing(self, sentence: str) -> None:
        """Show why there is no foot."""
        self.foot.show_empty(sentence, {})

    def show_no_session(self, sentence: str) -> None:
        """Clear all that belongs to a session, and show a sentence instead of its foot."""
        self._name.clear()
        self.table.show_rows([], "")
        self.markers.show_nothing()
        self.foot.clear()
        self.foot.show_side(None)
        self.feet.hide()
        self.show_nothing(sentence)
        self.show_sentences([])
        self._bounds = None

    def show_map(self, kind: FootMap, possible: Sequence[FootMap]) -> None:
        """Show which colour map is chosen, and which are possible."""
        texts = _map_texts()
        offered = [self.maps.itemData(i) for i in range(self.maps.count())]
        self.maps.blockSignals(True)
        if offered != list(possible):
            self.maps.clear()
            for other in possible:
                self.maps.addItem(texts[other], other)
        self.maps.setCurrentIndex(list(possible).index(kind))
        self.maps.blockSignals(False)

    def show_box(self, box: Box) -> None:
        """Show the volume of interest, as numbers and in the scene."""
        self.box.show_box(box)
        painter = self.foot.scene.painter
        painter.show_lines("box", box_edges(box), painter.scheme.accent, 1.5)
        self.foot.show_handles(box_handles(box))
        self._bounds = np.array([box.min_mm, box.max_mm])

    def show_limits(self, limits: Limits) -> None:
        """Show the limits beyond which a pose is rejected."""
        values = (limits.residual_mm, limits.reprojection_px, limits.displacement_mm)
        for field, value in zip(self.limits, values, strict=True):
            field.show_value(value)

    def show_sentences(self, sentences: Sequence[str]) -> None:
        """Show messages, one per line."""
        self._sentences.say_all(sentences)

    def show_progress(self, fraction: float, text: str) -> None:
        """Show the progress of a job (`fraction` 0 to 1); an empty text hides it."""
        self._progress.show_work(fraction, text)
        self._work.setVisible(bool(text))
        self._work.setText(f"{translate_core_message(text)}…")

    def show_buttons(self, buttons: FootButtons) -> None:
        """Enable and disable the buttons."""
        for part in (self.markers, self.box, *self.limits):
            part.setEnabled(buttons.has_session)
        self.make.setEnabled(buttons.make)
        self.make.setVisible(not buttons.cancel)
        self.cancel.setVisible(buttons.cancel)
        self.go_on.setEnabled(buttons.go_on)
        stale = buttons.is_stale and not buttons.cancel
        self.go_on.setText(tr("Reconstruct and go on") if stale else tr("Go on to design"))
        for button, verb, sentence in (
            (self.undo, tr("Undo"), buttons.undo),
            (self.redo, tr("Redo"), buttons.redo),
        ):
            button.setEnabled(bool(sentence))
            button.setToolTip(f"{verb}: {sentence}" if sentence else verb)

    def renew_icons(self) -> None:
        """Redraw the icons in the colours of the palette."""
        for button, name in ((self.undo, "undo"), (self.redo, "redo")):
            button.setIcon(icon(name))

    def set_touch(self, touch: bool) -> None:
        """Set the size at which handles are grabbed, for touch or for a mouse."""
        self.foot.scene.grab_px = TOUCH_GRAB_PX if touch else GRAB_PX

    def close_scene(self) -> None:
        """Free the renderer."""
        self.foot.scene.close_scene()

    def _connect(self) -> None:
        markers = self.markers
        self.feet.edited.connect(lambda word: self.foot_chosen.emit(Side(word)))
        self.table.view_chosen.connect(self.view_chosen)
        self.table.view_switched.connect(self.view_switched)
        for name in (
            "marker_toggled", "marker_named", "marker_released", "spot_ignored",
            "region_ignored", "region_searched", "regions_cleared",
        ):  # fmt: skip
            getattr(markers, name).connect(getattr(self, name))
        markers.picture.mark_moved.connect(self.marker_moved)
        markers.picture.mark_dropped.connect(self.marker_dropped)
        self.box.edited.connect(self.box_edited)
        self.box.reset_requested.connect(self.box_reset)
        self.maps.currentIndexChanged.connect(self._choose_map)
        self.foot.preset_requested.connect(self._look)
        for field in self.limits:
            field.edited.connect(self._edit_limits)
        for button, signal in (
            (self.undo, self.undo_requested),
            (self.redo, self.redo_requested),
            (self.make, self.make_requested),
            (self.cancel, self.cancel_requested),
            (self.go_on, self.go_on_requested),
        ):
            button.clicked.connect(signal)

    def _choose_map(self, index: int) -> None:
        self.map_chosen.emit(self.maps.itemData(index))

    def _edit_limits(self, _value: float) -> None:
        self.limits_edited.emit(Limits(*(field.value() for field in self.limits)))

    def _look(self, preset: Preset) -> None:
        if self._bounds is not None:
            self.foot.scene.set_camera(self.foot.scene.aim_at(preset, self._bounds))
            self.foot.show_scale()

    def _layout(self) -> None:
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 4, 0, 8)
        whole.setSpacing(4)
        whole.addLayout(self._header())
        upper = QSplitter(Qt.Orientation.Horizontal)
        upper.addWidget(self.markers)
        upper.addWidget(self._foot_side())
        upper.setStretchFactor(0, 1)
        upper.setStretchFactor(1, 1)
        upper.setSizes([_WIDE_PX, _WIDE_PX])
        upper.setChildrenCollapsible(False)
        whole.addWidget(upper, 1)
        lower = QHBoxLayout()
        lower.setContentsMargins(8, 0, 8, 0)
        lower.setSpacing(16)
        left = QVBoxLayout()
        left.setSpacing(8)
        left.addWidget(self.table)
        left.addWidget(self._sentences)
        left.addStretch(1)
        lower.addLayout(left, 1)
        lower.addWidget(self._actions())
        whole.addLayout(lower)

    def _header(self) -> QHBoxLayout:
        header = QHBoxLayout()
        header.setContentsMargins(8, 0, 8, 0)
        header.setSpacing(4)
        header.addWidget(self._name)
        header.addStretch(1)
        header.addWidget(self._work)
        header.addWidget(self._progress)
        self._progress.setFixedWidth(180)
        self._progress.setFixedHeight(_BAR_PX)
        self._progress.setTextVisible(False)
        header.addSpacing(8)
        header.addWidget(self.undo)
        header.addWidget(self.redo)
        return header

    def _foot_side(self) -> QWidget:
        side = QWidget()
        column = QVBoxLayout(side)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        row = QHBoxLayout()
        row.setContentsMargins(8, 4, 8, 0)
        row.setSpacing(8)
        self.feet.hide()
        row.addWidget(self.feet)
        row.addWidget(QLabel(tr("Colours")))
        row.addWidget(self.maps)
        row.addStretch(1)
        column.addLayout(row)
        column.addWidget(self.foot, 1)
        return side

    def _actions(self) -> QWidget:
        side = QWidget()
        side.setMinimumWidth(2 * _SIDE_PX)
        columns = QHBoxLayout(side)
        columns.setContentsMargins(0, 0, 0, 0)
        columns.setSpacing(16)
        volume, right = QVBoxLayout(), QVBoxLayout()
        volume.addWidget(_heading(tr("Volume of interest")))
        volume.addWidget(self.box)
        volume.addStretch(1)
        limits = QWidget()
        right.addWidget(Fold(tr("A view is refused above"), (limits,)))
        form = QFormLayout(limits)
        form.setContentsMargins(0, 0, 0, 0)
        form.setVerticalSpacing(4)
        for (text, tip), field in zip(_limit_texts(), self.limits, strict=True):
            label = QLabel(text)
            label.setToolTip(tip)
            field.setToolTip(tip)
            label.setMinimumWidth(label.sizeHint().width())  # never narrower than its text
            label.setBuddy(field)
            form.addRow(label, field)
        mark_labels(form)
        right.addWidget(limits)
        right.addStretch(1)
        right.addWidget(self.make)
        right.addWidget(self.cancel)
        right.addWidget(self.go_on)
        columns.addLayout(volume)
        columns.addLayout(right, 1)
        return side


def _heading(text: str) -> QLabel:
    heading = QLabel(text)
    heading.setObjectName("heading")
    return heading


def _tool_button(name: str, shortcut: str) -> QToolButton:
    button = QToolButton()
    button.setIcon(icon(name))
    button.setAutoRaise(True)
    button.setShortcut(shortcut)
    return button


def _limit_field(unit: str) -> NumberField:
    field = NumberField(unit, least=0.1, greatest=20.0, step=0.1)
    field.set_room(_LIMIT_PX)
    return field


def _limit_texts() -> tuple[tuple[str, str], ...]:
    """Return name and meaning of each limit."""
    return (
        (
            tr("Markers in space"),
            tr("How far the markers of a view may lie from where they are known to be"),
        ),
        (
            tr("Markers in the image"),
            tr("How far the markers may lie in the picture from where they should be seen"),
        ),
        (
            tr("Uncertain at the foot"),
            tr("How far the foot may be shifted by what is not known of the sensor's place"),
        ),
    )


def _foot_texts() -> dict[Side, str]:
    return {Side.LEFT: tr("Left foot"), Side.RIGHT: tr("Right foot")}


def _map_texts() -> dict[FootMap, str]:
    return {
        FootMap.VIEWS: tr("Views, each in its colour"),
        FootMap.SKIN: tr("Skin"),
        FootMap.CONFIDENCE: tr("Confidence"),
        FootMap.COVERAGE: tr("Coverage"),
        FootMap.AGREEMENT: tr("Distance between the views"),
        FootMap.CORRECTION: tr("Moved by the correction"),
    }
