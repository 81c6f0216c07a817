"""The rows of checks, in a narrow column and by the mouse."""

from __future__ import annotations

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from insole_studio.features.export.check_list import CheckList
from insole_studio.features.export.rows import CheckRow, CheckState

COLUMN_PX = 376
ROW = CheckRow("thickness", "Least thickness", CheckState.PASSED, "ok", "warning", 1.0, "mm", True)
LONG = "2.2 mm at the thinnest place; 2.0 mm is the least of its material, and of no other one here"


@pytest.fixture
def checks(qtbot: QtBot) -> CheckList:
    made = CheckList()
    qtbot.addWidget(made)
    made.show_rows([ROW])
    made.resize(COLUMN_PX, 200)
    made.show()
    return made


def test_a_long_sentence_goes_on_in_the_next_line(checks: CheckList) -> None:
    sentence = checks.rows["thickness"].sentence
    one_line_px = sentence.height()
    checks.show_rows([replace(ROW, sentence=LONG)])
    assert checks.minimumSizeHint().width() < COLUMN_PX  # else the column is cut at its right
    QTest.qWait(0)
    assert sentence.height() > 1.5 * one_line_px
    label = sentence.findChild(QLabel)
    assert isinstance(label, QLabel)
    assert label.height() >= label.heightForWidth(label.width())
    assert sentence.text() == sentence.accessibleName() == f"{LONG}  ›"


def test_a_click_or_a_key_on_the_sentence_leads_to_its_place(
    checks: CheckList, qtbot: QtBot
) -> None:
    sentence = checks.rows["thickness"].sentence
    with qtbot.waitSignal(checks.check_chosen) as chosen:
        QTest.mouseClick(sentence, Qt.MouseButton.LeftButton)
    assert chosen.args == ["thickness"]
    with qtbot.waitSignal(checks.check_chosen):
        QTest.keyClick(sentence, Qt.Key.Key_Space)
