"""The capture stage without a window: a panel and a service that only take notes."""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_core.geometry.side import BOTH, Side
from insole_core.recording.reader import read_session
from insole_core.recording.writer import write_session
from insole_core.sensing.infrared_reference import InfraredReference
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.capture_plan import kept_request
from insole_studio.acquisition.capture_setup import Calibrated, own_setup, recorded_setup
from insole_studio.acquisition.draft import Draft, ViewFacts
from insole_studio.acquisition.messages import (
    Capability,
    CapturePhase,
    CaptureStatus,
    Command,
    Event,
    Preset,
    Sensors,
    SensorState,
    Start,
    Tilt,
    Tune,
    Tuning,
    ViewStatus,
)
from insole_studio.acquisition.shared_frame_buffer import Kind, Picture
from insole_studio.acquisition.unfinished_captures import Drafts
from insole_studio.features.capture.presenter import CapturePresenter
from insole_studio.features.capture.rows import CaptureOptions, CaptureRow, SensorRow
from insole_studio.jobs import Jobs

SERIALS = ("A1", "B2")


class Intent:
    def __init__(self) -> None:
        self._listeners: list[Callable[..., None]] = []

    def connect(self, listener: Callable[..., None]) -> None:
        self._listeners.append(listener)

    def emit(self, *values: object) -> None:
        for listener in self._listeners:
            listener(*values)


class NotedPanel:
    def __init__(self) -> None:
        for name in (
            "capture_requested", "cancel_requested", "placed_requested", "retake_requested",
            "use_requested", "other_foot_requested", "find_requested", "view_chosen",
            "views_swapped", "tilt_requested", "level_requested", "identify_requested",
            "options_edited", "resume_requested", "discard_requested", "tuning_edited",
            "undo_requested", "redo_requested",
        ):  # fmt: skip
            setattr(self, name, Intent())
        self.rows: list[SensorRow] = []
        self.pictures: dict[str, tuple[object, object]] = {}
        self.capture = CaptureRow()
        self.options = CaptureOptions()
        self.empty = ""
        self.sentence = ""

    def show_sensors(self, rows: Sequence[SensorRow]) -> None:
        self.rows = list(rows)

    def show_pictures(self, serial: str, depth: object, color: object) -> None:
        self.pictures[serial] = (depth, color)

    def show_capture(self, row: CaptureRow) -> None:
        self.capture = row

    def show_options(self, options: CaptureOptions) -> None:
        self.options = options

    def show_empty(self, sentence: str) -> None:
        self.empty = sentence

    def show_sentence(self, sentence: str) -> None:
        self.sentence = sentence


class NotedService:
    def __init__(self) -> None:
        self.sent: list[Command] = []
        self.coming: list[Event] = []
        self.number = 1

    def send(self, command: Command) -> None:
        self.sent.append(command)

    def news(self) -> list[Event]:
        coming, self.coming = self.coming, []
        return coming

    def picture(self, slot: int, kind: Kind, after: int = 0) -> Picture | None:
        if after >= self.number:
            return None
        if kind == "depth":
            return Picture(np.full((480, 640), 600 + slot, np.uint16), self.number)
        return Picture(np.full((512, 640, 3), 90, np.uint8), self.number)


