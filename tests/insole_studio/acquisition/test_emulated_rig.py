from __future__ import annotations

import json
import shutil
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from insole_core.errors import InputError
from insole_core.geometry.transforms import rigid
from insole_core.recording.reader import read_session
from insole_core.recording.session import Session
from insole_core.sensing.disparity import (
    DisparityModel,
    FactoryDisparity,
    LinearInverseDisparity,
    TangentDisparity,
)
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.acquisition.driver_values import factory_sensor, usual_sensor
from insole_studio.acquisition.kinect_sensors import KinectPort
from insole_studio.acquisition.rig import Rig
from insole_studio.acquisition.sensor_port import DepthFrame, OpenSensor
from insole_studio.acquisition.sensor_source import (
    EmulatedRig,
    SensorSource,
    emulated_bursts,
    emulated_views,
    factory_calibration,
)
from kinect_v1.emulation.playback import TYPICAL_CALIBRATION
from kinect_v1.usb_bus import UsbBus
from tests.patience import wait_for


def sensor(disparity: DisparityModel) -> Sensor:
    depth = PinholeCamera(640, 480, 587.3, 587.3, 319.0, 242.0)
    color = PinholeCamera(1280, 1024, 1030.0, 1030.0, 640.0, 512.0)
    return Sensor("kinect-v1", "A1", depth, color, rigid(np.eye(3), np.zeros(3)), disparity)


@pytest.mark.parametrize(
    "disparity",
    [
        LinearInverseDisparity(3.0933627, -0.0028379474),
        FactoryDisparity(1200.0, 1.0217, 75.0, 200.7),
    ],
)
def test_an_emulated_device_measures_like_its_sensor(disparity: DisparityModel) -> None:
    made = factory_sensor(factory_calibration(sensor(disparity)), "A1", ("sole",))
    raw = np.arange(300.0, 1000.0)
    assert np.allclose(made.disparity.depth_mm(raw), disparity.depth_mm(raw), rtol=1e-6)
    assert made.depth_camera.fx == pytest.approx(587.3)


def test_a_model_that_no_device_has_gets_the_usual_values() -> None:
    assert factory_calibration(sensor(TangentDisparity(123.6, 2842.5, 1.1863))) == (
        TYPICAL_CALIBRATION
    )


def test_a_smaller_picture_keeps_its_middle() -> None:
    large = usual_sensor("A1", ("sole",), (1280, 1024)).color_camera
    small = usual_sensor("A1", ("sole",), (640, 480)).color_camera
    assert (small.width, small.height, small.fx) == (640, 480, large.fx / 2)
    assert (small.cx, small.cy) == (319.5, 239.5)


def test_every_sensor_of_a_session_is_found(small_session: Path) -> None:
    session = read_session(small_session)
    rig = Rig(KinectPort(UsbBus(EmulatedRig(session).bus)))
    found = rig.require().sensors
    assert [s.serial for s in found] == [view.sensor.serial for view in session.views]
    assert len({s.bus for s in found}) == 3
    assert emulated_views(session) == tuple((v.name, v.sensor.serial) for v in session.views)
    assert emulated_bursts(session) == 1


def renamed(session: Session, names: Sequence[str], serials: Sequence[str]) -> Session:
    """Give the same views under other names, by other sensors."""
    views = tuple(
        replace(view, name=name, sensor=replace(view.sensor, serial=serial))
        for view, name, serial in zip(session.views, names, serials, strict=True)
    )
    return replace(session, manifest=replace(session.manifest, views=tuple(names)), views=views)


def test_bursts_and_places_are_told_apart(small_session: Path) -> None:
    session = read_session(small_session)
    bursts = renamed(session, ("left", "left_2", "left_3"), ("A", "A", "A"))
    assert (emulated_views(bursts), emulated_bursts(bursts)) == ((("left", "A"),), 3)
    mixed = renamed(session, ("left", "left_2", "right"), ("A", "B", "A"))
    assert emulated_views(mixed) == (("left", "A"), ("left_2", "B"), ("right", "A"))
    assert emulated_bursts(mixed) == 1


def test_a_session_of_another_camera_is_not_played_by_a_kinect(
    small_session: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "session"
    shutil.unpack_archive(small_session, folder)
    manifest, file = folder / "manifest.json", folder / "views" / "left" / "sensor.json"
    values, camera = json.loads(manifest.read_text()), json.loads(file.read_text())
    del camera["disparity"]
    camera.pop("disparity_correction", None)
    camera |= {"model": "realsense-d415", "depth_unit_mm": 1.0}
    manifest.write_text(json.dumps(values | {"version": 3}))
    file.write_text(json.dumps(camera))
    source = SensorSource(SensorStore(tmp_path), folder)
    with pytest.raises(InputError, match="its view left was recorded by a realsense-d415, neither"):
        source.setup()


def test_a_sensor_sees_what_its_tilt_and_its_place_show(small_session: Path) -> None:
    session = read_session(small_session)
    moved = renamed(session, ("left", "left_2", "right"), ("A", "A", "A"))
    room = EmulatedRig(moved, speed=4.0)

    def seen(sensor: OpenSensor) -> str:
        sensor.start()
        frames: list[DepthFrame] = []

        def has_come() -> bool:
            frames.extend(filter(None, [sensor.poll_depth()]))
            return bool(frames)

        wait_for(has_come)
        sensor.stop()
        image = frames[0].image
        (view,) = (v.name for v in moved.views if np.array_equal(v.read_depth(0), image))
        return view

    with Rig(KinectPort(UsbBus(room.bus))).open("A") as sensor:
        assert seen(sensor) == "left"
        sensor.tilt_to(1.0)
        assert seen(sensor) == "left_2"
        room.put("A", "right")
        assert seen(sensor) == "right"
        room.put("A", "nowhere")
        assert seen(sensor) == "right"
        room.put("A", "left")
        assert seen(sensor) == "left_2"
