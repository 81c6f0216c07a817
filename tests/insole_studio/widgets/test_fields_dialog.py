"""A dialog that asks for several lines says what is missing before it can be accepted."""

from __future__ import annotations

from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from insole_studio.widgets.form_parts import Field, FieldsDialog


def test_the_grey_button_says_which_lines_are_missing(qtbot: QtBot) -> None:
    fields = (Field("a", "Maker"), Field("b", "Clinic", required=False), Field("c", "Address"))
    dialog = FieldsDialog("Names", "Who makes it?", fields)
    qtbot.addWidget(dialog)
    button = dialog.accept_button
    assert not button.isEnabled()
    assert button.toolTip() == button.accessibleDescription() == "Still missing: Maker, Address"
    QTest.keyClicks(dialog.lines["a"], "Sula")
    assert button.toolTip() == button.accessibleDescription() == "Still missing: Address"
    QTest.keyClicks(dialog.lines["c"], "Lund")
    assert button.isEnabled()
    assert button.toolTip() == button.accessibleDescription() == ""
    dialog.lines["c"].setText(" ")
    assert not button.isEnabled()
