"""RealSense cameras behind the port: captures of them, alone and beside a Kinect."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from capture_samples import NothingStored, depth_frames, footage
from realsense_samples import COLOR, FRAMES, camera

from insole_core.calibration.markers.reference_file import load_reference_system
from insole_core.errors import InputError
from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.geometry.side import Side
from insole_core.recording.reader import read_session
from insole_core.recording.session import Manifest
from insole_core.resources import resource_path
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor, nominal_kinect
from insole_studio.acquisition import draft
from insole_studio.acquisition.capture_plan import make_plan
from insole_studio.acquisition.capture_runner import (
    CaptureCallbacks,
    CaptureRunner,
    close_sensors,
    open_sensors,
)
from insole_studio.acquisition.capture_setup import DEFAULT_SYSTEM, CaptureSetup
from insole_studio.acquisition.draft import Draft
from insole_studio.acquisition.guidance import centre_depth_mm
from insole_studio.acquisition.kinect_sensors import KinectPort
from insole_studio.acquisition.live_sensors import LiveSensors
from insole_studio.acquisition.messages import (
    UNTUNED,
    Capability,
    CapturePhase,
    CaptureStatus,
    LaserRange,
    Preset,
    Tuning,
)
from insole_studio.acquisition.realsense_sensors import RealSensePort, sensor_of
from insole_studio.acquisition.rig import Rig
from insole_studio.acquisition.sensor_port import (
    BusFullError,
    DepthFrame,
    OpenSensor,
    SensorError,
    require,
)
from insole_studio.acquisition.sensor_source import SensorSource
from insole_studio.acquisition.stabilisation import StabilisationRule
from insole_studio.acquisition.tunings import Tunings
from insole_studio.cli.main import run
from kinect_v1.emulation.bus import EmulatedBus
from kinect_v1.emulation.device import EmulatedKinect
from kinect_v1.emulation.playback import TYPICAL_CALIBRATION
from kinect_v1.models import Model
from kinect_v1.usb_bus import UsbBus
from realsense_d400.camera import Calibration, Intrinsics
from realsense_d400.emulation import EmulatedCamera, EmulatedCameras, Make, record
from realsense_d400.settings import CameraSettings
from tests.patience import wait_for

SPEED = 4.0
SERIALS = ("815", "816", "A1")
VIEWS = ("left", "right", "top")


@dataclass
class Place:
    """Two RealSense cameras, and a Kinect where one is wanted."""

    cameras: EmulatedCameras
    rig: Rig
    setup: CaptureSetup
    draft: Draft
    told: list[CaptureStatus] = field(default_factory=list)
    sensors: dict[str, OpenSensor] = field(default_factory=dict)

    def capture(self, *views: str, **watching: Any) -> tuple[str, ...]:
        pairs = [pair for pair in zip(VIEWS, SERIALS, strict=True) if pair[0] in views]
        plan = make_plan(pairs, frames=4)
        self.sensors = open_sensors(self.rig, plan.serials)
        callbacks = CaptureCallbacks(**{"report": self.told.append, **watching})
        return CaptureRunner(self.sensors, plan, self.setup, self.draft, callbacks).run()


@pytest.fixture
def place(tmp_path: Path) -> Iterator[Callable[..., Place]]:
    made: list[Place] = []

    def build(*cameras: EmulatedCamera) -> Place:
        plugged = EmulatedCameras(cameras or (camera("815"), camera("816")), SPEED)
        kinect = EmulatedKinect(Model.XBOX_1414, "A1", TYPICAL_CALIBRATION, footage(0, 0))
        rig = Rig(KinectPort(UsbBus(EmulatedBus([kinect], speed=SPEED))), RealSensePort(plugged))
        system = load_reference_system(resource_path(DEFAULT_SYSTEM))
        manifest = Manifest("2026-11-27T10:00:00+00:00", Side.LEFT, system, ())
        setup = CaptureSetup(system, NothingStored())
        made.append(Place(plugged, rig, setup, Draft(tmp_path / f"d{len(made)}", manifest, VIEWS)))
        return made[-1]

    yield build
    for one in made:
        close_sensors(one.sensors.values())
        one.cameras.close()
        one.draft.close()


def test_a_rig_of_both_kinds_takes_all_realsense_views_at_once(
    place: Callable[..., Place],
) -> None:
    ours = place()
    warnings = ours.capture(*VIEWS)
    names = [status.names for status in ours.told if status.phase is CapturePhase.VERIFYING]
    assert list(dict.fromkeys(names)) == [("left", "right"), ("top",)]
    assert sum("used as its factory calibrated it" in warning for warning in warnings) == 2
    session = read_session(ours.draft.folder)
    assert session.manifest.metric
    left, right, top = session.views
    assert top.read_depth(0)[0, 0] in {frame[0, 0] for frame in depth_frames(0)}
    for view, serial in ((left, "815"), (right, "816")):
        sent = camera(serial)
        for index in range(4):
            assert any(np.array_equal(view.read_depth(index), one) for one in sent.depth)
        assert any(np.array_equal(view.read_color(0), one) for one in sent.color)
        assert (view.sensor.depth_unit_mm, view.sensor.baseline_mm) == (0.1, 55.0)
        assert view.times is not None
        assert view.times.depth_ms[0] == 0
        assert len(view.times.depth_ms) == 4
        assert list(view.times.depth_ms) == sorted(view.times.depth_ms)
    kept = json.loads((ours.draft.folder / "manifest.json").read_text())["capture"]
    assert (kept["left"]["temperature_c"], "temperature_c" in kept["top"]) == (36.5, False)
    assert (kept["left"]["preset"], kept["left"]["laser_mw"]) == ("high-accuracy", 150.0)
    assert not {"preset", "laser_mw"} & kept["top"].keys()


def test_while_a_kinect_measures_the_projectors_are_off(place: Callable[..., Place]) -> None:
    ours = place()

    def look(status: CaptureStatus) -> None:
        if status.phase is CapturePhase.CAPTURING:
            lit.append({serial for serial, one in ours.sensors.items() if one.emits})

    lit: list[set[str]] = []
    ours.capture(*VIEWS, report=look)
    assert {"815", "816"} in lit
    assert {"A1"} in lit
    assert all(len({serial == "A1" for serial in one}) == 1 for one in lit)


@pytest.mark.parametrize("phase", [CapturePhase.SETTLING, CapturePhase.CAPTURING])
def test_unplugging_during_a_capture_is_told_and_finished_views_are_kept(
    place: Callable[..., Place], phase: CapturePhase
) -> None:
    ours = place()
    ours.capture("left")
    close_sensors(ours.sensors.values())

    def pull(status: CaptureStatus) -> None:
        if status.phase is phase and len(ours.cameras.devices()) == 2:
            ours.cameras.unplug("816")

    frames = 60 if phase is CapturePhase.CAPTURING else 4
    plan = make_plan([("right", "816")], frames=frames)
    ours.sensors = open_sensors(ours.rig, plan.serials)
    runner = CaptureRunner(
        ours.sensors, plan, ours.setup, ours.draft, CaptureCallbacks(report=pull)
    )
    with pytest.raises(SensorError, match=r"RealSense 816 was unplugged.* Kept so far: left\."):
        runner.run()
    assert ours.draft.views == ("left",)


def test_unplugged_between_finding_and_opening_it_is_not_there(
    place: Callable[..., Place],
) -> None:
    ours = place()
    assert [one.serial for one in ours.rig.find().sensors] == ["A1", "815", "816"]
    ours.cameras.unplug("816")
    with pytest.raises(SensorError, match="No RealSense has the number 816; plug it in"):
        ours.rig.open("816")


def test_the_window_drops_a_camera_that_was_unplugged_and_takes_it_again(
    place: Callable[..., Place],
) -> None:
    ours = place()
    shown: list[tuple[int, ...]] = []
    live = LiveSensors(ours.rig, lambda _slot, image: shown.append(image.shape))
    live.find()
    live.start()
    wait_for(lambda: live.pump() and {(96, 160), (108, 192, 3), (480, 640)} <= set(shown))
    (state,) = (one for one in live.summary.states if one.serial == "815")
    assert state.factory is not None
    assert (state.model, state.factory.depth_unit_mm) == ("realsense-d415", 0.1)
    ours.cameras.unplug("815")
    wait_for(lambda: live.pump() is not None and "815" not in live.opened)
    assert "815 was unplugged" in next(
        one.problem or "" for one in live.summary.states if one.serial == "815"
    )
    assert live.is_time_to_find
    ours.cameras.plug("815")
    live.find()
    assert "815" in live.opened
    live.close()


def test_what_a_realsense_cannot_do_is_told_in_a_sentence(place: Callable[..., Place]) -> None:
    with place().rig.open("815") as opened:
        for capability in (Capability.TILT, Capability.BLINK, Capability.INFRARED):
            with pytest.raises(SensorError, match="Sensor 815 "):
                require(opened, capability)


def test_what_is_set_of_a_camera_is_kept_for_it_alone(
    place: Callable[..., Place], tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    ours, file = place(), tmp_path / "settings" / "kept.json"

    def opened(serial: str, asked: Tuning = UNTUNED) -> OpenSensor:
        return RealSensePort(ours.cameras, tunings=Tunings(file, asked)).open(serial)

    with opened("815") as one:
        assert {Capability.PRESET, Capability.LASER} <= one.capabilities
        assert one.laser_range == LaserRange(0.0, 360.0, 1.0)
        assert one.tuning == Tuning(Preset.HIGH_ACCURACY, 150.0)
        one.tune(Tuning(Preset.HIGH_DENSITY, 210.4))
        dense = Tuning(Preset.HIGH_DENSITY, 210.0)
        assert one.tuning == dense
    with opened("815") as again, opened("816") as other:
        assert (again.tuning, other.tuning) == (dense, Tuning(Preset.HIGH_ACCURACY, 150.0))
    asked = Tuning(Preset.HIGH_ACCURACY, 30.0)
    with opened("815", asked) as one:
        assert one.tuning == asked
    file.write_text(file.read_text().replace("210.0", "9999"))
    with opened("815") as one:
        assert one.tuning.laser_mw == 360.0
    file.write_text("{")
    with opened("815") as one:
        assert one.tuning.preset is Preset.HIGH_ACCURACY
    assert "sensors start as they are" in caplog.text


def large(serial: str, bus: int, **options: Any) -> EmulatedCamera:
    """Return a camera with the pictures of a D415, which nobody looks at."""
    no_lens = (0.0, 0.0, 0.0, 0.0, 0.0)
    depth = Intrinsics(1280, 720, 920.0, 920.0, 640.0, 360.0, no_lens, inverse=False)
    color = Intrinsics(1920, 1080, 1370.0, 1370.0, 960.0, 540.0, no_lens, inverse=False)
    calibration = Calibration(depth, color, np.eye(3), np.zeros(3), 0.1, 55.0)
    pictures = [np.zeros((720, 1280), np.uint16)], [np.zeros((1080, 1920, 3), np.uint8)]
    return EmulatedCamera(serial, calibration, *pictures, make=Make(bus=bus), **options)


def test_six_cameras_on_one_controller_are_told_before_the_first_frame(
    place: Callable[..., Place],
) -> None:
    serials = [str(number) for number in range(6)]
    ours = place(*(large(serial, 2) for serial in serials))
    plan = make_plan([(f"view_{serial}", serial) for serial in serials])
    ours.sensors = open_sensors(ours.rig, serials)
    runner = CaptureRunner(
        ours.sensors, plan, ours.setup, ours.draft, CaptureCallbacks(report=ours.told.append)
    )
    with pytest.raises(BusFullError, match="controller of RealSense 3 carries 3 cameras already"):
        runner.run()
    assert not ours.told
    assert not any(sensor.streams for sensor in ours.sensors.values())


def test_six_cameras_on_two_controllers_are_streamed(place: Callable[..., Place]) -> None:
    serials = [str(number) for number in range(6)]
    ours = place(*(large(serial, 2 + place % 2) for place, serial in enumerate(serials)))
    ours.sensors = open_sensors(ours.rig, serials)
    for sensor in ours.sensors.values():
        sensor.start()
    assert all(sensor.streams for sensor in ours.sensors.values())


def test_colour_that_is_late_is_told(place: Callable[..., Place]) -> None:
    ours = place(camera("815", color_late_s=-0.3))
    warnings = ours.capture("left")
    assert any("taken" in one and "ms apart from its depth" in one for one in warnings)


def test_what_the_window_is_shown_are_raw_units_of_as_many_readings_as_a_kinects(
    place: Callable[..., Place],
) -> None:
    """A picture of twice the focal length has four times as many pixels."""
    shown: list[RawArray | ByteArray] = []
    image = np.full((720, 1280), 5200, np.uint16)
    made = large("815", 2)
    made.depth = [image]
    ours = place(made)
    live = LiveSensors(ours.rig, lambda _slot, one: shown.append(one))
    live.find()
    live.start()
    wait_for(lambda: live.pump() and any(one.shape == (360, 640) for one in shown))
    small = next(one for one in shown if one.shape == (360, 640))
    sensor = live.opened["815"].factory_sensor(("sole",))
    assert centre_depth_mm(sensor.disparity, small) == pytest.approx(520.0, abs=0.4)
    assert all(one.shape[1] <= 640 for one in shown)
    live.close()


def test_a_recorded_session_of_both_kinds_is_played_by_emulated_cameras(
    place: Callable[..., Place], tmp_path: Path
) -> None:
    ours = place()
    ours.capture(*VIEWS)
    source = SensorSource(NothingStored(), ours.draft.folder)
    assert source.usual_views() == tuple(zip(VIEWS, ("815", "816", "A1"), strict=True))
    with source.rig().open("816") as opened:
        assert opened.factory_sensor(("sole",)).depth_camera == PinholeCamera(
            160, 96, 115.0, 115.0, 79.5, 45.25
        )
        opened.start()
        frame = next_depth(opened)
    view = read_session(ours.draft.folder).views[1]
    assert any(np.array_equal(frame.image, view.read_depth(index)) for index in range(4))
    assert [one.serial for one in source.rig().find().sensors] == ["A1", "815", "816"]


def test_bursts_are_those_of_the_sensors_with_a_motor(
    place: Callable[..., Place],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Of a Kinect three series, of the cameras beside it one; of cameras alone none is begun."""
    monkeypatch.setattr(draft, "drafts_folder_of_user", lambda: tmp_path / "drafts")
    ours = place()
    ours.capture("right", "top")
    call = ["capture", "--emulate", str(ours.draft.folder), "--frames", "2"]
    alone = [*call, "--bursts", "3", "--views", "right=816", "--out", str(tmp_path / "none")]
    assert run(alone) == 2
    told = capsys.readouterr().err.strip().splitlines()[-1]
    assert "none of these has one: 816. Capture one series of each view" in told
    assert not (tmp_path / "drafts").exists()
    mixed = [*call, "--bursts", "2", "--out", str(tmp_path / "both")]
    assert run(mixed) == 0
    assert read_session(tmp_path / "both").manifest.views == ("right", "top", "top_2")


