"""The measuring tape on foot and insole, by real mouse and key events in the real window."""

from __future__ import annotations

import re

import numpy as np
import pytest
from pointing import LEFT, drag, pixel
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from insole_core.insole.elements import Pelott
from insole_studio.app.bootstrap import Application
from insole_studio.scene.scene_view import SceneView

pytestmark = [pytest.mark.slow, pytest.mark.one_window]

CONTROL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def foot(opened: Application) -> SceneView:
    keys = opened.stage.foot.scene.surface
    QTest.keyClick(keys, Qt.Key.Key_M, Qt.KeyboardModifier.ShiftModifier)
    assert opened.stage.tool_controller.tool.key == "tape"
    return opened.stage.foot.scene


def click(view: SceneView, x_mm: float, y_mm: float) -> None:
    QTest.mouseClick(view.surface, LEFT, pos=pixel(view, x_mm, y_mm))


def told(app: Application) -> list[float]:
    """Give the lengths along the surface and straight that the status line tells."""
    QApplication.processEvents()
    hint = app.stage.tool_controller.tool.hint(app.case)
    return [float(number) for number in re.findall(r"(\d+\.\d) mm", hint)]


def written(view: SceneView) -> bool:
    """Tell whether the length stands beside a tape in a view."""
    return {"guide", "label-labels"} <= view.painter.shown


def test_a_tape_is_laid_led_on_dragged_and_taken_back(opened: Application, foot: SceneView) -> None:
    before = opened.case.record
    click(foot, 0.0, 100.0)
    assert told(opened) == []
    click(foot, 0.0, 150.0)
    along, straight = told(opened)
    assert straight == pytest.approx(50.0, abs=1.0)
    assert straight <= along < straight + 1.0, "the sole is nearly flat here"
    assert written(foot)
    assert not written(opened.stage.insole.scene)
    click(foot, 0.0, 190.0)
    assert told(opened)[1] == pytest.approx(90.0, abs=1.5)
    last = next(h for h in foot.handles if h.name == "tape:2")
    end = pixel(foot, *last.position_mm)
    drag(foot, end, end + QPoint(0, -20))
    assert told(opened)[1] > 95.0
    undo = opened.window.actions_by_key["undo"]
    assert undo.isEnabled()
    for left in (2, 0, 0):
        QTest.keyClick(foot.surface, Qt.Key.Key_Z, CONTROL)
        assert len(told(opened)) == left
    assert not written(foot)
    assert not undo.isEnabled()
    assert opened.case.record is before, "the tape is no part of the prescription"


@pytest.mark.own_window
@pytest.mark.fine
def test_a_tape_over_a_pad_is_longer_than_the_straight_way_and_goes_with_a_changed_insole(
    opened: Application, foot: SceneView
) -> None:
    insole, design = opened.stage.insole.scene, opened.case.record.design
    assert design is not None
    pad = Pelott(centre_mm=(0.0, 120.0), height_mm=10.0, length_mm=50.0, width_mm=30.0)
    opened.case.apply(design.with_added(pad), "Place")
    click(insole, 0.0, 85.0)
    click(insole, 0.0, 155.0)
    along, straight = told(opened)
    heights = opened.stage.preview.heights_mm(
        np.column_stack([np.zeros(701), np.linspace(85.0, 155.0, 701)])
    )
    over_mm = np.hypot(np.diff(heights), 0.1).sum()
    assert straight + 1.0 < along <= over_mm + 0.2
    click(foot, 0.0, 100.0)
    assert told(opened) == []
    click(insole, 0.0, 85.0)
    click(insole, 0.0, 155.0)
    assert written(insole)
    opened.case.undo()
    assert told(opened) == []
    assert not written(insole)


def test_escape_puts_the_tape_away_before_the_tool_and_a_double_click_ends_it(
    opened: Application, foot: SceneView
) -> None:
    click(foot, 0.0, 100.0)
    click(foot, 0.0, 150.0)
    camera = foot.camera
    QTest.mouseDClick(foot.surface, LEFT, pos=pixel(foot, 0.0, 150.0))
    assert foot.camera == camera
    click(foot, 5.0, 80.0)
    assert told(opened) == [], "another one begins"
    click(foot, 5.0, 120.0)
    assert len(told(opened)) == 2
    QTest.keyClick(foot.surface, Qt.Key.Key_Escape)
    assert told(opened) == []
    assert not written(foot)
    assert opened.stage.tool_controller.tool.key == "tape"
    QTest.keyClick(foot.surface, Qt.Key.Key_Escape)
    assert opened.stage.tool_controller.tool.key == "orbit"


def test_a_tape_is_laid_by_keys_alone(opened: Application, foot: SceneView) -> None:
    for key in (Qt.Key.Key_Home, Qt.Key.Key_Return, *[Qt.Key.Key_Up] * 10, Qt.Key.Key_Return):
        QTest.keyClick(foot.surface, key)
    along, straight = told(opened)
    assert along >= straight > 2.0
    QTest.keyClick(foot.surface, Qt.Key.Key_Delete)
    assert told(opened) == []