class Bench:
    def __init__(self, jobs: Jobs, folder: Path, session: Path) -> None:
        self.panel, self.service = NotedPanel(), NotedService()
        self.remembered: list[Sequence[tuple[str, str]]] = []
        self.kept: list[Path] = []
        self.finished: list[bool] = []
        self.asked: list[str] = []
        self.agrees = True
        self.folder = folder
        self.setup = recorded_setup(NothingStored(), read_session(session))
        self.presenter = CapturePresenter(
            panel=self.panel,
            service=self.service,
            setup=self.setup,
            jobs=jobs,
            assignment=[("right", "A1")],
            folder=folder,
            options=CaptureOptions(),
            remember=self.remembered.append,
            kept=self.kept.append,
            finished=lambda: self.finished.append(True),
            ask=self.ask,
        )

    def ask(self, sentence: str) -> bool:
        self.asked.append(sentence)
        return self.agrees

    def tell(self, *events: Event) -> None:
        self.service.coming += events
        self.presenter.tick()

    def plug_in(self, *with_motor: str) -> None:
        tilts = frozenset({Capability.TILT})
        states = (
            SensorState(
                s, "1414", 1, i, 30.0, capabilities=tilts if s in with_motor else frozenset()
            )
            for i, s in enumerate(SERIALS)
        )
        self.tell(Sensors(tuple(states)))

    def started(self) -> Start:
        start = self.service.sent[-1]
        assert isinstance(start, Start)
        return start

    def finish(
        self, *views: str, phase: CapturePhase = CapturePhase.DONE, sentence: str = ""
    ) -> None:
        self.tell(
            CaptureStatus(phase, tuple(ViewStatus(v, "A1", 4, 4, True) for v in views), sentence)
        )


class NothingStored:
    def load(self, _serial: str) -> Sensor | None:
        return None

    def reference(self, _serial: str) -> InfraredReference | None:
        return None


@pytest.fixture
def bench(qapp: QApplication, tmp_path: Path, small_session: Path) -> Iterator[Bench]:
    jobs = Jobs()
    made = Bench(jobs, tmp_path, small_session)
    yield made
    made.presenter.close()
    jobs.close()


def test_without_sensors_it_says_why(bench: Bench) -> None:
    assert bench.panel.empty == "Looking for sensors"
    bench.tell(Sensors((), "No Kinect is plugged in."))
    assert bench.panel.empty == "No Kinect is plugged in."
    assert not bench.panel.capture.can_capture


def test_each_view_has_one_sensor_whichever_come_and_go(bench: Bench) -> None:
    """One that comes back after its view was taken: captures told that a view is named twice."""

    def views(*serials: str) -> dict[str, str]:
        states = (SensorState(s, "1414", 1, i, 30.0) for i, s in enumerate(serials))
        bench.tell(Sensors(tuple(states)))
        return {row.serial: row.view for row in bench.panel.rows}

    assert views("A1", "B2") == {"A1": "right", "B2": "left"}
    assert views("A1", "C3") == {"A1": "right", "C3": "left"}
    assert views("A1", "B2", "C3") == {"A1": "right", "B2": "top", "C3": "left"}
    bench.presenter.name_view("B2", "left")
    assert views("A1", "B2", "C3") == {"A1": "right", "B2": "left", "C3": "top"}
    bench.panel.capture_requested.emit()
    assert sorted(bench.started().plan.views) == ["left", "right", "top"]


def test_it_says_why_another_sensor_is_missing(bench: Bench) -> None:
    state = SensorState("A1", "1414", 1, 0, 30.0)
    bench.tell(Sensors((state,), "The library is missing; install it."))
    assert bench.panel.capture.sentence == "The library is missing; install it."
    bench.plug_in()
    assert bench.panel.capture.sentence == ""


def test_a_new_sensor_gets_a_view_that_is_free(bench: Bench) -> None:
    bench.plug_in()
    assert [(row.serial, row.view) for row in bench.panel.rows] == [("B2", "left"), ("A1", "right")]
    assert bench.panel.capture.can_capture


def test_pictures_are_shown_once_with_the_depth_in_the_title(bench: Bench) -> None:
    bench.plug_in()
    depth, color = bench.panel.pictures["A1"]
    assert depth.shape == (240, 320, 3)  # type: ignore[attr-defined]
    assert color.shape == (512, 640, 3)  # type: ignore[attr-defined]
    bench.panel.pictures.clear()
    bench.plug_in()
    assert bench.panel.pictures == {}
    assert bench.panel.rows[1].title == "right · 672 mm"
    assert bench.panel.rows[0].facts == "30 frames/s, 0 lost · warm in 15 min"


