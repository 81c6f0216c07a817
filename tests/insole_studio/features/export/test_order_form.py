"""What is ticked in the order form is written."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtWidgets import QApplication

from insole_core.workflows.make_order import OrderChoice
from insole_studio.features.export.order_form import OrderForm, Stock


def test_a_prescription_that_is_not_written_is_not_ticked_and_comes_back(
    qapp: QApplication,
) -> None:
    form = OrderForm(Stock((), ()))
    edited: list[OrderChoice] = []
    form.edited.connect(edited.append)
    wanted = OrderChoice(prescription=True, package="zip")
    form.show_choice(wanted, has_pair=False)
    assert not form.prescription.isChecked()
    assert not form.prescription.isEnabled()
    form.terms.package.setCurrentIndex(form.terms.package.findData(""))
    form.terms.package.edited.emit("")
    assert edited[-1].prescription
    form.show_choice(edited[-1], has_pair=False)
    assert form.prescription.isChecked()
    form.show_choice(replace(edited[-1], package="folder"), has_pair=False)
    assert not form.prescription.isChecked()
    assert form.choice().prescription
    form.deleteLater()
