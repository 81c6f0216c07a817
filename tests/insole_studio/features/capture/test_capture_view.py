"""What the capture stage shows of values, and which intents its buttons emit."""

from __future__ import annotations

from dataclasses import replace

import pytest
from pointing import LEFT
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QCheckBox,
    QLineEdit,
    QMenu,
    QPushButton,
    QToolButton,
)
from pytestqt.qtbot import QtBot

from insole_studio.acquisition.messages import Capability, LaserRange, Preset, Tuning
from insole_studio.features.capture.rows import CaptureOptions, CaptureRow, SensorRow
from insole_studio.features.capture.sensor_card import SensorCard
from insole_studio.features.capture.view import CaptureView
from insole_studio.view_names import view_text, views_text
from insole_studio.widgets.form_parts import ComboBox
from insole_studio.widgets.number_field import NumberField


@pytest.fixture
def view(qtbot: QtBot) -> CaptureView:
    opened = CaptureView(2.0)
    qtbot.addWidget(opened)
    opened.show()
    return opened


def button(view: CaptureView, text: str) -> QPushButton:
    return next(b for b in view.findChildren(QPushButton) if b.text() == text)


def test_what_a_capture_left_is_offered(view: CaptureView, qtbot: QtBot) -> None:
    view.show_capture(CaptureRow(button="Capture"))
    assert not button(view, "Go on with it").isVisible()
    view.show_capture(CaptureRow(button="Capture", offer="Two of three views are there."))
    with qtbot.waitSignal(view.resume_requested):
        button(view, "Go on with it").click()


def test_what_cannot_be_undone_is_asked_once(view: CaptureView, qtbot: QtBot) -> None:
    view.show_capture(CaptureRow(button="Capture", offer="Two of three views are there."))
    with qtbot.assertNotEmitted(view.discard_requested):
        button(view, "Discard it").click()
        assert not button(view, "Discard it").isVisible()
        button(view, "Keep them").click()
    button(view, "Discard it").click()
    with qtbot.waitSignal(view.discard_requested):
        button(view, "Delete the views for good").click()


def double_click(on: QPushButton) -> None:
    """Click twice at a place of the window; whatever is there by then gets the second click."""
    window = on.window()
    QTest.mouseDClick(window.windowHandle(), LEFT, pos=on.mapTo(window, on.rect().center()))


def test_a_double_click_deletes_one_capture_and_the_next_one_is_asked_about_anew(
    view: CaptureView, qtbot: QtBot
) -> None:
    view.resize(1200, 720)
    qtbot.waitExposed(view)
    left = ["The third.", "The second.", "The first."]
    view.discard_requested.connect(lambda: (left.pop(0), offer()))

    def offer() -> None:
        view.show_capture(CaptureRow(button="Capture", offer=left[0] if left else ""))

    def asks() -> list[str]:
        return [b.text() for b in view._offer.findChildren(QPushButton) if b.isVisible()]

    offer()
    first = ["Go on with it", "Discard it"]
    assert asks() == first
    double_click(button(view, "Discard it"))  # "Delete" or "Keep" comes under the pointer
    assert asks() == ["Delete the views for good", "Keep them"]
    assert len(left) == 3
    with qtbot.assertNotEmitted(view.resume_requested):
        double_click(button(view, "Delete the views for good"))
    assert left == ["The second.", "The first."]
    assert asks() == first
    QTest.mouseClick(button(view, "Discard it"), LEFT)
    view.show_capture(CaptureRow(button="Capture", offer=left[1]))  # another window took one
    assert asks() == first


def test_one_large_button_at_a_time(view: CaptureView, qtbot: QtBot) -> None:
    view.show_capture(CaptureRow(button="Capture", can_capture=True))
    assert button(view, "Capture").isDefault()
    assert not button(view, "The sensor stands").isVisible()
    view.show_capture(CaptureRow(running=True, button="Capture", waits_for_hand=True))
    assert not button(view, "Capture").isVisible()
    with qtbot.waitSignal(view.placed_requested):
        button(view, "The sensor stands").click()
    view.show_capture(CaptureRow(button="Capture anew", can_use=True, is_whole=True))
    assert button(view, "Use this scan").isDefault()
    assert not button(view, "Capture anew").isDefault()


def test_nothing_moves_when_a_capture_begins_and_ends(view: CaptureView) -> None:
    """Neither the large buttons nor those of the cards, which somebody is about to press."""
    view.resize(1000, 600)
    view.show_sensors([SensorRow("D1", "left", "left", "")])

    def places() -> dict[str, QRect]:
        QApplication.processEvents()
        buttons = [b for b in view.findChildren(QAbstractButton) if b.isVisible() and b.text()]
        corner = view.mapToGlobal(QPoint(0, 0))
        return {b.text(): QRect(b.mapToGlobal(QPoint(0, 0)) - corner, b.size()) for b in buttons}

    view.show_capture(CaptureRow(button="Capture", can_capture=True))
    before = places()
    assert {"Capture", "Use this scan", "Capture again"} <= before.keys()
    view.show_capture(CaptureRow(button="Capture", running=True, fraction=0.3))
    during = places()
    assert during.pop("Cancel").isValid()
    assert during == before
    view.show_capture(CaptureRow(button="Capture", can_capture=True))
    assert places() == before