def test_what_is_stored_of_a_kinect_is_not_for_a_realsense_of_its_number(
    place: Callable[..., Place],
) -> None:
    class Stored(NothingStored):
        def load(self, _serial: str) -> Sensor | None:
            return nominal_kinect("815")

    ours = place()
    ours.setup = CaptureSetup(ours.setup.system, Stored())
    with pytest.raises(InputError, match="815 is a realsense-d415, but what is stored under its"):
        ours.capture("left")


def test_depth_that_is_empty_everywhere_is_told(place: Callable[..., Place]) -> None:
    blind = camera("815")
    blind.depth = [np.zeros_like(image) for image in blind.depth]
    ours = place(blind)
    plan = make_plan([("left", "815")], frames=2)
    plan = replace(plan, settle=StabilisationRule(most_s=0.2))
    ours.sensors = open_sensors(ours.rig, plan.serials)
    callbacks = CaptureCallbacks(report=ours.told.append)
    warnings = CaptureRunner(ours.sensors, plan, ours.setup, ours.draft, callbacks).run()
    assert any("View left measured depth in only 0.0% of its picture" in one for one in warnings)


def test_the_pair_of_infrared_pictures_is_recorded_where_it_is_asked_for(
    place: Callable[..., Place],
) -> None:
    pairs = [(np.full((96, 160), n, np.uint8), np.full((96, 160), 9 + n, np.uint8)) for n in (3, 5)]
    ours = place(camera("815", infrared=pairs))
    ours.rig = Rig(RealSensePort(ours.cameras, settings=CameraSettings(infrared=True)))
    ours.capture("left")
    (view,) = read_session(ours.draft.folder).views
    left, right = (view.infrared[f"infrared_{eye}"].read(0) for eye in ("left", "right"))
    assert left[0, 0] in (3, 5)
    assert np.array_equal(right, left + 9)


