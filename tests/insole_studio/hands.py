"""Does in the window what a user does, by real events, and counts it."""

from __future__ import annotations

import os
from pathlib import Path

from pointing import LEFT, drag, pixel
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton, QWidget

from insole_core.geometry.side import Side
from insole_studio.app.scripted import ScriptedWindow, grab, wait_for
from insole_studio.features.import_scan.import_dialog import ImportDialog
from insole_studio.scene.scene_view import SceneView
from insole_studio.widgets.number_field import NumberField

MANUAL = os.environ.get("INSOLE_STUDIO_MANUAL")
"""Where the pictures of the manual go; none are taken where it is empty."""
MANUAL_SIZE, SMALL_SIZE = (1366, 768), (960, 640)
"""Without GL every pixel costs time: only what is looked at is large."""


class Hands:
    """Does what a user does, by real events, and counts it."""

    def __init__(self, studio: ScriptedWindow) -> None:
        self.studio = studio
        self.app = studio.app
        self.actions = 0

    @property
    def view(self) -> SceneView:
        return self.app.stage.foot.scene

    def choose(self, key: str) -> None:
        """Click a button of the toolbar, or press its shortcut."""
        self.app.window.actions_by_key[key].trigger()
        self._done()

    def press(self, button: QWidget | None) -> None:
        assert button is not None
        QTest.mouseClick(button, LEFT)
        self._done()

    def type_into(self, field: QWidget, text: str) -> None:
        """Type into the field that has the focus."""
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)
        self._done()

    def open(self, path: Path, side: Side | None = None) -> None:
        """Choose a scan in the dialog, and its side where it does not say it."""
        self.studio.answers.path = path
        self.choose("open_archive")
        if side is not None:
            (dialog,) = self.app.window.findChildren(ImportDialog)
            QTest.mouseClick(dialog.sides[side], LEFT)
            QTest.mouseClick(dialog.open_button, LEFT)
            self.studio.settle()

    def take_notice(self, offer: str) -> None:
        """Press the button of a notice."""
        buttons = self.app.stage.notices.findChildren(QPushButton)
        (button,) = [b for b in buttons if b.isVisible() and b.text() == offer]
        self.press(button)

    def click(self, place: tuple[float, float]) -> None:
        QTest.mouseClick(self.view.surface, LEFT, pos=pixel(self.view, *place))
        self._done()

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        drag(self.view, pixel(self.view, *start), pixel(self.view, *end))
        self._done()

    def type(self, key: str, text: str) -> None:
        panel = self.app.stage.parameters
        field = next(f for f in panel.findChildren(NumberField) if f.property("key") == key)
        field.setFocus()
        field.selectAll()
        self.type_into(field, text)

    def pick_device(self, text: str) -> None:
        """Type what to search for in the open list, and take the first that is found."""
        view = self.app.features.design.devices.view
        assert view is not None
        self.type_into(view.search, text)

    def export(self, path: Path, picture: str = "") -> None:
        """Open the stage that checks, and export once the checks are done.

        Parameters
        ----------
        picture
            Name of the one that is taken of the stage for the manual; none by default.
        """
        self.studio.answers.path = path
        self.choose("export")
        stage = self.app.features.export.stage
        assert stage is not None
        wait_for(stage.jobs)
        self.press(stage.view.export)
        wait_for(stage.jobs)
        if MANUAL and picture:
            grab(stage, [stage.view.model.scene]).save(f"{MANUAL}/{picture}.png")
        stage.close()

    def picture(self, name: str) -> None:
        """Take a picture of the window for the manual."""
        if MANUAL:
            self.studio.screenshot(Path(MANUAL) / f"{name}.png")

    def _done(self) -> None:
        self.actions += 1
        self.studio.settle()
        wait_for(self.app.services.clinic.jobs)
        self.studio.settle()
