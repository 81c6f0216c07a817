from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import QLocale, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from insole_studio.widgets.number_field import NumberField


@pytest.fixture(params=["en_GB", "sv_SE"])
def field(request: pytest.FixtureRequest, qapp: QApplication) -> Iterator[NumberField]:
    field = NumberField("mm", least=0.0, greatest=100.0, step=0.5)
    field.setLocale(QLocale(request.param))
    field.show_value(6.0)
    field.show()
    yield field
    field.close()
    field.deleteLater()


def typed(field: NumberField, text: str) -> float:
    field.selectAll()
    QTest.keyClicks(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)
    return field.value()


@pytest.mark.parametrize("text", ["7.5", "7,5"])
def test_comma_and_point_both_work(field: NumberField, text: str) -> None:
    assert typed(field, text) == 7.5


def test_letters_are_not_taken(field: NumberField) -> None:
    assert typed(field, "abc") == 6.0


@pytest.mark.parametrize(
    ("modifier", "value"),
    [
        (Qt.KeyboardModifier.NoModifier, 6.5),
        (Qt.KeyboardModifier.ShiftModifier, 11.0),
        (Qt.KeyboardModifier.ControlModifier, 6.1),
    ],
)
def test_arrows_nudge(field: NumberField, modifier: Qt.KeyboardModifier, value: float) -> None:
    QTest.keyClick(field, Qt.Key.Key_Up, modifier)
    assert field.value() == pytest.approx(value)


def test_the_unit_is_shown(field: NumberField) -> None:
    assert field.text().endswith(" mm")


def test_only_the_user_edits(field: NumberField) -> None:
    heard: list[float] = []
    field.edited.connect(heard.append)
    field.show_value(9.0)
    assert heard == []
    QTest.keyClick(field, Qt.Key.Key_Down)
    assert heard == [8.5]
