"""Which sensors are there, and what belongs together."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from kinect_samples import SERIALS, make_calibration

from kinect_v1.emulation.bus import EmulatedBus
from kinect_v1.emulation.device import EmulatedKinect
from kinect_v1.errors import NoPermissionError
from kinect_v1.models import Model, camera_model
from kinect_v1.sensors import find_sensor, list_sensors
from kinect_v1.usb_bus import UsbBus


def make_kinect(model: Model, serial: str) -> EmulatedKinect:
    return EmulatedKinect(model, serial, make_calibration(0), {})


def test_models_are_told_by_product_and_release() -> None:
    assert camera_model(0x02AE, 0x010B) is Model.XBOX_1414
    assert camera_model(0x02AE, 0x0114) is Model.XBOX_1473
    assert camera_model(0x02BF, 0x010B) is Model.WINDOWS


def test_sensors_are_listed_by_serial_model_and_place(bus: UsbBus) -> None:
    found = [(s.serial, s.model, s.bus, s.place, s.problem) for s in list_sensors(bus)]
    assert found == [
        (serial, model, i + 1, f"{i + 1}-1.1", None)
        for i, (serial, model) in enumerate(zip(SERIALS, Model, strict=True))
    ]


def test_two_cameras_of_zeros_on_one_controller_keep_their_own_numbers(
    make_bus: Callable[..., UsbBus],
) -> None:
    sensors = [make_kinect(Model.XBOX_1473, serial) for serial in SERIALS]
    bus = make_bus(*sensors, controllers=(1, 1, 1))
    assert [sensor.serial for sensor in list_sensors(bus)] == list(SERIALS)
    assert find_sensor(bus, SERIALS[1])[0].camera.ports == (2, 1)


def test_a_camera_of_zeros_without_audio_is_named_by_its_place(
    make_bus: Callable[..., UsbBus],
) -> None:
    sensor = make_kinect(Model.XBOX_1473, SERIALS[0])
    sensor.functions = lambda: [sensor.camera]  # type: ignore[method-assign]
    assert [s.serial for s in list_sensors(make_bus(sensor))] == ["at-1-1.1"]


def test_a_motor_alone_says_that_the_supply_is_missing(make_bus: Callable[..., UsbBus]) -> None:
    dark = EmulatedKinect(Model.XBOX_1414, SERIALS[0], make_calibration(0), {}, powered=False)
    (found,) = list_sensors(make_bus(dark))
    assert found.serial is None
    assert "12 V" in (found.problem or "")


def test_a_denied_sensor_is_listed_with_the_rule(emulated: EmulatedBus) -> None:
    emulated.denied = True
    bus = UsbBus(emulated)
    assert all("70-kinect-v1.rules" in (s.problem or "") for s in list_sensors(bus))
    with pytest.raises(NoPermissionError):
        find_sensor(bus, SERIALS[0])


def test_identity_does_not_depend_on_the_order_of_plugging(
    kinects: list[EmulatedKinect],
) -> None:
    for order in (kinects, kinects[::-1]):
        found, serial = find_sensor(UsbBus(EmulatedBus(order)), SERIALS[2])
        assert (found.model, serial) == (Model.WINDOWS, SERIALS[2])
