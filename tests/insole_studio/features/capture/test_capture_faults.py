"""Nothing that was captured is lost: cancelling, retaking, and a service that is killed.

By mouse, in the window, with emulated sensors in their own process.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton, QLabel, QProgressBar
from pytestqt.qtbot import QtBot

from insole_core.recording.reader import read_session
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.features.capture.sensor_card import SensorCard
from insole_studio.features.capture.stage import CaptureStage

ALL = {"left": "10 of 10", "right": "10 of 10", "top": "10 of 10"}

pytestmark = pytest.mark.slow


class Hands:
    """Uses the stage as somebody in front of it would."""

    def __init__(self, stage: CaptureStage, qtbot: QtBot) -> None:
        self.stage, self._qtbot = stage, qtbot

    def wait(self, until: Callable[[], bool]) -> None:
        self._qtbot.waitUntil(until)

    def button(self, text: str) -> QAbstractButton:
        found = [b for b in self.stage.findChildren(QAbstractButton) if b.text() == text]
        return next((b for b in found if b.isVisible() and b.isEnabled()), found[0])

    def can_click(self, text: str) -> bool:
        buttons = self.stage.findChildren(QAbstractButton)
        return any(b.text() == text and b.isVisible() and b.isEnabled() for b in buttons)

    def click(self, text: str) -> None:
        self.wait(lambda: self.can_click(text))
        self._qtbot.mouseClick(self.button(text), Qt.MouseButton.LeftButton)

    def says(self, part: str) -> bool:
        labels = self.stage.findChildren(QLabel)
        return any(part in label.text() for label in labels if label.isVisible())

    @property
    def progress(self) -> QProgressBar:
        return self.stage.findChild(QProgressBar)

    def cards(self) -> list[SensorCard]:
        return [card for card in self.stage.findChildren(SensorCard) if card.isVisible()]

    def counts(self) -> dict[str, str]:
        """What each card's title says behind view and depth, such as "10 of 10"."""
        titles = [card.findChildren(QLabel)[0].text() for card in self.cards()]
        return {title.split(" ")[0]: title.partition("mm")[2].strip() for title in titles}

    def wait_for_sensors(self) -> None:
        self.wait(lambda: len(self.cards()) == 3 and all(map(_is_live, self.cards())))

    def capture_all(self) -> None:
        self.click("Capture")
        self.wait(lambda: self.counts() == ALL and self.can_click("Use this scan"))

    def set_frames(self, count: int) -> None:
        """Make a capture last, so that a busy computer does not miss the moment to end it."""
        field = self.stage.view._frames
        field.selectAll()
        self._qtbot.keyClicks(field, str(count))
        self._qtbot.keyClick(field, Qt.Key.Key_Return)

    def kill_service(self) -> int | None:
        """Kill it, and return the number of its process."""
        process = self.stage._service._process
        process.kill()
        return process.pid


@pytest.fixture
def open_stage(
    qtbot: QtBot, tmp_path: Path, small_session: Path
) -> Iterator[Callable[[], CaptureStage]]:
    opened: list[CaptureStage] = []

    def build() -> CaptureStage:
        source = SensorSource(SensorStore(tmp_path / "sensors"), small_session)
        stage = CaptureStage(
            source=source,
            assignment=(),
            folder=tmp_path,
            remember=str,
            ask=lambda _stage, _sentence: False,
        )
        stage.show()
        opened.append(stage)
        return stage

    yield build
    for stage in opened:
        stage.end()
        stage.deleteLater()


@pytest.fixture
def hands(qtbot: QtBot, open_stage: Callable[[], CaptureStage]) -> Hands:
    made = Hands(open_stage(), qtbot)
    made.wait_for_sensors()
    return made


def _is_live(card: SensorCard) -> bool:
    """Whether frames come, however slowly on a busy computer."""
    return any(
        re.search(r"\b[1-9]\d* frames/s", label.text()) for label in card.findChildren(QLabel)
    )


def _tells_markers(card: SensorCard) -> bool:
    return any("markers" in label.text() for label in card.findChildren(QLabel))


def used_scan(hands: Hands, qtbot: QtBot, frames: int = 10) -> Path:
    """Use the scan, and return the session that was handed on."""
    kept: list[Path] = []
    hands.stage.kept.connect(kept.append)
    with qtbot.waitSignal(hands.stage.closed):
        hands.click("Use this scan")
    session = read_session(kept[0])
    assert {view.name: view.depth_count for view in session.views} == dict.fromkeys(ALL, frames)
    assert [path.name for path in kept[0].glob(".*")] == []
    return kept[0]


def drafts(folder: Path) -> list[str]:
    return sorted(path.name for path in (folder / "captures").iterdir() if path.is_dir())


def whole_views(folder: Path, frames: int) -> set[str]:
    """The views of which a draft has all depth images."""
    return {
        view.name
        for view in (folder / "captures").glob("*/views/*")
        if len(list(view.glob("depth_*.png"))) == frames
    }


def test_a_new_capture_that_is_cancelled_or_killed_brings_the_scan_back(
    hands: Hands, qtbot: QtBot, tmp_path: Path
) -> None:
    hands.capture_all()
    (scan,) = drafts(tmp_path)
    for end in ("cancel", "kill"):
        hands.set_frames(30)
        hands.click("Capture anew")
        # A view is kept a moment after its last frame, before the second view ends.
        complete = 1 if end == "cancel" else 2
        hands.wait(lambda: list(hands.counts().values()).count("30 of 30") >= complete)  # noqa: B023
        assert not hands.can_click("Use this scan")
        if end == "cancel":
            hands.click("Cancel")
        else:
            hands.kill_service()
            hands.click("Look again")
            hands.wait_for_sensors()
        hands.wait(lambda: hands.can_click("Use this scan"))
        hands.set_frames(10)
        assert hands.counts() == ALL
        assert hands.says("The earlier scan is kept.")
        hands.wait(lambda: hands.says("was not used; "))  # how many views it has, chance decides
        assert hands.says("of 3 views are there.")
        assert hands.can_click("Capture anew")
    assert used_scan(hands, qtbot).name == scan
    assert len(drafts(tmp_path)) == 2


