"""A program for `test_scaled_window`: shows the window on a scaled screen, tells what is seen."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from coarse_designs import COARSE_MM
from conftest import plantar_foot
from image_colors import colors_of
from PySide6.QtCore import QEventLoop, QPoint
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QWidget

from insole_core.cases.scan_source import ScanSource
from insole_core.geometry.arrays import IntArray
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_studio.app.bootstrap import Application, build_application, qt_application
from insole_studio.app.scripted import wait_for
from insole_studio.scene.scene_view import SceneView
from insole_studio.user_paths import UserPaths

WIDTHS = (1001, 1006)
"""Of which the views get sides that end anywhere between the pixels of the screen."""


def black_lines(scene: SceneView, screen: IntArray, ratio: float) -> int:
    """Count the rows and columns of a view that are black from end to end."""
    corner, size = scene.mapToGlobal(QPoint(0, 0)), scene.size()
    left, top = int(corner.x() * ratio), int(corner.y() * ratio)
    right = int((corner.x() + size.width()) * ratio)
    bottom = int((corner.y() + size.height()) * ratio)
    black = screen[top:bottom, left:right].max(axis=2) < 8
    return int((black.mean(axis=0) > 0.5).sum() + (black.mean(axis=1) > 0.5).sum())


def is_within(window: QWidget) -> bool:
    """Return whether the screen has room for a window."""
    room, size = QGuiApplication.primaryScreen().availableGeometry(), window.size()
    return size.width() <= room.width() and size.height() <= room.height()


def resize(app: Application, width: int, height: int) -> None:
    """Give the window another size, and wait until both views are shown in theirs."""
    app.window.resize(width, height)
    while app.window._sharing.isActive():
        QApplication.processEvents()
    QApplication.processEvents()
    for view in (app.stage.foot, app.stage.insole):
        loop = QEventLoop()
        view.scene.surface.frameSwapped.connect(loop.quit)
        view.scene.surface.update()
        loop.exec()


def main() -> None:
    folder = Path(sys.argv[1])
    qt = qt_application()
    app = build_application(qt, UserPaths(folder / "settings.json", folder / "autosave"))
    app.window.show()
    seen = {"window is within": is_within(app.window)}
    design = InsoleDesign(Side.LEFT, grid_mm=COARSE_MM)
    app.case.open_foot(plantar_foot(Side.LEFT), ScanSource("mesh", "/nowhere", "0" * 64), design)
    wait_for(app.jobs)
    app.features.export.open()
    export = app.features.export.stage
    assert export is not None
    seen["export is within"] = is_within(export)
    export.close()
    large = QWidget()
    large.resize(4000, 3000)
    large.show()
    seen["any window is within"] = is_within(large)
    large.close()
    lines = 0
    for width in WIDTHS:
        resize(app, width, 641 + width % 10)
        ratio = app.window.devicePixelRatioF()
        screen = colors_of(QGuiApplication.primaryScreen().grabWindow(0).toImage())
        for scene in (app.stage.foot.scene, app.stage.insole.scene):
            lines += black_lines(scene, screen, ratio)
    app.autosave.forget()
    app.close()
    print(json.dumps({**seen, "black lines": lines}))


if __name__ == "__main__":
    main()
