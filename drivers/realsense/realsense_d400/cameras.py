"""Finding and opening cameras: those of the computer, or recorded and emulated ones."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from realsense_d400.errors import NoCameraError, RealSenseError
from realsense_d400.library import library, no_permission, told
from realsense_d400.usb_places import UsbPlace, plugged_in

LEAST_FIRMWARE = (5, 12, 7, 100)
"""The first one whose presets and times the library's present version takes for granted."""
_SERIES = "D400"
_ROOT_HUB = re.compile(r"usb(\d+)/|^(\d+)-")
UNKNOWN_CONTROLLER = 0


@dataclass(frozen=True)
class CameraInfo:
    """A camera that is plugged in.

    Parameters
    ----------
    serial
        None where it could not be read.
    model
        Such as ``realsense-d415``.
    firmware
        Its version.
    usb
        The version of USB that it is connected by, such as ``3.2``; empty where unknown.
    controller
        Number of its USB controller; 0 where unknown.
    port
        Its place as the operating system writes it.
    problem
        Why it cannot be used, in one sentence; None where it can.
    """

    serial: str | None
    model: str | None = None
    firmware: str = ""
    usb: str = ""
    controller: int = UNKNOWN_CONTROLLER
    port: str = ""
    problem: str | None = None


class CameraBus(Protocol):
    """Where cameras are plugged in: the computer's own bus, recordings, or emulated cameras."""

    def places(self) -> frozenset[UsbPlace]:
        """Return where cameras are plugged in, without disturbing any."""
        ...

    def devices(self) -> Sequence[Any]:
        """Return the devices of the library.

        Raises
        ------
        RealSenseError
        """
        ...


class SystemCameras:
    """The cameras of this computer; its library is imported once one is plugged in."""

    def __init__(self) -> None:
        self._context: Any = None

    def places(self) -> frozenset[UsbPlace]:
        """Return where cameras are plugged in, without disturbing any."""
        return plugged_in()

    def devices(self) -> Sequence[Any]:
        """Return the devices of the library; none where the bus has no camera.

        Raises
        ------
        RealSenseError
        """
        if not self.places():
            return ()
        with told("camera"):
            if self._context is None:
                self._context = library().context()
            return tuple(self._context.query_devices())


class RecordedCameras:
    """Recordings of the library (``.db3``), each of which is a camera that plays it.

    Parameters
    ----------
    paths
        One of each camera.
    real_time
        Whether frames come as they were recorded, rather than as fast as they are taken.

    Raises
    ------
    RealSenseError
        When one is missing, damaged, or of another kind of camera.
    """

    def __init__(self, paths: Sequence[Path], *, real_time: bool = True) -> None:
        self._context = library().context()
        self._devices = tuple(self._load(path, real_time) for path in paths)

    def places(self) -> frozenset[UsbPlace]:
        """Return a place for each recording."""
        return frozenset(UsbPlace(0, index) for index in range(len(self._devices)))

    def devices(self) -> Sequence[Any]:
        """Return the devices that play."""
        return self._devices

    def _load(self, path: Path, real_time: bool) -> Any:
        if not path.is_file():
            raise RealSenseError(f"{path} does not exist; choose a recording (.db3).")
        try:
            device = self._context.load_device(str(path))
            device.as_playback().set_real_time(real_time)
        except RuntimeError as error:
            raise RealSenseError(
                f"{path} is no complete recording of a RealSense ({_first_line(error)}); it may "
                "have been cut off while it was copied or recorded. Copy or record it again."
            ) from error
        return device


def _first_line(error: RuntimeError) -> str:
    return str(error).splitlines()[0][:120]


def list_cameras(bus: CameraBus) -> tuple[CameraInfo, ...]:
    """List the cameras that are plugged in.

    Parameters
    ----------
    bus
        Where they are.

    Returns
    -------
    tuple of CameraInfo
        Those that the library does not list among them, with the reason.

    Raises
    ------
    RealSenseError
        When the library is missing, but a camera is there.
    """
    devices = bus.devices()
    known = tuple(camera_info(device) for device in devices)
    hidden = len(bus.places()) - len(devices)
    if hidden <= 0:
        return known
    return (*known, *[CameraInfo(None, problem=no_permission("camera"))] * hidden)


def find_device(bus: CameraBus, serial: str) -> tuple[Any, CameraInfo]:
    """Return the device with a serial number, and what it tells about itself.

    Raises
    ------
    NoCameraError
        When it is not plugged in.
    RealSenseError
        When it cannot be used; says why.
    """
    for device in bus.devices():
        info = camera_info(device)
        if info.serial == serial:
            if info.problem is not None:
                raise RealSenseError(info.problem)
            return device, info
    raise NoCameraError(f"No RealSense has the number {serial}; plug it in.")


def camera_info(device: Any) -> CameraInfo:
    """Return what a device of the library tells about itself."""
    keys = library().camera_info
    with told("camera"):
        serial = _text(device, keys.serial_number) or None
        name = _text(device, keys.name)
        firmware, usb = (
            _text(device, keys.firmware_version),
            _text(device, keys.usb_type_descriptor),
        )
        port = _text(device, keys.physical_port)
        line = _text(device, keys.product_line)
    model = "-".join(name.lower().removeprefix("intel ").split()[:2]) or None
    problem = _problem(serial, name, line, firmware, usb)
    return CameraInfo(serial, model, firmware, usb, _controller(port), port, problem)


def _text(device: Any, key: Any) -> str:
    return str(device.get_info(key)) if device.supports(key) else ""


def _controller(port: str) -> int:
    """Return the number of the root hub in a port such as ``…/usb2/2-1/…`` or ``2-1-5``."""
    found = _ROOT_HUB.search(port)
    return int(found[1] or found[2]) if found else UNKNOWN_CONTROLLER


def _problem(serial: str | None, name: str, line: str, firmware: str, usb: str) -> str | None:
    if line and line != _SERIES:
        return (
            f"{name} {serial} is of another series than the cameras that this program knows; use "
            "one of the D400 series."
        )
    if _version(firmware) < LEAST_FIRMWARE:
        least = ".".join(map(str, LEAST_FIRMWARE))
        return (
            f"RealSense {serial} has the firmware {firmware or 'of an unknown version'}, which is "
            f"too old; update it to {least} or newer with the RealSense Viewer."
        )
    if usb.startswith(("1", "2")):
        return (
            f"RealSense {serial} is connected by USB {usb}, which is too slow for its full "
            "pictures; use a USB 3 port, and the cable that came with it."
        )
    return None


def _version(text: str) -> tuple[int, ...]:
    return tuple(int(part) for part in re.findall(r"\d+", text))