def test_views_are_named_where_sensors_are_moved(view: CaptureView, qtbot: QtBot) -> None:
    field = next(f for f in view.findChildren(QLineEdit) if f.accessibleName() == "Views")
    assert not field.isVisible()
    view.show_options(CaptureOptions(mode="moved"))
    assert field.isVisible()
    assert field.text() == "left right top"
    field.setText("left, heel")
    with qtbot.waitSignal(view.options_edited) as signal:
        field.editingFinished.emit()
    assert signal.args[0].views == ("left", "heel")


def test_a_card_offers_what_its_sensor_can_be_set_to(view: CaptureView, qtbot: QtBot) -> None:
    row = SensorRow("D1", "left", "left", "")
    view.show_sensors([row])
    preset = next(c for c in view.findChildren(ComboBox) if "Preset" in c.accessibleName())
    light = next(f for f in view.findChildren(NumberField) if f.prefix() == "Light: ")
    assert not preset.isVisible()
    assert not light.isVisible()
    only = replace(row, capabilities=frozenset({Capability.PRESET}))
    view.show_sensors([only])
    assert (preset.isVisible(), light.isVisible()) == (True, False)
    strict = Tuning(Preset.HIGH_ACCURACY, 150.0)
    limits = LaserRange(0.0, 360.0, 30.0)
    can = frozenset({Capability.PRESET, Capability.LASER})
    both = replace(row, capabilities=can, tuning=strict, laser_range=limits)
    view.show_sensors([both])
    assert (preset.currentText(), light.text()) == ("High accuracy", "Light: 150 mW")
    with qtbot.waitSignal(view.tuning_edited) as edited:
        QTest.keyClick(preset, Qt.Key.Key_Down)
    assert edited.args == ["D1", Tuning(Preset.HIGH_DENSITY)]  # nothing else
    with qtbot.waitSignal(view.tuning_edited) as edited:
        QTest.keyClick(light, Qt.Key.Key_Up)
    assert edited.args == ["D1", Tuning(laser_mw=180.0)]
    pair = next(c for c in view.findChildren(QCheckBox) if c.text() == "Infrared pair")
    assert not pair.isVisible()
    paired = replace(strict, pair=False)
    view.show_sensors([replace(both, capabilities=can | {Capability.HAS_PAIR}, tuning=paired)])
    with qtbot.waitSignal(view.tuning_edited) as edited:
        QTest.keyClick(pair, Qt.Key.Key_Space)
    assert edited.args == ["D1", Tuning(pair=True)]
    light.setFocus()
    with qtbot.waitSignal(view.undo_requested):
        QTest.keyClick(light, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    with qtbot.waitSignal(view.redo_requested):
        QTest.keyClick(light, Qt.Key.Key_Y, Qt.KeyboardModifier.ControlModifier)
    view.show_sensors([replace(both, can_tune=False)])
    assert not preset.isEnabled()
    assert not light.isEnabled()


def test_bursts_are_no_choice_where_no_sensor_has_a_motor(view: CaptureView) -> None:
    field = next(f for f in view.findChildren(NumberField) if f.prefix() == "Bursts: ")
    view.show_options(CaptureOptions(bursts=3))
    view.show_capture(CaptureRow(can_tilt=False))
    assert (field.isEnabled(), field.value()) == (False, 1)
    assert "None of the sensors has a motor" in field.toolTip()
    view.show_capture(CaptureRow(can_tilt=True))
    assert (field.isEnabled(), field.value()) == (True, 3)
    assert "the motor tilts the sensor" in field.toolTip()
    view.show_capture(CaptureRow(running=True))
    assert not field.isEnabled()


def test_a_sensor_that_gave_several_views_has_a_menu_of_them(qtbot: QtBot) -> None:
    card = SensorCard("A1", 2.0)
    qtbot.addWidget(card)
    again = next(b for b in card.findChildren(QToolButton) if b.text() == "Capture again")
    asked: list[str] = []
    card.retake_requested.connect(asked.append)
    card.show_row(SensorRow("A1", "heel", "heel", ""))
    assert not again.isEnabled()
    card.show_row(SensorRow("A1", "heel", "heel", "", retakes=("heel",)))
    again.click()
    assert asked == ["heel"]
    card.show_row(SensorRow("A1", "heel", "heel", "", retakes=("left", "heel_2")))
    again.click()
    (menu,) = card.findChildren(QMenu)
    left, heel = menu.actions()
    assert (left.text(), heel.text()) == ("left", "heel_2")
    heel.trigger()
    menu.close()
    assert asked == ["heel", "heel_2"]


def test_a_sensor_is_asked_only_for_what_it_can_do(qtbot: QtBot) -> None:
    card = SensorCard("A1", 2.0)
    qtbot.addWidget(card)
    buttons = {button.text(): button for button in card.findChildren(QToolButton)}
    asked: list[str] = []
    card.level_requested.connect(asked.append)
    card.show_row(SensorRow("A1", "left", "left", "", capabilities=frozenset({Capability.BLINK})))
    buttons["Level"].click()
    assert not asked
    assert [text for text in ("Tilt −", "Level", "Identify") if buttons[text].isEnabled()] == [
        "Identify"
    ]
    card.show_row(SensorRow("A1", "left", "left", "", capabilities=frozenset(Capability)))
    buttons["Level"].click()
    assert asked == ["A1"]


def test_usual_views_and_their_bursts_have_words() -> None:
    assert views_text(("left", "top_2", "heel", "view_4")) == "left, top 2, heel, view_4"
    assert view_text("left_side") == "left_side"
