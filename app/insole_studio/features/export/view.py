"""View of the export stage: the order left, the part in the middle, its checks right."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QKeySequence, QResizeEvent, QShowEvent
from PySide6.QtWidgets import (
    QButtonGroup,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.export.shop_order import Release
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.solids.shop import Block
from insole_core.workflows.make_order import OrderChoice
from insole_studio.features.export.check_list import CheckList
from insole_studio.features.export.order_form import OrderForm, Stock
from insole_studio.features.export.part_colors import PartColors
from insole_studio.features.export.rows import Buttons, CheckRow, OrderedFoot
from insole_studio.scene.view_camera import Subject
from insole_studio.texts import tr
from insole_studio.widgets.layouts import VerticalScroll, keep_room
from insole_studio.widgets.legend import SwatchLegend
from insole_studio.widgets.message_label import MessageLabel, ProgressBar
from insole_studio.widgets.model_view import ModelView

_FORM_PX, _CHECKS_PX = 320, 376
_WIDE_PX, _WIDE_FORM_PX = 1200, 360
"""From this width of the stage on, the form has room for the names of all blocks of the shop."""


class ExportView(QWidget):
    """The export panel; emits the user's intents."""

    choice_edited = Signal(object)
    order_chosen = Signal(bool)
    material_edited = Signal(object, str)
    blocks_requested = Signal()
    responsible_requested = Signal()
    deliver_on_edited = Signal(str)
    cutter_edited = Signal(float)
    rule_edited = Signal(str, str, float)
    check_chosen = Signal(str)
    part_chosen = Signal(str)
    reason_edited = Signal(str)
    export_requested = Signal()
    cancel_requested = Signal()
    close_requested = Signal()

    def __init__(self, stock: Stock, dark: bool, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.form = OrderForm(stock)
        self.form.edited.connect(self.choice_edited)
        self.form.order_chosen.connect(self.order_chosen)
        self.form.material_edited.connect(self.material_edited)
        self.form.blocks_requested.connect(self.blocks_requested)
        self.form.responsible_requested.connect(self.responsible_requested)
        self.form.terms.deliver_on_edited.connect(self.deliver_on_edited)
        self.form.cutter.edited.connect(self.cutter_edited)
        self.model = ModelView(Subject.INSOLE, "", dark)
        self.model.preset_requested.connect(self.model.look_from)
        self.model.scene.camera_changed.connect(self._place_words)
        self.check_list = CheckList()
        self.check_list.rule_edited.connect(self.rule_edited)
        self.check_list.check_chosen.connect(self.check_chosen)
        self._parts = QButtonGroup(self)
        self._parts.setExclusive(True)
        self._part_row = QHBoxLayout()
        self.patient = QLabel()
        self.patient.setObjectName("numbers")
        self.summary, self.swatches = MessageLabel(), SwatchLegend()
        self.error, self.notes = MessageLabel("warning"), MessageLabel("warning")
        self._reason_label = QLabel(tr("Export all the same, because"))
        self.reason = QLineEdit()
        self.reason.setPlaceholderText(tr("Reason, for the record"))
        self.reason.setToolTip(tr("Why it is made although a check has failed; the papers say it"))
        self.reason.textEdited.connect(self.reason_edited)
        self._progress = ProgressBar()
        self.cancel = QPushButton(tr("Cancel"))
        keep_room(self.cancel)
        self.cancel.clicked.connect(self.cancel_requested)
        self.leave = QPushButton(tr("Close"))
        self.leave.clicked.connect(self.close_requested)
        self.leave.setToolTip(tr("Back to the design; what is chosen here is kept") + " (Esc)")
        self.export = QPushButton(tr("Export…"))
        self.export.setDefault(True)
        self.export.setShortcut(QKeySequence("Ctrl+Return"))
        self.export.setToolTip(tr("Write the files for the shop") + " (Ctrl+Enter)")
        self.export.clicked.connect(self.export_requested)
        self._form_area, self._checks_area = VerticalScroll(), VerticalScroll()
        self._form_area.setWidget(self.form)
        self._checks_area.setWidget(_stacked(self.notes, self.check_list))
        self._bounds: FloatArray | None = None
        self._side: Side | None = None
        self._lay_out()
        for area in (self._form_area, self._checks_area):
            area.needs_changed.connect(self._fit_sides)

    def show_patient(self, text: str) -> None:
        """Show whose insoles these are."""
        self.patient.setText(text)

    def show_choice(self, choice: OrderChoice, has_pair: bool) -> None:
        """Show an order; `has_pair` tells whether both feet can be made."""
        self.form.show_choice(choice, has_pair)

    def show_feet(self, feet: Sequence[OrderedFoot]) -> None:
        """Show the material of each foot that is made, and whose shell sets the walls."""
        self.form.show_feet(feet)

    def show_blocks(self, blocks: Sequence[Block]) -> None:
        """Offer blocks."""
        self.form.show_blocks(blocks)

    def show_release(
        self, chosen: Release, revised: Release | None, new_number: str, *, is_sample: bool
    ) -> None:
        """Show which order is exported, see `OrderForm.show_release`."""
        self.form.show_release(chosen, revised, new_number, is_sample=is_sample)

    def read_day(self) -> None:
        """Emit what is typed as the quantity and as the delivery date."""
        self.form.terms.read_typed()

    def forget_day(self) -> None:
        """Empty the delivery date, whatever is typed there."""
        self.form.terms.forget_day()

    def show_checks(self, rows: Sequence[CheckRow]) -> None:
        """Show the checks."""
        self.check_list.show_rows(rows)

    def show_parts(self, names: dict[str, str], chosen: str) -> None:
        """Show a choice of parts, unless there is only one.

        Parameters
        ----------
        names
            Text by key.
        chosen
            Key of the part being shown.
        """
        for button in self._parts.buttons():
            self._parts.removeButton(button)
            button.hide()  # it goes at the next turn, and must not stand beside the new ones
            button.deleteLater()
        for key, text in names.items() if len(names) > 1 else ():
            button = QToolButton()
            button.setText(text)
            button.setCheckable(True)
            button.setChecked(key == chosen)
            button.setProperty("part", key)
            button.clicked.connect(self._choose_part)
            self._parts.addButton(button)
            self._part_row.insertWidget(self._part_row.count() - 1, button)

    def show_part(
        self,
        mesh: TriangleMesh | None,
        foot: Foot | None,
        words: Side | None,
        again: bool,
        colors: PartColors | None = None,
    ) -> None:
        """Show a solid.

        Parameters
        ----------
        mesh
            The solid; None shows nothing.
        foot
            That it is for: its side, and where it comes from, stand on the badge; None for a pair.
        words
            Side that orients medial and lateral; None for a pair.
        again
            Whether the same part is shown again, so that the camera stays.
        colors
            Of its zones, or of the material that the cutter leaves; None for the material's.
        """
        self.swatches.show_swatches(() if colors is None else colors.swatches)
        if mesh is None:
            self.model.show_side(None)
            self.model.show_empty(tr("Here comes the piece, once it is made."), {})
            return
        if foot is None:
            self.model.show_side(None)
        else:
            self.model.show_side(foot.side, mirrored=foot.mirrored, scanned_on=foot.scanned_on)
        self._bounds, self._side = mesh.bounds_mm, words
        self.model.show_mesh(mesh, None if colors is None else colors.coloring)
        if not again:
            self.model.look_at_whole(mesh.bounds_mm)
        self._place_words()

    def show_spots(self, spots_mm: FloatArray, chosen_mm: FloatArray) -> None:
        """Mark the places (n, 3), mm, that violate a limit, those of the chosen check stronger."""
        self.model.scene.painter.show_spots(spots_mm, chosen_mm)
        self.model.scene.request_render()

    def show_block(self, edges: Sequence[FloatArray], again: bool) -> None:
        """Draw the edges of a block.

        Parameters
        ----------
        edges : (2, 3) each, mm
            An empty sequence removes the block.
        again
            Whether it is shown again, so that the camera stays.
        """
        if edges and not again:
            corners = np.concatenate(edges)
            self.model.look_at_whole(np.stack([corners.min(axis=0), corners.max(axis=0)]))
        painter = self.model.scene.painter
        painter.show_lines("block", edges, painter.scheme.accent, 2.0)
        self.model.scene.request_render()

    def look_at(self, place_mm: FloatArray, text: str) -> None:
        """Centre the view on a place (3,), mm, and write a text there."""
        scene = self.model.scene
        scene.painter.show_label(place_mm, text)
        scene.set_camera(scene.camera.centred(place_mm))

    def forget_label(self) -> None:
        """Remove the text written by `look_at`."""
        self.model.scene.painter.show_label(None, "")

    def show_summary(self, text: str) -> None:
        """Show a summary of the part."""
        self.summary.say(text)

    def show_notes(self, sentences: Sequence[str]) -> None:
        """Show notes; none hides the label."""
        self.notes.say_all(sentences)

    def show_error(self, sentence: str) -> None:
        """Show an error; an empty sentence hides it."""
        self.error.say(sentence)

    def show_progress(self, fraction: float, text: str) -> None:
        """Show the progress of a job (`fraction` 0 to 1); an empty text hides it."""
        self._progress.show_work(fraction, text)

    def show_buttons(self, buttons: Buttons) -> None:
        """Enable and disable the buttons."""
        self.export.setEnabled(buttons.export)
        self.cancel.setVisible(buttons.cancel)
        self.leave.setHidden(buttons.cancel)
        self.reason.setVisible(buttons.reason)
        self._reason_label.setVisible(buttons.reason)

    def showEvent(self, event: QShowEvent) -> None:
        """Set the widths of the columns, which depend on the style."""
        super().showEvent(event)
        self._fit_sides()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the form more room in a wide window."""
        super().resizeEvent(event)
        if _is_wide(event.oldSize()) != _is_wide(event.size()):
            self._fit_sides()

    def _fit_sides(self) -> None:
        form, checks = self._sides
        form_px = _WIDE_FORM_PX if _is_wide(self.size()) else _FORM_PX
        for (part, area), least_px in ((form, form_px), (checks, _CHECKS_PX)):
            for widget in area.findChildren(QWidget):
                widget.ensurePolished()
            part.setFixedWidth(max(least_px, area.needed_px))

    def _place_words(self) -> None:
        self.model.scene.painter.show_directions(self._side, self._bounds)

    def _choose_part(self) -> None:
        self.part_chosen.emit(self.sender().property("part"))

    def _lay_out(self) -> None:
        left, right, middle = QVBoxLayout(), QVBoxLayout(), QVBoxLayout()
        left.addWidget(_heading(tr("Order")))
        left.addWidget(self._form_area, 1)
        self._part_row.addStretch(1)
        middle.addLayout(self._part_row)
        middle.addWidget(self.model, 1)
        self.summary.setContentsMargins(8, 0, 8, 0)
        self.swatches.setContentsMargins(8, 0, 8, 0)
        middle.addWidget(self.swatches)
        middle.addWidget(self.summary)
        right.addWidget(_heading(tr("Checks")))
        right.addWidget(self._checks_area, 1)
        for widget in (self.error, self._reason_label, self.reason, self._progress):
            right.addWidget(widget)
        buttons = QHBoxLayout()
        buttons.addWidget(self.leave)
        buttons.addWidget(self.cancel)
        buttons.addWidget(self.export, 1)
        right.addLayout(buttons)
        layout = QHBoxLayout()
        parts = []
        for column in (left, middle, right):
            part = QWidget()
            column.setContentsMargins(0, 0, 0, 0)
            column.setSpacing(8)
            part.setLayout(column)
            layout.addWidget(part)
            parts.append(part)
        layout.setStretch(1, 1)
        self._sides = (parts[0], self._form_area), (parts[2], self._checks_area)
        whole = QVBoxLayout(self)
        whole.addWidget(self.patient)
        whole.addLayout(layout, 1)


def _is_wide(size: QSize) -> bool:
    return size.width() >= _WIDE_PX


def _stacked(*widgets: QWidget) -> QWidget:
    """Return widgets below each other, which scroll together however much there is to tell."""
    column = QWidget()
    layout = QVBoxLayout(column)
    layout.setContentsMargins(0, 0, 0, 0)
    for widget in widgets:
        layout.addWidget(widget)
    return column


def _heading(text: str) -> QLabel:
    label = QLabel(text)
    label.setObjectName("heading")
    return label