def test_dragging_exchanges_views_and_is_remembered(bench: Bench) -> None:
    bench.plug_in()
    bench.panel.views_swapped.emit("A1", "B2")  # type: ignore[attr-defined]
    assert [(row.serial, row.view) for row in bench.panel.rows] == [("A1", "left"), ("B2", "right")]
    assert sorted(bench.remembered[-1]) == [("left", "A1"), ("right", "B2")]


def test_choosing_a_view_exchanges_with_who_had_it(bench: Bench) -> None:
    bench.plug_in()
    bench.panel.view_chosen.emit("B2", "right")  # type: ignore[attr-defined]
    assert sorted(bench.remembered[-1]) == [("left", "A1"), ("right", "B2")]


def test_capture_carries_the_choices(bench: Bench) -> None:
    bench.plug_in()
    options = CaptureOptions(Side.RIGHT, "full", True, "barefoot", "together", frames=5)
    bench.panel.options_edited.emit(options)  # type: ignore[attr-defined]
    bench.panel.capture_requested.emit()  # type: ignore[attr-defined]
    start = bench.started()
    assert start.manifest.side is Side.RIGHT
    assert start.manifest.capture_condition is not None
    assert start.manifest.capture_condition.notes == "barefoot"
    assert start.plan.views == start.order == ("left", "right")
    assert len(start.plan.steps) == 1
    assert start.plan.frames == 5
    assert start.folder.name.endswith("-right")
    assert bench.panel.capture.running
    assert not bench.panel.capture.can_capture


def test_a_failure_keeps_what_it_has_and_asks_for_the_rest(bench: Bench) -> None:
    bench.plug_in()
    bench.presenter.capture()
    folder = bench.started().folder
    bench.finish("left", phase=CapturePhase.FAILED, sentence="A sensor was unplugged.")
    assert bench.panel.sentence == "A sensor was unplugged."
    assert bench.panel.capture.button == "Capture missing views"
    bench.presenter.capture()
    assert bench.started().plan.views == ("right",)
    assert bench.started().folder == folder


def test_one_view_is_captured_again(bench: Bench) -> None:
    bench.plug_in()
    bench.presenter.capture()
    bench.finish("left", "right")
    assert [row.retakes for row in bench.panel.rows] == [("left",), ("right",)]
    bench.panel.retake_requested.emit("left")  # type: ignore[attr-defined]
    assert bench.started().plan.views == ("left",)
    assert bench.started().order == ("left", "right")


def test_a_finished_capture_begins_anew(bench: Bench) -> None:
    bench.plug_in()
    bench.presenter.capture()
    bench.finish("left", "right")
    assert bench.panel.capture.button == "Capture anew"
    assert bench.panel.capture.is_whole
    assert bench.panel.capture.sentence == "All views are captured."
    bench.presenter.capture()
    assert bench.started().plan.views == ("left", "right")


def test_moving_by_hand_offers_to_go_on(bench: Bench) -> None:
    bench.plug_in()
    bench.presenter.capture()
    bench.tell(CaptureStatus(CapturePhase.MOVING, (), "Put the sensor in its place for view top"))
    assert bench.panel.capture.waits_for_hand


def write_draft(bench: Bench, *views: str) -> None:
    """Write what the service would have written of some views, or of all."""
    start = bench.started()
    draft = Draft(start.folder, start.manifest, start.order)
    sensor = next(iter(bench.setup.recorded.values()))
    width, height = sensor.color_camera.width, sensor.color_camera.height
    for view in views or start.order:
        draft.begin_view(view)
        draft.add_depth(view, 0, np.full((480, 640), 700, np.uint16))
        draft.add_color(view, 0, np.full((height, width, 3), 90, np.uint8))
        draft.finish_view(view, Calibrated(sensor, "recording"), ViewFacts(0.1, 0, 10.0))
    draft.close()


