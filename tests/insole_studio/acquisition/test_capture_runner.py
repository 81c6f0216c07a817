"""Plans on emulated sensors: what comes onto the disk, whose emitter shines, what can go wrong."""

from __future__ import annotations

import errno
import pickle
import shutil
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from capture_samples import ASSIGNMENT, FRAMES, SERIALS, VIEWS, Bench, color_mosaic

from insole_core.errors import InputError, OutputError
from insole_core.progress import Cancelled
from insole_core.recording.reader import read_session
from insole_core.recording.session import CaptureCondition
from insole_studio.acquisition import draft as draft_module
from insole_studio.acquisition.capture_plan import CapturePlan, CaptureStep, make_plan
from insole_studio.acquisition.capture_runner import open_sensors
from insole_studio.acquisition.draft import Draft
from insole_studio.acquisition.messages import CapturePhase, CaptureStatus
from insole_studio.acquisition.sensor_port import BusFullError, NoSensorFoundError, SensorError
from kinect_v1.emulation.packet_source import Fault
from kinect_v1.emulation.playback import make_footage

PLAN = make_plan(ASSIGNMENT, frames=FRAMES)


def marks(bench: Bench, view: str) -> list[int]:
    """Give which frames of the footage a view has on the disk."""
    session = read_session(bench.draft.folder)
    stored = next(v for v in session.views if v.name == view)
    return [int(stored.read_depth(i)[0, 0]) - 400 for i in range(stored.depth_count)]


@pytest.mark.slow
def test_every_view_is_what_its_sensor_sent(bench: Bench, condition: CaptureCondition) -> None:
    assert bench.capture(PLAN) == tuple(
        f"Sensor {serial} is not calibrated; the numbers of its factory are used, which are "
        "several millimetres less exact."
        for serial in SERIALS
    )
    session = read_session(bench.draft.folder)
    assert session.manifest.views == VIEWS
    assert session.manifest.capture_condition == condition
    for view, (name, serial) in zip(session.views, ASSIGNMENT, strict=True):
        assert (view.name, view.sensor.serial) == (name, serial)
        assert (view.depth_count, view.color_count) == (FRAMES, 1)
        for index in range(FRAMES):
            assert np.array_equal(view.read_depth(index), bench.depth[serial][index])
    facts = session.manifest.extra["capture"]
    assert [facts[view]["calibration"] for view in VIEWS] == ["factory"] * 3


@pytest.mark.slow
def test_only_the_sensor_that_captures_shines(bench: Bench) -> None:
    shining: dict[str, set[str]] = {view: set() for view in VIEWS}

    def look(serial: str, _image: object) -> None:
        view = {s: v for v, s in ASSIGNMENT}[serial]
        shining[view] |= {s for s, k in bench.kinects.items() if k.camera.emitter_on}

    bench.capture(PLAN, show=look)
    assert shining == {view: {serial} for view, serial in ASSIGNMENT}


@pytest.mark.slow
def test_simultaneous_sensors_shine_together(bench: Bench) -> None:
    plan = make_plan(ASSIGNMENT, frames=FRAMES, simultaneous=True)
    bench.capture(plan)
    assert all(kinect.camera.emitter_on for kinect in bench.kinects.values())
    assert bench.draft.views == VIEWS


@pytest.mark.slow
def test_frames_of_a_projector_that_warms_up_are_left_out(
    make: Callable[..., Bench],
) -> None:
    bench = make(warm_up=6)
    bench.capture(PLAN)
    for view in VIEWS:
        assert marks(bench, view) == [6, 7, 8, 9]
    facts = read_session(bench.draft.folder).manifest.extra["capture"]
    assert all(facts[view]["settled_after_s"] > 0.1 / 8 for view in VIEWS)


@pytest.mark.slow
def test_phases_follow_each_other(bench: Bench) -> None:
    bench.capture(PLAN)
    phases = [status.phase for status in bench.told]
    turns = [p for p, before in zip(phases, [None, *phases], strict=False) if p is not before]
    assert turns == [CapturePhase.SETTLING, CapturePhase.CAPTURING, CapturePhase.VERIFYING] * 3
    fractions = [status.fraction for status in bench.told]
    assert fractions == sorted(fractions)
    assert bench.told[-1].sentence == "View top is on the disk"
    assert fractions[-1] == 1.0


