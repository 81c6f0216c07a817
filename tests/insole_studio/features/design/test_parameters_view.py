"""The parameters panel keeps the fields that it can keep."""

from __future__ import annotations

from dataclasses import replace

import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel
from pytestqt.qtbot import QtBot
from shiboken6 import isValid

from insole_studio.features.design.parameters.parameters_view import MOST_KEPT, ParametersView
from insole_studio.features.design.rows import ChoiceSpec, FieldGroup, FieldSpec
from insole_studio.widgets.form_parts import Fold
from insole_studio.widgets.number_field import NumberField, SliderField

HEIGHT = FieldSpec("pad.height", "height", "mm", 5.0, 0.0, 12.0, 0.5)
FIRM = ChoiceSpec("make.firm", "firmness", "soft", (("soft", "Soft"), ("hard", "Hard")))
PAD, MAKE = FieldGroup("Pelott", (HEIGHT,)), FieldGroup("Making", (FIRM,))


def posting(key: str, value: float = 3.0) -> FieldGroup:
    return FieldGroup("Posting", (FieldSpec(key, "angle", "°", value, -8.0, 8.0, 0.5),))


def field_of(view: ParametersView, key: str) -> NumberField:
    (field,) = (f for f in view.findChildren(NumberField) if f.property("key") == key)
    return field


@pytest.fixture
def view(qtbot: QtBot) -> ParametersView:
    view = ParametersView()
    qtbot.addWidget(view)
    view.show_groups([PAD, MAKE])
    view.resize(600, 150)
    view.show()
    view.activateWindow()
    qtbot.waitUntil(view.isActiveWindow)
    return view


def test_a_group_whose_values_changed_keeps_its_fields_beside_a_new_one(
    view: ParametersView, qtbot: QtBot
) -> None:
    field = field_of(view, HEIGHT.key)
    field.setFocus()
    posting = FieldGroup("Posting", (replace(HEIGHT, key="posting.angle", unit="°"),))
    view.show_groups([posting, replace(PAD, fields=(replace(HEIGHT, value=7.0),))])
    assert field_of(view, HEIGHT.key) is field
    assert field.value() == 7.0
    assert QApplication.focusWidget() is field
    new = field_of(view, "posting.angle").parentWidget()
    qtbot.waitUntil(lambda: 0 < new.x() < field.parentWidget().x())


def test_groups_make_room_for_a_new_one_before_them(view: ParametersView, qtbot: QtBot) -> None:
    kept = field_of(view, HEIGHT.key).parentWidget()
    before = kept.x()
    slope = FieldGroup("Rocker", (replace(HEIGHT, key="rocker.slope", unit="°"),))
    view.show_groups([slope, PAD, MAKE])
    new = field_of(view, "rocker.slope").parentWidget()
    qtbot.waitUntil(lambda: kept.x() >= new.geometry().right() > before)


def test_the_focus_goes_to_the_field_of_the_same_key(view: ParametersView) -> None:
    before = field_of(view, HEIGHT.key)
    before.setFocus()
    view.show_groups([replace(PAD, fields=(replace(HEIGHT, unit="cm"),)), MAKE])
    focused = QApplication.focusWidget()
    assert focused is not before
    assert focused is not None
    assert focused.property("key") == HEIGHT.key


def test_no_other_field_takes_what_is_typed_into_one_that_goes(view: ParametersView) -> None:
    field_of(view, HEIGHT.key).setFocus()
    view.show_groups([MAKE])
    assert QApplication.focusWidget() is None