def test_a_session_is_kept_and_handed_over(bench: Bench, qtbot: QtBot) -> None:
    bench.plug_in()
    bench.presenter.capture()
    write_draft(bench)
    bench.finish("left", "right")
    bench.panel.use_requested.emit()  # type: ignore[attr-defined]
    qtbot.waitUntil(lambda: bool(bench.finished))
    (kept,) = bench.kept
    assert kept.parent == bench.folder / "sessions"
    assert read_session(kept).manifest.views == ("left", "right")
    assert not list((bench.folder / "captures").iterdir())
    assert bench.panel.capture.button == "Capture"


def test_the_other_foot_follows(bench: Bench, qtbot: QtBot) -> None:
    bench.plug_in()
    bench.presenter.capture()
    write_draft(bench)
    bench.finish("left", "right")
    bench.panel.other_foot_requested.emit()  # type: ignore[attr-defined]
    qtbot.waitUntil(lambda: bench.panel.options.side is Side.RIGHT)
    assert bench.finished == []
    (kept,) = bench.kept
    assert read_session(kept).manifest.side is Side.LEFT
    bench.presenter.capture()
    assert bench.started().manifest.side is Side.RIGHT


@pytest.mark.parametrize(
    ("with_motor", "can_tilt", "views"),
    [
        ((), False, ("left", "right")),
        (("B2",), True, ("left", "left_2", "left_3", "right")),
        (SERIALS, True, ("left", "left_2", "left_3", "right", "right_2", "right_3")),
    ],
)
def test_only_sensors_with_a_motor_take_bursts(
    bench: Bench, with_motor: tuple[str, ...], can_tilt: bool, views: tuple[str, ...]
) -> None:
    assert bench.panel.capture.can_tilt  # nobody knows yet
    bench.plug_in(*with_motor)
    assert bench.panel.capture.can_tilt is can_tilt
    bench.panel.options_edited.emit(CaptureOptions(bursts=3))  # type: ignore[attr-defined]
    bench.presenter.capture()
    started = bench.started()
    assert started.plan.views == started.order == views
    kept = kept_request(started.manifest.extra)
    assert kept is not None
    assert kept.plan().views == views


def test_what_is_set_of_a_sensor_can_be_taken_back(bench: Bench) -> None:
    bench.plug_in()
    strict, dense = Tuning(Preset.HIGH_ACCURACY), Tuning(Preset.HIGH_DENSITY)
    state = SensorState("B2", "d415", 1, 1, 30.0, tuning=replace(strict, laser_mw=150.0))
    bench.tell(Sensors((state,)))
    panel = bench.panel
    panel.tuning_edited.emit("B2", dense)  # type: ignore[attr-defined]
    bench.tell(Sensors((replace(state, tuning=replace(dense, laser_mw=150.0)),)))
    assert panel.rows[0].tuning == replace(dense, laser_mw=150.0)
    for intent in (panel.undo_requested, panel.undo_requested, panel.redo_requested):  # type: ignore[attr-defined]
        intent.emit()
    assert bench.service.sent == [Tune("B2", dense), Tune("B2", strict), Tune("B2", dense)]
    bench.presenter.capture()
    assert not panel.rows[0].can_tune
    panel.tuning_edited.emit("B2", strict)  # type: ignore[attr-defined]
    panel.undo_requested.emit()  # type: ignore[attr-defined]
    bench.started()  # the last command, as a capture runs


def test_a_run_of_the_wheel_is_one_step_of_undo_before_the_sensor_has_answered(
    bench: Bench,
) -> None:
    bench.plug_in()
    state = SensorState("B2", "d415", 1, 1, 30.0, tuning=Tuning(laser_mw=150.0, pair=False))
    bench.tell(Sensors((state,)))
    panel = bench.panel
    dimmer, darker = Tuning(laser_mw=120.0), Tuning(laser_mw=90.0)
    paired, alone = Tuning(pair=True), Tuning(pair=False)
    changes = (paired, alone, dimmer, darker)
    for change in changes:
        panel.tuning_edited.emit("B2", change)  # type: ignore[attr-defined]
    panel.undo_requested.emit()  # type: ignore[attr-defined]
    wanted = [*changes, Tuning(laser_mw=150.0)]
    assert bench.service.sent == [Tune("B2", one) for one in wanted]
    bench.service.sent.clear()
    panel.tuning_edited.emit("B2", dimmer)  # type: ignore[attr-defined]
    bench.tell(Sensors((replace(state, tuning=dimmer),)))
    bench.presenter.end_merging()
    panel.tuning_edited.emit("B2", darker)  # type: ignore[attr-defined]
    panel.undo_requested.emit()  # type: ignore[attr-defined]
    assert bench.service.sent[-1] == Tune("B2", dimmer)