@pytest.mark.slow
def test_damaged_frames_are_left_out_and_counted(bench: Bench) -> None:
    bench.kinects["B2"].camera.inject(Fault("lost", "depth", at=2 * 242, count=1))
    bench.capture(PLAN)
    assert marks(bench, "right") == [0, 2, 3, 4]
    facts = read_session(bench.draft.folder).manifest.extra["capture"]
    assert [facts[view]["discarded_frames"] for view in VIEWS] == [0, 1, 0]


def test_sensors_on_one_controller_take_turns(make: Callable[..., Bench]) -> None:
    bench = make(controllers=[1, 1, 2])
    bench.capture(PLAN)
    assert bench.draft.views == VIEWS


def test_simultaneous_on_one_controller_names_bus_and_remedy(make: Callable[..., Bench]) -> None:
    bench = make(controllers=[7, 7, 8])
    plan = make_plan(ASSIGNMENT, frames=FRAMES, simultaneous=True)
    with pytest.raises(BusFullError, match=r"controller of bus 7 is full.*controller of its own"):
        bench.capture(plan)
    assert bench.draft.views == ()


def test_a_full_controller_is_noticed_before_the_first_frame(bench: Bench) -> None:
    bench.kinects["C3"].camera.inject(Fault("no bandwidth", "depth", count=9))
    with pytest.raises(BusFullError, match=r"controller of bus 3 is full.*controller of its own"):
        bench.capture(PLAN)
    assert not bench.told
    assert not any(kinect.camera.emitter_on for kinect in bench.kinects.values())


def test_a_sensor_is_moved_by_hand(bench: Bench) -> None:
    asked: list[CaptureStep] = []
    plan = make_plan([("left", "A1"), ("right", "A1")], frames=FRAMES)
    bench.capture(plan, wait_for_hand=asked.append)
    assert asked == [plan.steps[1]]
    assert bench.told[-1].sentence == "View right is on the disk"
    asking = [status.sentence for status in bench.told if status.phase is CapturePhase.MOVING]
    assert asking == ["Put the sensor in its place for view right"]
    assert bench.draft.views == ("left", "right")


def test_bursts_tilt_and_come_back(make: Callable[..., Bench]) -> None:
    bench = make()
    motor = bench.kinects["A1"].motor
    assert motor is not None
    motor.tilt_deg = 5.0
    tilts: dict[str, float] = {}

    def note(status: CaptureStatus) -> None:
        tilts.setdefault(status.sentence, motor.tilt_deg)

    plan = make_plan([("left", "A1")], frames=FRAMES, bursts=3)
    bench.draft = Draft(bench.draft.folder, bench.draft.manifest, plan.views)
    bench.capture(plan, report=note)
    assert [tilts[f"Checking view {view}"] for view in plan.views] == [5.0, 6.0, 4.0]
    assert motor.tilt_deg == 5.0


def test_a_lost_sensor_leaves_what_is_there(bench: Bench) -> None:
    def pull(status: CaptureStatus) -> None:
        if status.sentence == "Waiting for steady depth of view right":
            bench.emulated.unplug(bench.kinects["B2"])

    with pytest.raises(SensorError, match=r"unplugged or lost its power.*Kept so far: left\."):
        bench.capture(PLAN, report=pull)
    assert bench.draft.views == ("left",)
    bench.draft.close()
    assert read_session(bench.draft.folder).manifest.views == ("left",)


@pytest.mark.slow
def test_what_was_left_is_taken_up_again(bench: Bench, make: Callable[..., Bench]) -> None:
    bench.capture(PLAN.only(["left"]))
    bench.draft.close()
    other = make()
    other.draft = Draft.reopen(bench.draft.folder, PLAN.views)
    assert other.draft.views == ("left",)
    other.capture(PLAN.only(["right", "top"]))
    assert read_session(bench.draft.folder).manifest.views == VIEWS


def test_a_folder_that_no_capture_left_is_refused(small_session: Path) -> None:
    with pytest.raises(InputError, match="was not left by a capture"):
        Draft.reopen(small_session, VIEWS)


@pytest.mark.slow
def test_a_view_can_be_repeated(bench: Bench) -> None:
    bench.capture(PLAN)
    before = marks(bench, "right")
    bench.capture(PLAN.only(["right"]))
    assert marks(bench, "right") == before
    assert read_session(bench.draft.folder).manifest.views == VIEWS


