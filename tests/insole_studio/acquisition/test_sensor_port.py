"""A rig of two families: Kinects, and a camera that can do nothing beyond depth and colour."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Self

import numpy as np
import pytest
from capture_samples import Bench

from insole_core.geometry.arrays import ByteArray
from insole_core.sensing.sensor import Sensor, nominal_kinect
from insole_studio.acquisition.kinect_sensors import KinectPort
from insole_studio.acquisition.live_sensors import LiveSensors
from insole_studio.acquisition.messages import Capability, DetectedSensor
from insole_studio.acquisition.rig import Rig
from insole_studio.acquisition.sensor_port import (
    ColorSize,
    DepthFrame,
    NoSensorFoundError,
    OpenSensor,
    Place,
    SensorError,
    SensorPort,
    require,
)
from kinect_v1.usb_bus import UsbBus
from tests.patience import wait_for

SERIAL = "942312"


class PlainVideo:
    """A grey picture."""

    time_s = 0.0

    def picture(self) -> ByteArray:
        return np.full((108, 192, 3), 90, np.uint8)

    def preview(self) -> ByteArray:
        return self.picture()[::2, ::2]


@dataclass
class PlainCamera:
    """A camera without motor, light and infrared."""

    serial: str = SERIAL
    model: str = "plain"
    bus: int = 7
    on_since_s: float = 0.0
    capabilities: frozenset[Capability] = frozenset()
    streams: bool = False
    discarded: int = 0

    @property
    def emits(self) -> bool:
        return self.streams

    def factory_sensor(self, faces: tuple[str, ...]) -> Sensor:
        return nominal_kinect(self.serial)

    def start(self, color_size: ColorSize | None = None) -> None:
        self.streams = True

    def start_infrared(self) -> None:
        raise AssertionError("nobody may ask for it")

    @contextmanager
    def reserving(self) -> Iterator[None]:
        yield

    def stop_depth(self) -> None:
        self.streams = False

    stop = stop_depth

    def poll_depth(self) -> DepthFrame | None:
        image = np.full((72, 128), 5200, np.uint16)
        return DepthFrame(image, time.monotonic(), 0) if self.streams else None

    def poll_video(self) -> PlainVideo | None:
        return PlainVideo() if self.streams else None

    def tilt_deg(self) -> float:
        raise AssertionError("nobody may ask for it")

    roll_deg = tilt_deg

    def tilt_to(self, tilt_deg: float) -> None:
        raise AssertionError("nobody may ask for it")

    def blink(self, on: bool) -> None:
        raise AssertionError("nobody may ask for it")

    def keep_warm_up(self) -> None:
        """It needs none."""

    def close(self) -> None:
        self.stop()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_error: object) -> None:
        self.close()


class PlainPort:
    """Finds one camera, or fails as a library that is missing."""

    def __init__(self, problem: str = "") -> None:
        self._problem = problem

    def find(self) -> tuple[DetectedSensor, ...]:
        if self._problem:
            raise SensorError(self._problem)
        return (DetectedSensor(SERIAL, "plain", 7, "7-1"),)

    def places(self) -> frozenset[Place]:
        return frozenset({("plain", 7, 1)})

    def open(self, serial: str) -> OpenSensor:
        if serial != SERIAL:
            raise NoSensorFoundError("No plain camera has this serial number; plug it in.")
        return PlainCamera()


@pytest.fixture
def kinects(bench: Bench) -> SensorPort:
    return KinectPort(UsbBus(bench.emulated))


def test_the_sensors_of_all_families_are_found_and_opened(kinects: SensorPort) -> None:
    rig = Rig(kinects, PlainPort())
    assert [sensor.serial for sensor in rig.require()] == ["A1", "B2", "C3", SERIAL]
    assert {family for family, *_ in rig.places()} == {"kinect-v1", "plain"}
    with rig.open(SERIAL) as plain, rig.open("B2") as kinect:
        assert (plain.model, kinect.capabilities) == ("plain", frozenset(Capability))
    with pytest.raises(NoSensorFoundError):
        rig.open("D4")


def test_a_family_that_cannot_be_looked_for_hides_no_other(kinects: SensorPort) -> None:
    missing = PlainPort("The library of the camera is missing; install it.")
    assert len(Rig(missing, kinects).find()) == 3
    with pytest.raises(SensorError, match="library of the camera is missing"):
        Rig(missing).find()


def test_only_what_a_sensor_can_do_is_asked_of_it() -> None:
    shown: list[tuple[int, ...]] = []
    live = LiveSensors(Rig(PlainPort()), lambda _slot, image: shown.append(image.shape))
    live.find()
    live.start()
    wait_for(lambda: live.pump() and (54, 96, 3) in shown and (72, 128) in shown)
    live.watch_infrared(SERIAL, on=True)
    (state,) = live.summary.states
    assert state.capabilities == frozenset()
    assert state.problem == f"Sensor {SERIAL} sends no infrared pictures; choose one that does."
    with pytest.raises(SensorError, match="has no motor; turn it by hand"):
        require(live.opened[SERIAL], Capability.TILT)
    live.close()