def test_one_sensor_is_moved_from_view_to_view(bench: Bench) -> None:
    bench.plug_in(*SERIALS)
    options = CaptureOptions(mode="moved", views=("left", "heel", "right"), bursts=2)
    bench.panel.options_edited.emit(options)  # type: ignore[attr-defined]
    bench.presenter.capture()
    plan = bench.started().plan
    assert [(shot.view, shot.serial) for shot in plan.shots] == [
        ("left", "B2"), ("left_2", "B2"), ("heel", "B2"), ("heel_2", "B2"),
        ("right", "A1"), ("right_2", "A1"),
    ]  # fmt: skip
    assert [step.by_hand for step in plan.steps] == [True, False, True, False, False, False]

    views = [ViewStatus(s.view, s.serial, 4, 4, s.place == "left", (), s.place) for s in plan.shots]
    bench.tell(CaptureStatus(CapturePhase.TILTING, tuple(views), "", ("left_2",)))
    assert not bench.panel.capture.waits_for_hand
    bench.tell(CaptureStatus(CapturePhase.MOVING, tuple(views), "", ("heel",)))
    assert bench.panel.capture.waits_for_hand
    assert "in its place for view heel" in bench.panel.capture.sentence
    assert [row.title.split(" ")[0] for row in bench.panel.rows] == ["heel", "right"]
    bench.finish(*plan.views)
    assert [row.retakes for row in bench.panel.rows] == [("left", "heel"), ("right",)]
    bench.panel.retake_requested.emit("heel")  # type: ignore[attr-defined]
    again = bench.started().plan
    assert [(step.names, step.by_hand) for step in again.steps] == [
        ("heel", True), ("heel_2", False),
    ]  # fmt: skip


def test_view_names_that_cannot_be_are_told(bench: Bench) -> None:
    bench.plug_in()
    bench.panel.options_edited.emit(  # type: ignore[attr-defined]
        CaptureOptions(mode="moved", views=("Left",))
    )
    bench.presenter.capture()
    assert "cannot name a view" in bench.panel.sentence


@pytest.fixture
def offered(bench: Bench, small_session: Path) -> Bench:
    """A window that is opened anew, after one view of a capture is on the disk."""
    bench.plug_in()
    options = CaptureOptions(Side.RIGHT, "semi", True, "cold", "together", frames=4)
    bench.panel.options_edited.emit(options)  # type: ignore[attr-defined]
    bench.presenter.capture()
    write_draft(bench, "right")
    bench.presenter.close()
    return Bench(bench.presenter._jobs, bench.folder, small_session)


def test_an_unfinished_capture_is_offered_again(offered: Bench) -> None:
    offered.plug_in()
    assert offered.panel.capture.offer.startswith("The capture of ")
    kept_until = date.today() + timedelta(days=30)
    assert offered.panel.capture.offer.endswith(
        f"was not used; 1 of 2 views are there. It is kept until {kept_until}."
    )
    offered.panel.resume_requested.emit()  # type: ignore[attr-defined]
    assert offered.panel.capture.offer == ""
    assert offered.panel.options == CaptureOptions(
        Side.RIGHT, "semi", True, "cold", "together", frames=4
    )
    assert offered.panel.capture.button == "Capture missing views"
    offered.presenter.capture()
    assert offered.started().plan.views == ("left",)
    assert offered.started().order == ("left", "right")
    (folder,) = (path for path in (offered.folder / "captures").iterdir() if path.is_dir())
    assert offered.started().folder == folder