def test_a_silent_sensor_is_noticed(bench: Bench) -> None:
    bench.kinects["A1"].camera.footage = {}
    with pytest.raises(SensorError, match="no usable"):
        bench.capture(PLAN)


def test_cancel_stops_at_once_and_keeps_finished_views(bench: Bench) -> None:
    with pytest.raises(Cancelled):
        bench.capture(PLAN, is_cancelled=lambda: bench.draft.views == ("left",))
    assert bench.draft.views == ("left",)


def test_a_full_disk_is_noticed_before(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "disk_usage", lambda _path: SimpleNamespace(free=1_000_000))
    with pytest.raises(OutputError, match="the disk is full; free some space"):
        bench.capture(PLAN)
    assert not bench.told


def test_a_disk_that_fills_up_keeps_the_views_before(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    write = draft_module._write

    def fill(path: Path, image: np.ndarray) -> None:
        if path.parent.name.endswith("right") and path.name == "depth_002.png":
            raise OSError(errno.ENOSPC, "No space left on device")
        write(path, image)

    monkeypatch.setattr(draft_module, "_write", fill)
    with pytest.raises(OutputError, match="the disk is full"):
        bench.capture(PLAN)
    bench.draft.close()
    assert read_session(bench.draft.folder).manifest.views == ("left",)
    assert sorted(path.name for path in bench.draft.folder.iterdir()) == ["manifest.json", "views"]


def test_a_draft_without_views_leaves_nothing(bench: Bench) -> None:
    bench.draft.close()
    assert not bench.draft.folder.exists()


@pytest.mark.slow
def test_the_session_is_published_whole(bench: Bench, tmp_path: Path) -> None:
    bench.capture(PLAN)
    out = tmp_path / "session"
    bench.draft.publish(out)
    assert read_session(out).manifest.views == VIEWS
    assert not bench.draft.folder.exists()


@pytest.mark.slow
def test_the_session_can_be_an_archive(bench: Bench, tmp_path: Path) -> None:
    bench.capture(PLAN)
    bench.draft.publish(tmp_path / "session.zip")
    assert read_session(tmp_path / "session.zip").manifest.views == VIEWS


def test_a_second_user_is_told(bench: Bench) -> None:
    with (
        bench.rig.open("A1"),
        pytest.raises(SensorError, match="used by another program; close that program first"),
    ):
        bench.rig.open("A1")


def test_no_sensor(make: Callable[..., Bench]) -> None:
    bench = make(serials=())
    with pytest.raises(NoSensorFoundError, match="No sensor is plugged in"):
        bench.rig.require()


def test_an_unknown_sensor_names_those_that_are_there(bench: Bench) -> None:
    with pytest.raises(NoSensorFoundError, match=r"No sensor has the number Z9.*A1, B2, C3"):
        open_sensors(bench.rig, ["A1", "Z9"])
    open_sensors(bench.rig, ["A1"])["A1"].close()


def test_motor_only_says_that_power_is_missing(make: Callable[..., Bench]) -> None:
    bench = make(powered=False)
    assert all("12 V" in str(sensor.problem) for sensor in bench.rig.require().sensors)
    with pytest.raises(NoSensorFoundError, match="12 V supply"):
        bench.rig.open("A1")


def test_no_permission_names_the_rule(bench: Bench) -> None:
    bench.emulated.denied = True
    assert all("70-kinect-v1.rules" in str(s.problem) for s in bench.rig.find().sensors)
    with pytest.raises(SensorError, match=r"70-kinect-v1\.rules"):
        bench.rig.open("A1")


def test_a_foot_that_moves_is_warned_of(bench: Bench) -> None:
    kinect = bench.kinects["A1"]
    frames = bench.depth["A1"]
    moved = [
        np.where(f < 2047, f + 40 * (i >= 3), f).astype(np.uint16) for i, f in enumerate(frames)
    ]

    kinect.camera.footage = make_footage(moved, [color_mosaic(0)])
    plan = make_plan([("left", "A1")], frames=6)
    assert any("Something moved while view left" in text for text in bench.capture(plan))


def test_a_plan_is_small_enough_to_send(bench: Bench) -> None:
    assert pickle.loads(pickle.dumps(PLAN)) == PLAN
    assert isinstance(PLAN, CapturePlan)
