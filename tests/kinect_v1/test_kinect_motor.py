"""Tilt, LED and accelerometer of all models."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from kinect_samples import SERIALS, make_calibration

from kinect_v1.emulation.device import EmulatedKinect
from kinect_v1.errors import UnsupportedError
from kinect_v1.kinect_camera import open_camera
from kinect_v1.models import Model
from kinect_v1.motor import Led, Posture
from kinect_v1.usb_bus import UsbBus


def test_model_1414_through_its_motor(bus: UsbBus, kinects: list[EmulatedKinect]) -> None:
    device = kinects[0].motor
    assert device is not None
    device.acceleration_counts = (-819, 0, 1638)
    with open_camera(SERIALS[0], bus=bus) as camera:
        camera.motor.set_tilt(-12.5)
        camera.motor.set_led(Led.BLINK_GREEN)
        assert camera.motor.posture() == Posture((-1.0, 0.0, 2.0), -12.5, False)
        camera.motor.set_tilt(99)
    assert (device.led, device.tilt_deg) == (4, 31)


@pytest.mark.parametrize("index", [1, 2])
def test_newer_models_through_their_audio_part(
    index: int, bus: UsbBus, kinects: list[EmulatedKinect]
) -> None:
    device = kinects[index].audio
    device.acceleration_counts = (0, -819, 0)
    with open_camera(SERIALS[index], bus=bus) as camera:
        camera.motor.set_tilt(-40)
        camera.motor.set_led(Led.GREEN)
        assert camera.motor.posture() == Posture((0.0, -1.0, 0.0), -31.0, None)
    assert (device.led, device.tilt_deg) == (3, -31)


def test_newer_models_are_lit_when_they_are_opened(
    make_bus: Callable[..., UsbBus], kinects: list[EmulatedKinect]
) -> None:
    bus = make_bus(*kinects)
    for serial, kinect in zip(SERIALS, kinects, strict=True):
        open_camera(serial, bus=bus).close()
        assert kinect.audio.led == (0 if kinect.motor else 3)


def test_without_firmware_only_the_led_works(make_bus: Callable[..., UsbBus]) -> None:
    kinect = EmulatedKinect(Model.WINDOWS, SERIALS[0], make_calibration(0), {}, firmware=False)
    with open_camera(bus=make_bus(kinect)) as camera:
        camera.motor.set_led(Led.RED)
        with pytest.raises(UnsupportedError, match="firmware"):
            camera.motor.set_tilt(1)
        with pytest.raises(UnsupportedError, match="firmware"):
            camera.motor.posture()
    assert kinect.audio.led == 4


def test_a_sensor_without_a_motor_on_the_bus(make_bus: Callable[..., UsbBus]) -> None:
    kinect = EmulatedKinect(Model.XBOX_1414, SERIALS[0], make_calibration(0), {})
    kinect.functions = lambda: [kinect.camera]  # type: ignore[method-assign]
    with (
        open_camera(bus=make_bus(kinect)) as camera,
        pytest.raises(UnsupportedError, match="do not answer"),
    ):
        camera.motor.posture()
