"""Choices by keyboard."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from insole_studio.widgets.form_parts import ComboBox

ALT, CONTROL = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.ControlModifier


@pytest.mark.parametrize("held", [ALT, CONTROL])
def test_letters_choose_and_those_of_menus_do_not(held: Qt.KeyboardModifier, qtbot: QtBot) -> None:
    box = ComboBox([("insole", "Insole, trimmed"), ("block", "Contact surface in a block")])
    qtbot.addWidget(box)
    box.show()
    QTest.keyClick(box, "c", held)
    assert box.currentData() == "insole"
    QTest.keyClick(box, "c")
    assert box.currentData() == "block"
