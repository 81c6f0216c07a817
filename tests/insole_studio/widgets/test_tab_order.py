"""Tab goes in the order of reading, also to what came later."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QApplication,
    QGridLayout,
    QLineEdit,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)
from pytestqt.qtbot import QtBot

from insole_studio.widgets.tab_order import StageFrame, tab_stops


class Form(StageFrame):
    def __init__(self) -> None:
        super().__init__()
        self.column = QVBoxLayout(self)
        self.last = QLineEdit("last")
        inner = QWidget()
        grid = QGridLayout(inner)
        self.right, self.left = QLineEdit("right"), QLineEdit("left")
        grid.addWidget(self.left, 0, 0)
        grid.addWidget(self.right, 0, 1)
        area = QScrollArea()
        area.setWidget(inner)
        area.setWidgetResizable(True)
        self.column.addWidget(area)
        self.column.addWidget(self.last)


def test_tab_follows_the_layout_and_what_is_put_in_later(qtbot: QtBot) -> None:
    form = Form()
    qtbot.addWidget(form)
    late = QLineEdit("late")
    form.column.insertWidget(1, late)
    with qtbot.waitExposed(form):
        form.show()
    form.activateWindow()
    order = [form.left, form.right, late, form.last]
    assert list(tab_stops(form)) == order
    form.left.setFocus()
    for stop in [*order[1:], order[0]]:
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Tab)
        assert QApplication.focusWidget() is stop
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Backtab)
    assert QApplication.focusWidget() is form.last


def test_what_is_hidden_or_disabled_is_passed_by(qtbot: QtBot) -> None:
    form = Form()
    qtbot.addWidget(form)
    form.show()
    form.right.hide()
    form.last.setEnabled(False)
    assert list(tab_stops(form)) == [form.left]