def test_the_other_side_and_a_new_capture_leave_the_scan_to_be_taken_up_again(
    hands: Hands, qtbot: QtBot, tmp_path: Path
) -> None:
    hands.capture_all()
    (first,) = drafts(tmp_path)
    side = hands.stage.view._side
    qtbot.keyClick(side, Qt.Key.Key_Down)
    assert side.currentData() == "right"
    assert not hands.can_click("Use this scan")
    hands.click("Go on with it")
    assert side.currentData() == "left"
    assert hands.counts() == ALL
    assert hands.can_click("Use this scan")

    hands.click("Capture anew")
    hands.wait(lambda: hands.can_click("Use this scan"))
    (second,) = set(drafts(tmp_path)) - {first}
    assert hands.says("was not used; 3 of 3 views are there.")
    hands.click("Go on with it")
    assert hands.counts() == ALL
    assert used_scan(hands, qtbot).name == first
    assert drafts(tmp_path) == [second]


def test_one_view_captured_again_leaves_the_others(hands: Hands, qtbot: QtBot) -> None:
    hands.wait(lambda: all(map(_tells_markers, hands.cards())))
    hands.capture_all()
    for end, frames in (("done", 10), ("cancel", 60)):
        right = next(c for c in hands.cards() if c.findChildren(QLabel)[0].text()[0] == "r")
        hands.set_frames(frames)
        (again,) = (b for b in right.findChildren(QAbstractButton) if b.text() == "Capture again")
        qtbot.mouseClick(again, Qt.MouseButton.LeftButton)
        hands.wait(lambda: hands.says("Capturing view right"))
        counts = hands.counts()
        assert (counts["left"], counts["top"]) == ("10 of 10", "10 of 10")
        if end == "cancel":
            hands.click("Cancel")
        hands.wait(lambda: hands.can_click("Use this scan"))
        assert hands.counts() == ALL
        assert hands.can_click("Capture anew")
    qtbot.keyClicks(hands.stage.view._notes, "cold feet")  # seen after the capture
    manifest = read_session(used_scan(hands, qtbot)).manifest
    assert manifest.views == tuple(ALL)
    condition = manifest.capture_condition
    assert condition is not None
    assert condition.notes == "cold feet"


MOMENTS: tuple[Callable[[Hands], bool], ...] = (
    lambda hands: True,  # at once
    lambda hands: hands.progress.value() > 0,  # in the first view
    lambda hands: hands.counts()["left"] == "20 of 20",  # after the first view
    lambda hands: hands.progress.value() > 70,  # in the last view
)


def test_a_service_that_is_killed_again_and_again_is_told_and_goes_on(
    hands: Hands, qtbot: QtBot, tmp_path: Path
) -> None:
    ended = "The program that reads the sensors has ended"
    hands.set_frames(20)
    killed, unused = set(), 0
    for is_moment in MOMENTS:
        unused += hands.can_click("Capture anew")  # a busy computer was done before the last kill
        hands.click(hands.stage.view._capture.text())
        hands.wait(lambda: is_moment(hands))  # noqa: B023
        assert not hands.says(ended)
        killed.add(hands.kill_service())
        hands.wait(lambda: hands.says(ended))
        assert not hands.progress.isVisible()
        assert not hands.can_click("Cancel")
        hands.click("Look again")
        hands.wait_for_sensors()
        assert not hands.progress.isVisible()
        shown = {view for view, count in hands.counts().items() if count == "20 of 20"}
        assert shown <= whole_views(tmp_path, 20)
    assert len(killed) == len(MOMENTS)
    if not hands.can_click("Capture anew"):
        hands.click(hands.stage.view._capture.text())
    hands.wait(lambda: hands.can_click("Use this scan"))
    assert hands.counts() == dict.fromkeys(ALL, "20 of 20")
    used_scan(hands, qtbot, 20)
    assert len(drafts(tmp_path)) == unused


def test_a_service_that_is_killed_while_idle_or_while_a_sensor_is_moved(
    hands: Hands, qtbot: QtBot
) -> None:
    for _ in range(2):
        hands.kill_service()
        hands.click("Look again")
        hands.wait_for_sensors()
    qtbot.keyClick(hands.stage.view._mode, Qt.Key.Key_End)
    views = hands.stage.view._views
    views.setFocus()
    views.selectAll()
    qtbot.keyClicks(views, "left right top heel")
    hands.click("Capture")
    hands.wait(lambda: hands.can_click("The sensor stands"))
    hands.kill_service()
    hands.wait(lambda: hands.can_click("Look again"))
    assert not hands.can_click("The sensor stands")
    assert not hands.progress.isVisible()


def test_what_a_window_works_on_is_offered_to_no_other(
    hands: Hands, open_stage: Callable[[], CaptureStage], qtbot: QtBot
) -> None:
    hands.capture_all()
    other = Hands(open_stage(), qtbot)
    assert not other.says("was not used")
    hands.stage.close()
    third, fourth = (Hands(open_stage(), qtbot) for _ in range(2))
    third.click("Go on with it")
    assert third.stage.view._capture.text() == "Capture anew"
    fourth.click("Go on with it")
    assert fourth.says("is in use by another window or command")
    assert fourth.stage.view._capture.text() == "Capture"
    assert not fourth.says("was not used")
