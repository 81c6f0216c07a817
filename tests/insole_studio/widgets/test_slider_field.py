"""A slider beside its number: dragged values are shown, the last one is entered."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QStyle, QStyleOptionSlider
from pytestqt.qtbot import QtBot

from insole_studio.widgets.number_field import SliderField

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def field(qtbot: QtBot) -> SliderField:
    field = SliderField("mm", least=0.0, greatest=30.0, step=0.5)
    qtbot.addWidget(field)
    field.show()
    field.show_value(12.0)
    return field


def handle(field: SliderField) -> QPoint:
    option = QStyleOptionSlider()
    field.slider.initStyleOption(option)
    style, control = field.slider.style(), QStyle.ComplexControl.CC_Slider
    part = QStyle.SubControl.SC_SliderHandle
    return style.subControlRect(control, option, part, field.slider).center()


def test_a_drag_moves_and_a_release_enters_once(field: SliderField) -> None:
    moved: list[float] = []
    edited: list[float] = []
    field.moved.connect(moved.append)
    field.edited.connect(edited.append)
    start = handle(field)
    QTest.mousePress(field.slider, LEFT, pos=start)
    for right in (10, 20, 30):
        QTest.mouseMove(field.slider, start + QPoint(right, 0))
    assert moved == sorted(set(moved))
    assert moved[-1] > 15.0
    assert field.number.value() == moved[-1]
    assert edited == []
    QTest.mouseRelease(field.slider, LEFT, pos=start + QPoint(30, 0))
    assert edited == [moved[-1]]
    assert moved[-1] % 0.5 == 0


def test_escape_gives_a_drag_up(field: SliderField, qtbot: QtBot) -> None:
    start = handle(field)
    QTest.mousePress(field.slider, LEFT, pos=start)
    QTest.mouseMove(field.slider, start + QPoint(20, 0))
    with qtbot.waitSignal(field.cancelled), qtbot.assertNotEmitted(field.edited):
        QTest.keyClick(field.slider, Qt.Key.Key_Escape)
    field.show_value(12.0)
    with qtbot.assertNotEmitted(field.edited):
        QTest.mouseRelease(field.slider, LEFT, pos=start)
    assert field.slider.value() == 24


def test_what_lies_between_the_steps_is_typed(field: SliderField, qtbot: QtBot) -> None:
    field.number.selectAll()
    QTest.keyClicks(field.number, "13,2")
    with qtbot.waitSignal(field.edited) as edited:
        QTest.keyClick(field.number, Qt.Key.Key_Return)
    assert edited.args == [13.2]
    assert field.slider.value() == 26
    assert field.number.value() == 13.2


def test_a_shown_value_is_no_edit(field: SliderField, qtbot: QtBot) -> None:
    with qtbot.assertNotEmitted(field.edited), qtbot.assertNotEmitted(field.moved):
        field.show_range(5.0, 20.0)
        field.show_value(18.0)
    assert (field.slider.value(), field.number.value()) == (36, 18.0)