def test_the_pair_can_be_switched_on_where_the_controller_has_room(
    place: Callable[..., Place], tmp_path: Path
) -> None:
    grey = np.zeros((720, 1280), np.uint8)
    ours = place(*(large(serial, 2, infrared=[(grey, grey)]) for serial in ("1", "2", "3")))
    tunings = Tunings(tmp_path / "kept.json")
    port = RealSensePort(ours.cameras, tunings=tunings)
    first, second, third = (port.open(serial) for serial in ("1", "2", "3"))
    ours.sensors = {one.serial: one for one in (first, second, third)}
    assert first.tuning.pair is False
    assert Capability.PAIR not in first.capabilities
    for one in ours.sensors.values():
        one.start()
    with pytest.raises(BusFullError, match=r"carries 2 cameras already.* so that 2 fit"):
        third.tune(Tuning(pair=True))
    assert (third.tuning.pair, third.streams, tunings.kept("3")) == (False, True, UNTUNED)
    second.stop()
    third.tune(Tuning(pair=True))
    assert Capability.PAIR in third.capabilities
    wait_for(lambda: third.poll_pair() is not None)
    third.close()
    with port.open("3") as again:
        assert again.tuning.pair
        again.tune(replace(again.tuning, pair=False))
        assert Capability.PAIR not in again.capabilities


