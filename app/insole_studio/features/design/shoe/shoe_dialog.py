"""Asks for the shoe that an insole is to lie in: none, one of a size, or that of a last."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.errors import InputError
from insole_core.insole.fields import ranges_of
from insole_core.insole.prescription.outline import Shoe
from insole_core.insole.shoes.shoe_sizes import (
    LEAST_WIDTH_MM,
    MOST_WIDTH_MM,
    REGULAR,
    ShoeTable,
)
from insole_core.messages import Message
from insole_studio.texts import fill, tr, translate_core_message
from insole_studio.widgets.form_parts import ComboBox, mark_labels
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.number_field import NumberField

_ANY, _SIZE, _LAST, _KEPT = "any", "size", "last", "kept"
_MEASURED = "measured"
_USUAL_SYSTEM, _WIDTH_PX = "EU", 460


class ShoeDialog(QDialog):
    """The shoe of one insole.

    Parameters
    ----------
    table
        The sizes.
    shoe
        What the design has now.
    usual_size_eu
        For a foot of this length; None where that is a guess.
    fit
        Says where the insole is wider than a shoe, and what else is unusual; nothing if it fits.
    """

    last_wanted = Signal()

    def __init__(
        self,
        table: ShoeTable,
        shoe: Shoe | None,
        usual_size_eu: float | None,
        fit: Callable[[Shoe], Sequence[str]],
        parent: QWidget | None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Shoe"))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setMinimumWidth(_WIDTH_PX)
        self._table, self._given, self._fit = table, shoe, fit
        self._of_last: Shoe | None = None
        self._has_size = usual_size_eu is not None
        self.kind = ComboBox(_kinds(shoe))
        self.system = ComboBox([(one.name, _said(one.name)) for one in table.systems])
        self.size_field = NumberField("", least=0, greatest=400, step=0.5)
        self.width_field = ComboBox(
            [*((name, _said(name)) for name in table.widths_mm), _measured()]
        )
        self.inside = NumberField("mm", least=LEAST_WIDTH_MM, greatest=MOST_WIDTH_MM, step=1)
        self.browse = QPushButton(tr("Choose the last…"))
        self.trim = QCheckBox(tr("Trim the insole to the shoe"))
        room = ranges_of(Shoe)["clearance_mm"]
        self.clearance = NumberField("mm", least=room.least, greatest=room.greatest, step=0.5)
        self.note = MessageLabel("warning")
        self.buttons = QDialogButtonBox()
        role = QDialogButtonBox.ButtonRole
        self.take_button = self.buttons.addButton(tr("Use this shoe"), role.AcceptRole)
        self.buttons.addButton(tr("Cancel"), role.RejectRole)
        self._lay_out()
        self._show_given(shoe, usual_size_eu)
        self._connect()
        self.refresh()

    def shoe(self) -> Shoe | None:
        """Return the chosen shoe; None for any.

        Raises
        ------
        InputError
            When there is no such size, or no last is chosen yet.
        """
        found = self._found()
        if found is None:
            return None
        return replace(found, trim=self.trim.isChecked(), clearance_mm=self.clearance.value())

    def show_last(self, shoe: Shoe) -> None:
        """Show the last that was read."""
        self._of_last = shoe
        self.browse.setText(fill(tr("Last: {name}…"), name=shoe.name))
        self.refresh()

    def refuse_last(self, sentence: str) -> None:
        """Say why a file was not taken."""
        self._of_last = None
        self.refresh()
        self.note.say(sentence)
        self._make_room()

    def refresh(self, _value: object = None) -> None:
        """Show the fields of the chosen kind, and how the insole lies in the shoe."""
        self._show_fields()
        self._tell()
        self._make_room()

    def _show_fields(self) -> None:
        kind = self.kind.currentData()
        for field in (self.system, self.size_field, self.width_field):
            self._form.setRowVisible(field, kind == _SIZE)
        self._form.setRowVisible(
            self.inside, kind == _SIZE and self.width_field.currentData() == _MEASURED
        )
        self._form.setRowVisible(self.browse, kind == _LAST)
        for row in (self.trim, self.clearance):
            self._form.setRowVisible(row, kind != _ANY)
        self.clearance.setEnabled(self.trim.isChecked())

    def _tell(self) -> None:
        try:
            shoe = self.shoe()
        except InputError as error:
            self.note.say(str(error))
            self.take_button.setEnabled(False)
            return
        self.note.say_all([] if shoe is None else self._fit(shoe))
        self.take_button.setEnabled(True)

    def _make_room(self) -> None:
        """Grow with the rows; else they would be squeezed."""
        self._outer.activate()
        self.resize(self.width(), max(self.height(), self.sizeHint().height()))

    def _found(self) -> Shoe | None:
        kind = self.kind.currentData()
        if kind == _ANY:
            return None
        if kind == _KEPT:
            return self._given
        if kind == _LAST:
            if self._of_last is None:
                raise InputError("No last is chosen yet; choose its file.")
            return self._of_last
        if not self._has_size:
            raise InputError(
                "Heel or toes of this foot were not scanned: its length is a guess, so no size is "
                "proposed. Put in the size of the shoe."
            )
        system, width = (
            self._table.system(self.system.currentData()),
            self.width_field.currentData(),
        )
        if width == _MEASURED:
            return self._table.shoe(system, self.size_field.value(), width_mm=self.inside.value())
        return self._table.shoe(system, self.size_field.value(), width)

    def _lay_out(self) -> None:
        self._form = QFormLayout()
        self._form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        for label, field in (
            (tr("Shoe"), self.kind),
            (tr("Sizes"), self.system),
            (tr("Size"), self.size_field),
            (tr("Width"), self.width_field),
            (tr("Inside at the ball"), self.inside),
            (tr("File"), self.browse),
        ):
            self._form.addRow(label, field)
        self._form.addRow(self.trim)
        self._form.addRow(tr("Room that stays"), self.clearance)
        mark_labels(self._form)
        self._outer = layout = QVBoxLayout(self)
        layout.setSpacing(12)
        layout.addLayout(self._form)
        layout.addWidget(self.note)
        layout.addStretch(1)
        layout.addWidget(self.buttons)

    def _show_given(self, shoe: Shoe | None, usual_size_eu: float | None) -> None:
        self.kind.show_value(_ANY if shoe is None else _KEPT)
        self.system.show_value(_USUAL_SYSTEM)
        self.size_field.show_value(round(2 * (usual_size_eu or 0.0)) / 2)
        self.width_field.show_value(REGULAR)
        self.inside.show_value(95.0)
        self.trim.setChecked(shoe is not None and shoe.trim)
        self.clearance.show_value(0.5 if shoe is None else shoe.clearance_mm)

    def _note_size(self) -> None:
        self._has_size = True

    def _connect(self) -> None:
        self.size_field.edited.connect(self._note_size)
        for field in (
            self.kind, self.system, self.size_field, self.width_field, self.inside, self.clearance,
        ):  # fmt: skip
            field.edited.connect(self.refresh)
        self.trim.toggled.connect(self.refresh)
        self.browse.clicked.connect(self.last_wanted)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)


def _kinds(shoe: Shoe | None) -> list[tuple[str, str]]:
    kept = [] if shoe is None else [(_KEPT, shoe.name)]
    return [(_ANY, tr("any shoe")), *kept, (_SIZE, tr("by its size")), (_LAST, tr("by its last"))]


def _said(name: str) -> str:
    """Return a name of the table in the user's language."""
    return translate_core_message(Message(name))


def _measured() -> tuple[str, str]:
    return _MEASURED, tr("measured inside")
