from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from insole_core.geometry.transforms import rigid
from insole_core.recording.reader import read_session
from insole_core.sensing.camera import Camera
from insole_core.sensing.disparity import (
    DisparityModel,
    FactoryDisparity,
    LinearInverseDisparity,
    TangentDisparity,
)
from insole_core.sensing.sensor import Sensor
from insole_studio.capture.emulation import emulated_bus, emulated_views, factory_calibration
from insole_studio.capture.factory import factory_sensor, usual_sensor
from insole_studio.capture.rig import Rig
from kinect_v1.emulation.playback import TYPICAL_CALIBRATION
from kinect_v1.usb_bus import UsbBus


def sensor(disparity: DisparityModel) -> Sensor:
    depth = Camera(640, 480, 587.3, 587.3, 319.0, 242.0)
    color = Camera(1280, 1024, 1030.0, 1030.0, 640.0, 512.0)
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
    rig = Rig(UsbBus(emulated_bus(session)))
    found = rig.require()
    assert [s.serial for s in found] == [view.sensor.serial for view in session.views]
    assert len({s.bus for s in found}) == 3
    assert emulated_views(session) == tuple((v.name, v.sensor.serial) for v in session.views)
