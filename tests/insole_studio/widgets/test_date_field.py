"""A date is typed, or chosen in a calendar."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QDate, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QCalendarWidget, QWidget
from pytestqt.qtbot import QtBot

from insole_studio.widgets.date_field import DateField


@pytest.fixture
def field(qtbot: QtBot) -> DateField:
    shown = DateField("1970-02-28")
    qtbot.addWidget(shown)
    shown.show()
    shown.setFocus()
    return shown


def calendar_of(field: DateField) -> QCalendarWidget:
    (calendar,) = field.findChildren(QCalendarWidget)
    return calendar


@pytest.mark.parametrize(
    ("key", "modifier"),
    [
        (Qt.Key.Key_F4, Qt.KeyboardModifier.NoModifier),
        (Qt.Key.Key_Down, Qt.KeyboardModifier.AltModifier),
    ],
)
def test_the_calendar_opens_at_the_date_and_enters_the_chosen_one(
    field: DateField, qtbot: QtBot, key: Qt.Key, modifier: Qt.KeyboardModifier
) -> None:
    QTest.keyClick(field, key, modifier)
    calendar = calendar_of(field)
    assert calendar.selectedDate() == QDate(1970, 2, 28)
    days = calendar.findChild(QWidget, "qt_calendar_calendarview")
    QTest.keyClick(days, Qt.Key.Key_Right)
    with qtbot.waitSignal(field.editingFinished):
        QTest.keyClick(days, Qt.Key.Key_Return)
    assert field.text() == "1970-03-01"
    assert QApplication.activePopupWidget() is None


def test_a_text_that_is_no_date_opens_the_calendar_today(field: DateField) -> None:
    field.setText("soon")
    field.open_calendar()
    assert calendar_of(field).selectedDate() == QDate.currentDate()
    QTest.keyClick(calendar_of(field), Qt.Key.Key_Escape)
    assert field.text() == "soon"
