"""What the sensors of this computer tell about themselves, for ``doctor``."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

from insole_studio.acquisition import realsense_sensors
from insole_studio.acquisition.driver_values import translating
from insole_studio.acquisition.kinect_sensors import detected
from insole_studio.acquisition.messages import DetectedSensor
from kinect_v1.errors import KinectError
from kinect_v1.sensors import FoundSensor, SensorInfo, find_sensors, list_sensors
from kinect_v1.usb_bus import UsbBus, system_bus
from realsense_d400.cameras import CameraBus, SystemCameras, list_cameras

UDEV_RULES = ("70-kinect-v1.rules", "70-realsense.rules")
UDEV_FOLDERS = tuple(
    Path(root) / "udev" / "rules.d"
    for root in ("/etc", "/run", "/usr/lib", "/usr/local/lib", "/lib")
)


@dataclass(frozen=True)
class ExaminedSensor:
    """A sensor that is plugged in.

    Parameters
    ----------
    info
        As its driver lists it.
    release
        Number of its device, which goes with its firmware, or that of its firmware; empty where
        only a motor answers.
    has_motor_firmware
        Whether its motor can be moved; None where it cannot be told.
    shares
        Whether others fit beside it on its USB controller.
    """

    info: DetectedSensor
    release: str = ""
    has_motor_firmware: bool | None = None
    shares: bool = False


def examine_sensors(
    bus: UsbBus | None = None, cameras: CameraBus | None = None
) -> tuple[ExaminedSensor, ...]:
    """List the sensors that are plugged in, without disturbing any.

    Parameters
    ----------
    bus, cameras
        Of Kinects and RealSense cameras; by default the computer's own.

    Raises
    ------
    SensorError
        When libusb is missing, or a bus cannot be read.
    """
    return (*_kinects(bus), *_realsenses(cameras))


def _realsenses(cameras: CameraBus | None) -> tuple[ExaminedSensor, ...]:
    with realsense_sensors.translating():
        return tuple(
            ExaminedSensor(realsense_sensors.detected(info), info.firmware, shares=True)
            for info in list_cameras(cameras or SystemCameras())
        )


def _kinects(bus: UsbBus | None) -> tuple[ExaminedSensor, ...]:
    with translating():
        bus = system_bus() if bus is None else bus
        cameras, _ = find_sensors(bus)
        by_place = {(found.camera.bus, found.camera.place): found for found in cameras}
        return tuple(
            _examined(info, by_place.get((info.bus, info.place))) for info in list_sensors(bus)
        )


def has_udev_rule() -> bool:
    """Return whether this system lets its users open sensors; others than Linux need no rule."""
    if not sys.platform.startswith("linux"):
        return True
    return all(any((folder / rule).exists() for folder in UDEV_FOLDERS) for rule in UDEV_RULES)


def _examined(info: SensorInfo, found: FoundSensor | None) -> ExaminedSensor:
    if found is None:
        return ExaminedSensor(detected(info))
    release = f"{found.camera.release >> 8:x}.{found.camera.release & 0xFF:02x}"
    return ExaminedSensor(detected(info), release, _motor_firmware(found))


def _motor_firmware(found: FoundSensor) -> bool | None:
    """Return whether the audio function, which moves later motors, has its firmware."""
    if found.model.has_motor_function:
        return True
    if found.companion is None:
        return None
    try:
        return found.companion.interface_count >= 2  # as the driver's motor tells it
    except KinectError:
        return None
    finally:
        found.close()
