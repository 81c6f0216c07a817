from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import QLocale, Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QVBoxLayout, QWidget

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


@pytest.mark.parametrize("text", ["4 mm", "4mm", "4,0 mm", "+4"])
def test_the_unit_may_be_typed(field: NumberField, text: str) -> None:
    assert typed(field, text) == 4.0
    assert not field.refusal.isVisible()


@pytest.mark.parametrize("text", ["4", "4°", "4 °"])
def test_degrees_may_be_typed(qtbot, text: str) -> None:
    field = NumberField("°", least=-15.0, greatest=15.0, step=0.5)
    qtbot.addWidget(field)
    field.show()
    assert typed(field, text) == 4.0
    assert field.text().endswith("°")
    assert not field.refusal.isVisible()


@pytest.mark.parametrize(("text", "value"), [("3.25", 3.3), ("3,249", 3.2), ("0.04 mm", 0.0)])
def test_a_number_with_more_decimals_is_rounded_and_said(
    field: NumberField, text: str, value: float
) -> None:
    assert typed(field, text) == value
    said = field.refusal.text().replace(",", ".")
    bare = text.replace(",", ".").removesuffix(" mm")
    assert said == f"{bare} mm is taken as {value} mm."
    assert field.refusal.isVisible()
    assert typed(field, "4.5") == 4.5
    assert not field.refusal.isVisible()


@pytest.mark.parametrize("text", ["1e1", "2E1", "1+1", "1-1", "1a1", "4.5.6", "4 cm", "4 5"])
def test_no_key_is_swallowed_between_digits(field: NumberField, text: str) -> None:
    assert typed(field, text) == 6.0
    assert field.refusal.isVisible()


def test_letters_are_not_taken(field: NumberField) -> None:
    assert typed(field, "abc") == 6.0


@pytest.mark.parametrize("text", ["400", "-3", "100,5", "-0.1"])
def test_a_number_beyond_the_range_is_refused_in_words_and_never_shortened(
    field: NumberField, text: str
) -> None:
    heard: list[float] = []
    field.edited.connect(heard.append)
    assert typed(field, text) == 6.0
    assert heard == []
    assert field.refusal.isVisible()
    said = field.refusal.text().replace(",", ".")
    assert (
        said
        == f"{text.replace(',', '.')} mm cannot be taken; put in 0.0 to 100.0 mm. It stays 6.0 mm."
    )
    assert field.text().replace(",", ".") == "6.0 mm"
    QTest.keyClicks(field, "7")
    assert not field.refusal.isVisible()


def test_a_unit_that_is_refused_is_said_as_it_was_typed(field: NumberField) -> None:
    field.selectAll()
    QTest.keyClicks(field, "3.5 cm")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert field.refusal.text().startswith("3.5 cm cannot be taken; put in")


def test_what_is_typed_is_refused_when_the_field_is_left_as_well(field: NumberField) -> None:
    field.selectAll()
    QTest.keyClicks(field, "120")
    field.clearFocus()
    assert field.value() == 6.0
    assert "120" in field.refusal.text()


def test_a_refusal_goes_with_its_field(field: NumberField) -> None:
    typed(field, "400")
    assert field.refusal.isVisible()
    field.selectAll()
    field.hide()
    assert not field.refusal.isVisible()
    field.lineEdit().setText("500 mm")
    field.interpretText()
    assert field.value() == 6.0
    assert not field.refusal.isVisible()


def test_a_field_left_empty_says_nothing(field: NumberField) -> None:
    assert typed(field, "-") == 6.0
    assert not field.refusal.isVisible()


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


def test_undo_and_export_are_the_windows_own(qtbot):
    window = QWidget()
    qtbot.addWidget(window)
    field = NumberField("mm", least=0, greatest=20, step=0.5)
    QVBoxLayout(window).addWidget(field)
    asked: list[str] = []
    for keys in ("Ctrl+Z", "Ctrl+Shift+Z", "Ctrl+E"):
        QShortcut(QKeySequence(keys), window).activated.connect(lambda k=keys: asked.append(k))
    window.show()
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    field.setFocus()
    control, shift = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
    QTest.keyClick(field, Qt.Key.Key_Z, control)
    QTest.keyClick(field, Qt.Key.Key_Z, control | shift)
    QTest.keyClick(field, Qt.Key.Key_E, control)
    assert asked == ["Ctrl+Z", "Ctrl+Shift+Z", "Ctrl+E"]


def test_a_letter_is_the_key_of_a_tool_unless_a_number_is_being_typed(qtbot):
    window = QWidget()
    qtbot.addWidget(window)
    field = NumberField("mm", least=0.0, greatest=100.0, step=0.5)
    QVBoxLayout(window).addWidget(field)
    taken: list[str] = []
    QShortcut(QKeySequence("S"), window).activated.connect(lambda: taken.append("S"))
    window.show()
    window.activateWindow()
    qtbot.waitUntil(window.isActiveWindow)
    field.setFocus()
    field.selectAll()
    QTest.keyClick(field, Qt.Key.Key_4)
    QTest.keyClick(field, Qt.Key.Key_S)
    assert taken == []
    QTest.keyClick(field, Qt.Key.Key_Backspace)
    QTest.keyClick(field, Qt.Key.Key_Return)
    QTest.keyClick(field, Qt.Key.Key_S)
    assert taken == ["S"]
    assert field.value() == 4.0
    assert not field.refusal.isVisible()


@pytest.mark.parametrize("text", ["3", "4,9", "0.5"])
def test_a_number_too_small_to_be_known_is_refused_in_words(field: NumberField, text: str) -> None:
    field.allow_unknown(5.0)
    assert typed(field, text) == 6.0
    said = field.refusal.text().replace(",", ".").replace("100.0 mm. or", "100.0 mm, or")
    assert "put in 5.0 to 100.0 mm, or 0 if it is not known. It stays 6.0 mm." in said
    assert typed(field, "5") == 5.0
    assert typed(field, "0") == 0.0


def test_steps_leap_from_unknown_to_the_least(field: NumberField) -> None:
    field.allow_unknown(5.0)
    field.show_value(5.0)
    for key, value in ((Qt.Key.Key_Down, 0.0), (Qt.Key.Key_Up, 5.0), (Qt.Key.Key_Up, 5.5)):
        QTest.keyClick(field, key)
        assert field.value() == value