def test_recordings_of_the_library_are_cameras_of_a_rig(tmp_path: Path) -> None:
    made = {serial: camera(serial) for serial in ("815", "816")}
    for serial, one in made.items():
        record(one, tmp_path / f"{serial}.db3", FRAMES)
    rig = SensorSource(NothingStored(), tmp_path).rig()
    assert [one.serial for one in rig.require().sensors] == ["815", "816"]
    with rig.open("816") as opened:
        assert not {Capability.PRESET, Capability.LASER} & opened.capabilities
        opened.start()
        frame = next_depth(opened)
    assert any(np.array_equal(frame.image, sent) for sent in made["816"].depth)
    (tmp_path / "cut.db3").write_bytes((tmp_path / "815.db3").read_bytes()[:5000])
    with pytest.raises(SensorError, match=r"cut\.db3 is no complete recording of a RealSense"):
        SensorSource(NothingStored(), tmp_path / "cut.db3").rig()


def next_depth(opened: OpenSensor) -> DepthFrame:
    frames: list[DepthFrame | None] = []

    def has_come() -> bool:
        frames.append(opened.poll_depth())
        return frames[-1] is not None

    wait_for(has_come)
    assert frames[-1] is not None
    return frames[-1]


def test_a_lens_that_leads_out_of_the_picture_is_turned_round() -> None:
    lens = (-0.055, 0.066, 0.0006, -0.0003, -0.021)
    turned = Intrinsics(1920, 1080, 1370.0, 1372.0, 958.0, 541.0, lens, inverse=True)
    calibration = Calibration(COLOR, turned, np.eye(3), np.zeros(3), 0.1, 55.0)
    ours = sensor_of(calibration, "815", "realsense-d415", ()).color_camera
    out = PinholeCamera(1920, 1080, 1370.0, 1372.0, 958.0, 541.0, lens)
    rows, columns = np.mgrid[0:1080:90, 0:1920:120]
    pixels = np.stack([columns.ravel(), rows.ravel()], axis=-1).astype(float)
    rays = np.column_stack([(pixels - [958.0, 541.0]) / [1370.0, 1372.0], np.ones(len(pixels))])
    straight = (out.project(rays) - [958.0, 541.0]) / [1370.0, 1372.0]
    back = ours.project(np.column_stack([straight, np.ones(len(straight))]))
    assert np.abs(back - pixels).max() < 0.1
