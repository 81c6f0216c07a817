"""The standard case from the opened scan to the file for the shop, counted action by action.

With ``INSOLE_STUDIO_MANUAL=docs/manual/images`` (and Xvfb) it also writes the pictures of the
manual.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from pointing import LEFT, drag, pixel
from PySide6.QtCore import QEventLoop, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from insole_core.geometry.side import Side
from insole_core.insole.design import Pelott, Posting
from insole_studio.bootstrap import Places
from insole_studio.scene.view import SceneView
from insole_studio.scripted import ScriptedStudio
from insole_studio.stages.export.stage import ExportStage
from insole_studio.widgets.number_field import NumberField
from insole_studio.workbench.landmarks import metatarsal_line

MOST_ACTIONS = 12
MANUAL = os.environ.get("INSOLE_STUDIO_MANUAL")
MANUAL_SIZE, SMALL_SIZE = (1366, 768), (960, 640)
"""Without GL every pixel costs time: only what is looked at is large."""


class Hands:
    """Does what a user does, by real events, and counts it."""

    def __init__(self, studio: ScriptedStudio, pictures: Path) -> None:
        self.studio = studio
        self.app = studio.app
        self.actions = 0
        self._pictures = pictures

    @property
    def view(self) -> SceneView:
        return self.app.stage.foot.scene

    def choose(self, key: str) -> None:
        """Click a button of the toolbar, or press its shortcut."""
        self.app.window.actions_by_key[key].trigger()
        self._done()

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
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)
        self._done()

    def export(self) -> None:
        """Press the button of the stage that checks and exports, once the checks are done."""
        stage = self.app.studio.rooms.exporting.checking.stage
        assert stage is not None
        self._wait(stage)
        stage.view.export.click()
        self._wait(stage)
        self._done()
        stage.grab().save(str(self._pictures / "6-checked.png"))
        stage.close()

    def _wait(self, stage: ExportStage) -> None:
        while stage.jobs.is_running():
            loop = QEventLoop()
            stage.jobs.ended.connect(loop.quit)
            loop.exec()
        QApplication.processEvents()

    def picture(self, name: str) -> None:
        """Take a picture of the window for the manual."""
        if MANUAL:
            self.studio.screenshot(self._pictures / f"{name}.png")

    def _done(self) -> None:
        self.actions += 1
        self.studio.settle()


@pytest.fixture
def hands(qapp: QApplication, places: Places, tmp_path: Path) -> Iterator[Hands]:
    pictures = Path(MANUAL) if MANUAL else tmp_path
    with ScriptedStudio(places, MANUAL_SIZE if MANUAL else SMALL_SIZE) as studio:
        yield Hands(studio, pictures)


def test_the_standard_case_takes_few_actions(
    hands: Hands, small_session: Path, tmp_path: Path
) -> None:
    hands.studio.open(small_session)
    case = hands.app.case
    assert case.side is Side.LEFT
    hands.picture("1-opened")

    hands.choose("tool_key_point")
    hands.picture("2-landmarks")
    hands.choose("confirm_landmarks")

    hands.choose("tool_pelott")
    line = metatarsal_line(case.record)
    assert line is not None
    x, y, _ = line[1]
    hands.click((x, y - 45.0))
    hands.drag((x, y - 45.0), (x, y - 42.0))
    hands.picture("3-pelott")

    hands.choose("tool_posting")
    case.select(None)
    hands.type("posting.rearfoot_deg", "4")
    hands.picture("4-posting")

    hands.type("insole.thickness_mm", "4")
    hands.choose("tool_section")
    hands.click((x, y - 42.0))
    hands.app.window.actions_by_key["map_thickness"].trigger()
    hands.picture("5-section")

    hands.studio.app.studio.rooms.dialogue.questions.file_to_write = (  # type: ignore[method-assign]
        lambda *_: tmp_path / "insole.stl"
    )
    hands.choose("export")
    hands.export()
    hands.picture("6-exported")

    design = case.record.design
    assert design is not None
    pad, posting = design.corrections
    assert isinstance(pad, Pelott)
    assert isinstance(posting, Posting)
    assert posting.rearfoot_deg == 4.0
    assert design.thickness_mm == 4.0
    assert (tmp_path / "insole-left.stl").stat().st_size > 1e6
    assert hands.actions <= MOST_ACTIONS
    print(f"{hands.actions} actions")
