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

from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.sensing.sensor import Sensor, nominal_kinect
from insole_studio.acquisition.kinect_sensors import KinectPort
from insole_studio.acquisition.live_sensors import LiveSensors
from insole_studio.acquisition.messages import (
    UNTUNED,
    Capability,
    DetectedSensor,
    LaserRange,
    Tuning,
)
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
CAN = (Capability.TILT, Capability.BLINK, Capability.INFRARED)


class PlainVideo:
    """A grey picture."""

    time_s = 0.0

    def picture(self) -> ByteArray:
        return np.full((108, 192, 3), 90, np.uint8)

    def preview(self) -> ByteArray:
        return self.picture()[::2, ::2]

    def dots(self) -> RawArray:
        raise AssertionError("nobody may ask for it")


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

    temperature_c: float | None = None
    tuning: Tuning = UNTUNED
    laser_range: LaserRange | None = None

    def tune(self, tuning: Tuning) -> None:
        raise AssertionError("nobody may ask for it")

    def poll_pair(self) -> None:
        raise AssertionError("nobody may ask for it")

    def hold_exposure(self) -> None:
        """It has one exposure."""

    free_exposure = hold_exposure

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
        if self._problem:
            raise SensorError(self._problem)
        return frozenset({("plain", 7, 1)})

    def open(self, serial: str) -> OpenSensor:
        if self._problem:
            raise SensorError(self._problem)
        if serial != SERIAL:
            raise NoSensorFoundError("No plain camera has this serial number; plug it in.")
        return PlainCamera()


@pytest.fixture
def kinects(bench: Bench) -> SensorPort:
    return KinectPort(UsbBus(bench.emulated))


def test_the_sensors_of_all_families_are_found_and_opened(kinects: SensorPort) -> None:
    rig = Rig(kinects, PlainPort())
    found = rig.require()
    assert not found.problems
    assert [sensor.serial for sensor in found.sensors] == ["A1", "B2", "C3", SERIAL]
    assert {family for family, *_ in rig.places()} == {"kinect-v1", "plain"}
    with rig.open(SERIAL) as plain, rig.open("B2") as kinect:
        assert (plain.model, kinect.capabilities) == ("plain", frozenset(CAN))
    with pytest.raises(NoSensorFoundError, match=r"No sensor has the number D4.* No plain camera"):
        rig.open("D4")


def test_a_family_that_cannot_be_looked_for_hides_no_other(kinects: SensorPort) -> None:
    sentence = "The library of the camera is missing; install it."
    missing = PlainPort(sentence)
    rig = Rig(missing, kinects)
    found = rig.find()
    assert (len(found.sensors), found.problems) == (3, (sentence,))
    assert {family for family, *_ in rig.places()} == {"kinect-v1"}
    with rig.open("B2") as kinect:
        assert kinect.serial == "B2"
    with pytest.raises(SensorError, match="library of the camera is missing"):
        rig.open(SERIAL)
    with pytest.raises(SensorError, match="library of the camera is missing"):
        Rig(missing).find()


def test_the_window_has_the_others_and_says_why_a_family_is_missing(kinects: SensorPort) -> None:
    sentence = "The library of the camera is missing; install it."
    live = LiveSensors(Rig(kinects, PlainPort(sentence)), lambda _slot, _image: None)
    live.find()
    assert sorted(live.opened) == ["A1", "B2", "C3"]
    assert live.summary.problem == sentence
    assert not live.is_time_to_find
    live.close()


def test_all_families_that_fail_say_why() -> None:
    rig = Rig(PlainPort("One is missing."), PlainPort("Another is missing."))
    for failing in (rig.find, rig.require, lambda: rig.open(SERIAL)):
        with pytest.raises(SensorError, match=r"One is missing\. Another is missing\."):
            failing()


def test_only_what_a_sensor_can_do_is_asked_of_it() -> None:
    shown: list[tuple[int, ...]] = []
    live = LiveSensors(Rig(PlainPort()), lambda _slot, image: shown.append(image.shape))
    live.find()
    live.start()
    wait_for(lambda: live.pump() and (54, 96, 3) in shown and (72, 128) in shown)
    works = live.opened[SERIAL]
    with pytest.raises(SensorError, match=f"{SERIAL} sends no infrared pictures; choose one that"):
        live.watch_infrared(SERIAL, on=True)
    live.drop_lost()
    live.find()
    live.start()
    (state,) = live.summary.states
    assert live.opened[SERIAL] is works
    assert (state.capabilities, state.problem) == (frozenset(), None)
    with pytest.raises(SensorError, match="has no motor; turn it by hand"):
        require(live.opened[SERIAL], Capability.TILT)
    live.close()
