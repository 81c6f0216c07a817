"""The fields of what the shop is told beside the piece: quantity, colour, cover, day, remarks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

from PySide6.QtCore import QObject, QSignalBlocker, Signal
from PySide6.QtWidgets import QFormLayout, QLabel, QLineEdit, QWidget

from insole_core.export.shop_order import MOST_PAIRS, OrderTerms
from insole_core.workflows.make_order import Package
from insole_studio.texts import tr
from insole_studio.widgets.date_field import DateField
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.number_field import NumberField
from insole_studio.widgets.text_fields import NotesField


class TermsFields(QObject):
    """Shows the terms of an order, and emits when a field is edited."""

    edited = Signal()
    deliver_on_edited = Signal(str)
    """Emitted with the text of the delivery date, which may be none."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.package = ComboBox(
            [
                ("", tr("Single files")),
                ("zip", tr("One order, as a zip archive")),
                ("folder", tr("One order, as a folder")),
            ]
        )
        self.package.setToolTip(
            tr("An order holds all files for the shop, and a list by which they can be verified")
        )
        self.quantity = NumberField("", least=1, greatest=MOST_PAIRS, step=1, decimals=0)
        self.colour, self.cover, self.lot = QLineEdit(), QLineEdit(), QLineEdit()
        self.cover.setPlaceholderText(tr("What is glued on top"))
        self.deliver_on = DateField()
        self.remarks = NotesField()
        for named, tip in (
            (self.quantity, tr("How many are ordered")),
            (self.colour, tr("Colour of the material")),
            (self.cover, tr("What is glued on top")),
            (self.lot, tr("Number of the lot that the material comes from")),
            (self.deliver_on, tr("By which day the shop is to deliver")),
            (self.remarks, tr("What else the shop is to know, without the patient's name")),
        ):
            named.setToolTip(tip)
        self._terms = OrderTerms()
        for field in (self.package, self.quantity):
            field.edited.connect(self.edited)
        for line in (self.colour, self.cover, self.lot):
            line.textEdited.connect(self._pass_on)
        self.remarks.textChanged.connect(self._pass_on)
        self.deliver_on.editingFinished.connect(self.pass_on_day)

    @property
    def rows(self) -> Sequence[tuple[str, QWidget]]:
        """Names and fields, as they stand in the form."""
        return (
            (tr("Quantity"), self.quantity),
            (tr("Colour"), self.colour),
            (tr("Cover"), self.cover),
            (tr("Material lot"), self.lot),
            (tr("Delivery date"), self.deliver_on),
            (tr("Remarks"), self.remarks),
            (tr("Written as"), self.package),
        )

    def show_terms(self, terms: OrderTerms, package: Package) -> None:
        """Show terms; a day that is being typed is kept until it is one."""
        with QSignalBlocker(self):
            self.package.show_value(package)
            self.quantity.show_value(terms.quantity)
            texts = (
                (self.colour, terms.colour), (self.cover, terms.cover), (self.lot, terms.lot)
            )  # fmt: skip
            for line, text in texts:
                if line.text().strip() != text:
                    line.setText(text)
            if self.remarks.toPlainText().strip() != terms.remarks:
                self.remarks.setPlainText(terms.remarks)
            if terms.deliver_on != self._terms.deliver_on:
                day = terms.deliver_on
                self.deliver_on.setText("" if day is None else day.isoformat())
        self._terms = terms

    def forget_day(self) -> None:
        """Empty the delivery date, whatever is typed there."""
        self.deliver_on.clear()
        self._terms = replace(self._terms, deliver_on=None)

    def name_quantity(self, form: QFormLayout, *, is_pair: bool) -> None:
        """Say of what the quantity is."""
        label = form.labelForField(self.quantity)
        assert isinstance(label, QLabel)
        label.setText(tr("Pairs") if is_pair else tr("Pieces"))

    def terms(self) -> OrderTerms:
        """Return the terms; the delivery date is the last one that was read."""
        return replace(
            self._terms,
            quantity=int(self.quantity.value()),
            colour=self.colour.text().strip(),
            cover=self.cover.text().strip(),
            lot=self.lot.text().strip(),
            remarks=self.remarks.toPlainText().strip(),
        )

    def chosen_package(self) -> Package:
        """Return how the files are written."""
        return cast(Package, self.package.currentData())

    def _pass_on(self, _text: str = "") -> None:
        if not self.signalsBlocked():
            self.edited.emit()

    def read_typed(self) -> None:
        """Take up what is still being typed: a button need not take the focus from its field."""
        self.quantity.interpretText()
        self.pass_on_day()

    def pass_on_day(self) -> None:
        """Emit what is typed as the delivery date, also while the field has the focus."""
        self.deliver_on_edited.emit(self.deliver_on.text())
