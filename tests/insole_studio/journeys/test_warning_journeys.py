"""What is unusual stands in words in the window: pads off the foot, pads on pads."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from pointing import LEFT, drag, pixel
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel

from insole_core.insole.prescription.design import InsoleDesign
from insole_studio.app.bootstrap import Application
from insole_studio.scene.scene_view import SceneView


@pytest.fixture
def view(opened: Application) -> SceneView:
    opened.window.actions_by_key["tool_pelott"].trigger()
    scene: SceneView = opened.stage.foot.scene
    return scene


def warnings(app: Application) -> list[QLabel]:
    QApplication.processEvents()  # a new line of a panel is shown by the next event
    labels = app.stage.patient.findChildren(QLabel, "warning")
    return [label for label in labels if label.isVisibleTo(app.stage.patient)]


def design(app: Application) -> InsoleDesign:
    assert app.case.record.design is not None
    return app.case.record.design


def saying(app: Application, words: str) -> list[QLabel]:
    return [label for label in warnings(app) if words in label.text()]


def test_a_pad_pushed_off_the_foot_is_warned_of_until_it_is_back(
    opened: Application, view: SceneView, settle: Callable[[], None]
) -> None:
    QTest.mouseClick(view.surface, LEFT, pos=pixel(view, 30.0, 110.0))
    settle()
    assert saying(opened, "below the foot") == []
    for _ in range(5):  # 5 mm each; seen from below, +x is on the left
        QTest.keyClick(view.surface, Qt.Key.Key_Left, Qt.KeyboardModifier.ShiftModifier)
    settle()
    (label,) = saying(opened, "below the foot")
    assert "of the pelott lie below the foot; move it inwards." in label.text()
    for _ in range(len(opened.case.history) - 1):
        opened.window.actions_by_key["undo"].trigger()
    settle()
    assert saying(opened, "below the foot") == []


def test_two_pads_on_one_place_are_warned_of_and_the_warning_leads_there(
    opened: Application, view: SceneView, settle: Callable[[], None]
) -> None:
    QTest.mouseClick(view.surface, LEFT, pos=pixel(view, -18.0, 110.0))
    opened.case.select(None)
    QTest.mouseClick(view.surface, LEFT, pos=pixel(view, 22.0, 110.0))
    first, second = design(opened).corrections
    settle()
    assert saying(opened, "heights add up") == []
    start, end = pixel(view, *second.centre_mm), pixel(view, *np.add(first.centre_mm, (12.0, 2.0)))
    drag(view, start, end)
    settle()
    (label,) = saying(opened, "heights add up")
    opened.case.select(None)
    label.linkActivated.emit(link(label))
    assert opened.case.selection in (first.id, second.id)


def link(label: QLabel) -> str:
    return label.text().split('"')[1]
