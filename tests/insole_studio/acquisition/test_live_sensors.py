"""The sensors of a rig while they are plugged in and out."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from capture_samples import SERIALS, Bench

from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.recording.reader import read_session
from insole_studio.acquisition.kinect_sensors import KinectPort
from insole_studio.acquisition.live_sensors import LiveSensors
from insole_studio.acquisition.rig import Rig
from insole_studio.acquisition.sensor_source import EmulatedRig
from kinect_v1.usb_bus import UsbBus
from tests.patience import wait_for


@pytest.fixture
def live(bench: Bench) -> Iterator[LiveSensors]:
    opened = LiveSensors(bench.rig, lambda _slot, _image: None)
    opened.find()
    opened.start()
    yield opened
    opened.close()


def pump_until(live: LiveSensors, is_done: Callable[[], bool]) -> None:
    def pumped() -> bool:
        live.pump()
        return is_done()

    wait_for(pumped)


@pytest.mark.slow
def test_a_sensor_that_is_plugged_in_again_comes_back(bench: Bench, live: LiveSensors) -> None:
    assert [state.serial for state in live.summary.states] == list(SERIALS)
    assert not live.is_time_to_find
    bench.emulated.unplug(bench.kinects["B2"])
    pump_until(live, lambda: "B2" not in live.opened)
    problems = {state.serial: state.problem for state in live.summary.states}
    assert "unplugged" in (problems.pop("B2") or "")
    assert set(problems.values()) == {None}
    assert live.is_time_to_find
    live.find()
    assert not live.is_time_to_find
    bench.emulated.plug(bench.kinects["B2"], 5)
    assert live.is_time_to_find
    live.drop_lost()
    live.find()
    live.start()
    pump_until(live, lambda: all(state.fps > 0 for state in live.summary.states))
    assert {state.serial: state.bus for state in live.summary.states}["B2"] == 5
    assert not any(state.problem for state in live.summary.states)


def test_a_sensor_whose_controller_is_full_waits(make: Callable[..., Bench]) -> None:
    bench = make(controllers=[4, 4, 5])
    live = LiveSensors(bench.rig, lambda _slot, _image: None)
    live.find()
    live.start()
    problems = [state.problem for state in live.summary.states]
    live.close()
    assert [problem is not None for problem in problems] == [False, True, False]
    assert "bus 4 is full" in str(problems[1])


def test_infrared_in_place_of_colour_and_back(small_session: Path) -> None:
    shown: list[RawArray | ByteArray] = []
    live = LiveSensors(
        Rig(KinectPort(UsbBus(EmulatedRig(read_session(small_session)).bus))),
        lambda slot, image: shown.append(image) if slot == 0 else None,
    )
    live.find()
    live.start()
    serial = live.summary.states[0].serial

    def comes(shape: tuple[int, ...], dtype: type) -> bool:
        return any(image.shape == shape and image.dtype == dtype for image in shown)

    try:
        live.watch_infrared(serial, on=True)
        live.start()
        pump_until(live, lambda: comes((480, 640), np.uint8) and comes((480, 640), np.uint16))
        live.watch_infrared(serial, on=False)
        shown.clear()
        pump_until(live, lambda: comes((512, 640, 3), np.uint8))
    finally:
        live.close()


def test_level_and_lean(bench: Bench) -> None:
    motor = bench.kinects["A1"].motor
    assert motor is not None
    with bench.rig.open("A1") as sensor:
        sensor.tilt_to(-12.0)
        assert (sensor.tilt_deg(), sensor.roll_deg()) == (-12.0, 0.0)
        motor.acceleration_counts = (-57, 817, 40)
        assert sensor.roll_deg() == pytest.approx(-3.99, abs=0.01)
