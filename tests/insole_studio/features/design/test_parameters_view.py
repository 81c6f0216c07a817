"""The parameters panel keeps the fields that it can keep."""

from __future__ import annotations

from dataclasses import replace

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_studio.features.design.parameters.parameters_view import ParametersView
from insole_studio.features.design.rows import ChoiceSpec, FieldGroup, FieldSpec
from insole_studio.widgets.number_field import NumberField

HEIGHT = FieldSpec("pad.height", "height", "mm", 5.0, 0.0, 12.0, 0.5)
FIRM = ChoiceSpec("make.firm", "firmness", "soft", (("soft", "Soft"), ("hard", "Hard")))
PAD, MAKE = FieldGroup("Pelott", (HEIGHT,)), FieldGroup("Making", (FIRM,))


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
