"""Sensors with pictures that tell every frame, pixel and sensor apart."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from kinect_samples import FRAMES, SERIALS, SPEED, Footage, Images, make_calibration, make_image

from kinect_v1.emulation.bus import EmulatedBus
from kinect_v1.emulation.device import EmulatedKinect
from kinect_v1.models import Model
from kinect_v1.modes import MODES
from kinect_v1.pixels import encode_image
from kinect_v1.usb_bus import UsbBus


@pytest.fixture(scope="session")
def images() -> Images:
    """Three pictures of every mode for every sensor."""
    return {
        serial: {
            mode.name: [make_image(mode, 1000 * i + 10 * j + k) for k in range(FRAMES)]
            for j, mode in enumerate(MODES.values())
        }
        for i, serial in enumerate(SERIALS)
    }


@pytest.fixture(scope="session")
def footage(images: Images) -> Footage:
    """The same, packed as the sensors send them."""
    return {
        serial: {
            name: [encode_image(image, MODES[name]) for image in pictures]
            for name, pictures in by_mode.items()
        }
        for serial, by_mode in images.items()
    }


@pytest.fixture
def kinects(footage: Footage) -> list[EmulatedKinect]:
    """One sensor of each model."""
    return [
        EmulatedKinect(model, serial, make_calibration(i), footage[serial])
        for i, (model, serial) in enumerate(zip(Model, SERIALS, strict=True))
    ]


@pytest.fixture
def emulated(kinects: list[EmulatedKinect]) -> EmulatedBus:
    """A bus with the three sensors, each with a controller of its own."""
    return EmulatedBus(kinects, speed=SPEED)


@pytest.fixture
def bus(emulated: EmulatedBus) -> UsbBus:
    """The driver's view of it."""
    return UsbBus(emulated)


@pytest.fixture
def make_bus() -> Callable[..., UsbBus]:
    """Make a bus of other sensors."""

    def make(*sensors: EmulatedKinect, controllers: tuple[int, ...] | None = None) -> UsbBus:
        return UsbBus(EmulatedBus(sensors, controllers, SPEED))

    return make