def test_the_fields_of_a_group_that_went_return_with_the_values_of_another_thing(
    view: ParametersView,
) -> None:
    field = field_of(view, HEIGHT.key)
    view.show_groups([MAKE])
    assert not field.isVisible()
    assert [f for f in view.findChildren(NumberField) if f.property("key")] == []
    other = replace(HEIGHT, value=9.0, least=2.0, greatest=10.0)
    view.show_groups([FieldGroup("Heel lift", (other,), note="beside the pelott"), MAKE])
    assert field_of(view, HEIGHT.key) is field
    assert field.isVisible()
    assert (field.value(), field.minimum(), field.maximum()) == (9.0, 2.0, 10.0)
    shown = {label.text() for label in view.findChildren(QLabel) if label.isVisible()}
    assert shown == {"Heel lift", "beside the pelott", "height", "Making", "firmness"}
    edited: list[tuple[str, object]] = []
    view.field_edited.connect(lambda *what: edited.append(what))
    field.setValue(9.5)
    assert edited == [(HEIGHT.key, 9.5)]


IN_OTHER_WORDS = {
    "language": replace(HEIGHT, label="höjd"),
    "tip": replace(HEIGHT, tip="how high"),
    "step": replace(HEIGHT, step=0.1),
}


@pytest.mark.parametrize("change", IN_OTHER_WORDS)
def test_fields_in_other_words_or_steps_are_others(view: ParametersView, change: str) -> None:
    before = field_of(view, HEIGHT.key)
    view.show_groups([FieldGroup("Pelott", (IN_OTHER_WORDS[change],)), MAKE])
    now = field_of(view, HEIGHT.key)
    assert now is not before
    view.show_groups([PAD, MAKE])
    assert field_of(view, HEIGHT.key) is before


def test_two_groups_of_the_same_key_are_kept_apart(view: ParametersView) -> None:
    first = field_of(view, HEIGHT.key)
    view.show_groups([posting(HEIGHT.key)])
    second = field_of(view, HEIGHT.key)
    for _ in range(2):
        view.show_groups([PAD])
        assert field_of(view, HEIGHT.key) is first
        assert (first.isVisible(), second.isVisible()) == (True, False)
        view.show_groups([posting(HEIGHT.key, -2.0)])
        assert field_of(view, HEIGHT.key) is second
        assert (first.isVisible(), second.isVisible()) == (False, True)
        assert (first.value(), second.value()) == (5.0, -2.0)


def test_what_is_half_typed_or_half_dragged_does_not_return(view: ParametersView) -> None:
    typed = field_of(view, HEIGHT.key)
    typed.setFocus()
    typed.selectAll()
    QTest.keyClicks(typed, "-")
    view.show_groups([MAKE])
    view.show_groups([PAD])
    assert field_of(view, HEIGHT.key).text() == "5.0 mm"
    cup = FieldGroup("Device", (replace(HEIGHT, key="device.cup", slider=True),))
    view.show_groups([cup])
    (held,) = view.findChildren(SliderField)
    held.slider.setSliderDown(True)
    view.show_groups([PAD])
    view.show_groups([cup])
    (shown,) = (f for f in view.findChildren(SliderField) if f.isVisible())
    assert shown is not held


def test_a_group_for_experts_returns_as_it_was_left_in_another_shape(view: ParametersView) -> None:
    short = FieldGroup("Expert", (HEIGHT,), folds=True)
    long = replace(short, fields=(HEIGHT, replace(HEIGHT, key="pad.width")))
    view.show_groups([short])
    before = field_of(view, HEIGHT.key)
    for is_open in (True, False):
        view.show_groups([long])
        (fold,) = (fold for fold in view.findChildren(Fold) if fold.isVisible())
        fold.click()
        assert field_of(view, HEIGHT.key).isVisible() is is_open
        view.show_groups([short])
        assert field_of(view, HEIGHT.key) is before
        assert before.isVisible() is is_open


def test_only_the_groups_that_went_last_are_kept(view: ParametersView) -> None:
    view.show_groups([posting("posting.0")])
    first = field_of(view, "posting.0")
    for number in range(1, MOST_KEPT + 2):
        view.show_groups([posting(f"posting.{number}")])
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    assert not isValid(first)
    fields = view.findChildren(NumberField)
    assert len(fields) == MOST_KEPT + 1
    view.show_groups([posting("posting.1")])
    assert field_of(view, "posting.1") in fields
