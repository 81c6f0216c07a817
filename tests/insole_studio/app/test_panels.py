"""The panels of the window float, come back, close and share a place, with real GL."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from conftest import plantar_foot
from image_colors import colors_of
from pointing import LEFT
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QDockWidget
from pytestqt.qtbot import QtBot

from insole_core.cases.scan_source import ScanSource
from insole_core.geometry.side import Side
from insole_studio.app.bootstrap import Application
from insole_studio.scene.scene_view import SceneView

pytestmark = pytest.mark.display


def press(dock: QDockWidget, button: str) -> None:
    """Click a button in the title of a panel."""
    found = dock.findChild(QAbstractButton, f"qt_dockwidget_{button}button")
    assert found is not None
    QTest.mouseClick(found, LEFT)
    QApplication.processEvents()


def is_drawn(scene: SceneView) -> bool:
    """Return whether the screen shows a model, and not one colour or a gradient."""
    picture = colors_of(scene.surface.grabFramebuffer())  # type: ignore[attr-defined]
    return bool(picture.std(axis=(0, 1)).max() > 10)


def walk_through(app: Application, is_seen: Callable[[], bool], qtbot: QtBot) -> None:
    """Float, dock, close and open every panel, move it to another side and into a tab."""
    window = app.window
    docks = {dock.objectName(): dock for dock in window.findChildren(QDockWidget)}
    assert set(docks) == {f"dock-{n}" for n in ("patient", "foot", "parameters", "section", "rim")}
    for dock in docks.values():
        area = window.dockWidgetArea(dock)
        if dock.isHidden():
            dock.toggleViewAction().trigger()
        press(dock, "float")
        assert dock.isFloating()
        qtbot.waitUntil(is_seen)
        press(dock, "close")
        assert dock.isHidden()
        dock.toggleViewAction().trigger()
        press(dock, "float")
        assert not dock.isFloating()
        window.addDockWidget(Qt.DockWidgetArea.TopDockWidgetArea, dock)
        QApplication.processEvents()
        window.addDockWidget(area, dock)
    qtbot.waitUntil(is_seen)
    window.tabifyDockWidget(docks["dock-patient"], docks["dock-foot"])
    QApplication.processEvents()
    window.showMinimized()
    QApplication.processEvents()
    window.showNormal()
    docks["dock-foot"].raise_()
    qtbot.waitUntil(is_seen)


def test_every_panel_goes_wherever_it_can(app: Application, qtbot: QtBot) -> None:
    """Before there is a foot, and with one, which is drawn wherever its panel is."""
    scenes = app.stage.foot.scene, app.stage.insole.scene
    walk_through(app, lambda: not any(scene.is_open for scene in scenes), qtbot)

    def are_drawn() -> bool:
        shown = [scene for scene in scenes if not scene.visibleRegion().isEmpty()]
        return all(is_drawn(scene) for scene in shown)

    foot = app.window.findChild(QDockWidget, "dock-foot")
    assert isinstance(foot, QDockWidget)
    press(foot, "float")
    left = app.window.layout_state()
    app.case.open_foot(plantar_foot(Side.LEFT), ScanSource("mesh", "/nowhere/foot.ply", "0" * 64))
    qtbot.waitUntil(lambda: scenes[1].is_open and are_drawn())  # made where it floats
    press(foot, "float")
    walk_through(app, are_drawn, qtbot)
    assert app.window.restore_layout(*left)
    assert foot.isFloating()
    qtbot.waitUntil(are_drawn)