def test_an_unfinished_capture_can_be_discarded(offered: Bench) -> None:
    offered.panel.discard_requested.emit()  # type: ignore[attr-defined]
    assert offered.panel.capture.offer == ""
    assert not list((offered.folder / "captures").iterdir())


def test_a_new_capture_leaves_the_unfinished_one_alone(offered: Bench) -> None:
    offered.plug_in()
    offered.presenter.capture()
    assert offered.started().plan.views == ("left", "right")
    assert offered.panel.capture.offer == ""
    assert Drafts(offered.folder / "captures").left() != []


def test_all_unfinished_captures_are_offered_and_end(offered: Bench, small_session: Path) -> None:
    drafts, jobs = offered.folder / "captures", offered.presenter._jobs
    (today,) = (path for path in drafts.iterdir() if path.is_dir())
    for name in ("before", "damaged"):
        shutil.copytree(today, drafts / name)
    (drafts / "damaged" / "manifest.json").write_text("{")
    offer = Bench(jobs, offered.folder, small_session).panel.capture.offer
    assert "Before it: 1 more, offered after it." in offer
    long_ago = time.time() - 31 * 86_400
    for name in ("before", "damaged"):
        for path in (drafts / name, *(drafts / name).rglob("*")):
            os.utime(path, (long_ago, long_ago))
    again = Bench(jobs, offered.folder, small_session)
    assert again.panel.sentence == "2 captures that were not used for 30 days were removed."
    assert [path for path in drafts.iterdir() if path.is_dir()] == [today]
    again.panel.discard_requested.emit()  # type: ignore[attr-defined]
    assert list(drafts.iterdir()) == []


def test_what_is_no_draft_is_not_offered(tmp_path: Path, small_session: Path) -> None:
    assert Drafts(tmp_path / "captures").left() == []
    (tmp_path / "captures" / "b").mkdir(parents=True)
    write_session(read_session(small_session), tmp_path / "captures" / "a")
    (tmp_path / "captures" / "b" / "manifest.json").write_text("{")
    assert Drafts(tmp_path / "captures").left() == []


def test_orders_go_to_the_sensor(bench: Bench) -> None:
    bench.plug_in()
    bench.panel.tilt_requested.emit("A1", 2.0)  # type: ignore[attr-defined]
    bench.panel.level_requested.emit("B2")  # type: ignore[attr-defined]
    assert bench.service.sent == [Tilt("A1", 2.0), Tilt("B2", None)]


def test_both_feet_need_the_frame_for_both(bench: Bench) -> None:
    bench.plug_in()
    bench.panel.options_edited.emit(CaptureOptions(BOTH))  # type: ignore[attr-defined]
    assert "place for one foot only" in bench.panel.sentence
    assert bench.presenter.options.side is Side.LEFT


def test_both_feet_are_captured_in_the_frame_for_both(
    qapp: QApplication, tmp_path: Path, small_session: Path
) -> None:
    jobs = Jobs()
    bench = Bench(jobs, tmp_path, small_session.with_name("both_small.zip"))
    bench.panel.options_edited.emit(CaptureOptions(BOTH))  # type: ignore[attr-defined]
    bench.plug_in()
    bench.presenter.capture()
    manifest = bench.started().manifest
    assert manifest.side == BOTH
    assert [place.side for place in manifest.reference_system.feet] == [Side.LEFT, Side.RIGHT]
    bench.presenter.close()
    jobs.close()


def test_the_setup_of_this_computer_has_a_frame_for_one_foot_and_for_both() -> None:
    setup = own_setup(NothingStored())
    assert setup.of_side(Side.RIGHT) is setup
    both = setup.of_side(BOTH)
    assert both.system.name == "lego-40"
    assert both.of_side(Side.LEFT).system == setup.system
