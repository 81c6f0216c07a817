"""Cameras without hardware: devices of the library that are given their frames.

They stream, record and are listed as real ones; plugging and unplugging, which the library cannot
do, is what `EmulatedCameras` adds.
"""

from __future__ import annotations

import atexit
import threading
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from realsense_d400.camera import COLOR_FPS, DEPTH_FPS, Calibration, Intrinsics
from realsense_d400.library import library
from realsense_d400.usb_places import UsbPlace

_MM_PER_M = 1000.0
EXPOSURE_US, GAIN = 8500, 16
"""What an emulated camera chooses by itself."""
_PATIENCE_S = 60.0


@dataclass(frozen=True)
class Make:
    """What a camera says of itself.

    Parameters
    ----------
    name, line
        Of its model and series.
    firmware, usb
        Versions.
    bus
        Number of its USB controller.
    """

    name: str = "Intel RealSense D415"
    line: str = "D400"
    firmware: str = "5.16.0.1"
    usb: str = "3.2"
    bus: int = 2


@dataclass(eq=False)
class EmulatedCamera:
    """A camera that plays known pictures over and over.

    Parameters
    ----------
    serial
    calibration
        Of the pictures.
    depth : list of (height, width) uint16
    color : list of (height, width, 3) uint8, RGB
    infrared : list of pairs of (height, width) uint8
        Left and right; none for a camera that sends no infrared.
    make
    color_late_s
        By how much colour is taken later than depth.
    """

    serial: str
    calibration: Calibration
    depth: Sequence[NDArray[np.uint16]]
    color: Sequence[NDArray[np.uint8]]
    infrared: Sequence[tuple[NDArray[np.uint8], NDArray[np.uint8]]] = ()
    make: Make = field(default_factory=Make)
    color_late_s: float = 0.0

    def __post_init__(self) -> None:
        self.device = self._make_device()

    def send_depth(self, number: int, time_s: float) -> None:
        """Send a depth picture, and the infrared ones of the same instant."""
        self._send(self._stereo, self._profiles["depth"], self.depth, number, time_s)
        for eye, name in enumerate(("left", "right")):
            if name in self._profiles:
                eyes = [pair[eye] for pair in self.infrared]
                self._send(self._stereo, self._profiles[name], eyes, number, time_s)

    def send_color(self, number: int, time_s: float) -> None:
        """Send a colour picture."""
        late_s = time_s - self.color_late_s
        self._send(self._colors, self._profiles["color"], self.color, number, late_s)

    @property
    def streams(self) -> tuple[bool, bool]:
        """Whether depth and colour are streaming."""
        return bool(self._stereo.get_active_streams()), bool(self._colors.get_active_streams())

    def _make_device(self) -> Any:
        rs, make = library(), self.make
        device, keys = rs.software_device(), rs.camera_info
        for key, text in (
            (keys.name, make.name), (keys.serial_number, self.serial),
            (keys.product_line, make.line), (keys.firmware_version, make.firmware),
            (keys.usb_type_descriptor, make.usb), (keys.physical_port, f"{make.bus}-1-1"),
        ):  # fmt: skip
            device.register_info(key, text)
        self._stereo = device.add_sensor("Stereo Module")
        self._colors = device.add_sensor("RGB Camera")
        self._profiles = self._add_streams(rs)
        calibration, option = self.calibration, rs.option
        self._stereo.add_read_only_option(option.depth_units, calibration.depth_unit_mm / _MM_PER_M)
        self._stereo.add_read_only_option(option.stereo_baseline, calibration.baseline_mm)
        for sensor in (self._stereo, self._colors):
            sensor.add_option(option.enable_auto_exposure, _range(rs, 0, 1, 1), True)
        limits = {
            option.emitter_enabled: (2, 1),
            option.laser_power: (360, 150),
            option.visual_preset: (5, 0),
            option.exposure: (165_000, 33_000),
            option.gain: (248, 20),
        }
        for key, (most, default) in limits.items():
            self._stereo.add_option(key, _range(rs, 0, most, default), True)
        self._stereo.add_read_only_option(option.projector_temperature, 36.5)
        return device

    def _add_streams(self, rs: Any) -> dict[str, Any]:
        depth, color = self.calibration.depth, self.calibration.color
        kinds: list[tuple[str, Any, Any, int, Any, Intrinsics, int]] = [
            ("depth", self._stereo, rs.stream.depth, 0, rs.format.z16, depth, DEPTH_FPS),
            ("color", self._colors, rs.stream.color, 0, rs.format.rgb8, color, COLOR_FPS),
        ]
        if self.infrared:
            eye = (self._stereo, rs.stream.infrared)
            kinds += [
                (name, *eye, index, rs.format.y8, depth, DEPTH_FPS)
                for index, name in enumerate(("left", "right"), start=1)
            ]
        profiles = {}
        for uid, (name, sensor, stream, index, form, camera, fps) in enumerate(kinds):
            video = rs.video_stream()
            video.type, video.index, video.uid, video.fmt, video.fps = stream, index, uid, form, fps
            video.width, video.height = camera.width, camera.height
            video.bpp = _BYTES_PER_PX[name]
            video.intrinsics = _library_intrinsics(camera, rs)
            profiles[name] = sensor.add_video_stream(video).as_video_stream_profile()
        placed = rs.extrinsics()
        placed.rotation = self.calibration.rotation.flatten(order="F").tolist()
        placed.translation = (self.calibration.translation_mm / _MM_PER_M).tolist()
        profiles["depth"].register_extrinsics_to(profiles["color"], placed)
        return profiles

    def _send(
        self, sensor: Any, profile: Any, images: Sequence[NDArray[Any]], number: int, time_s: float
    ) -> None:
        rs = library()
        image = images[number % len(images)]
        frame = rs.software_video_frame()
        frame.pixels = np.ascontiguousarray(image)
        frame.bpp = image.itemsize * (image.shape[2] if image.ndim == 3 else 1)
        frame.stride = frame.bpp * image.shape[1]
        frame.timestamp, frame.domain = time_s * _MM_PER_M, rs.timestamp_domain.hardware_clock
        frame.frame_number, frame.profile = number, profile
        if image.dtype == np.uint16:
            frame.depth_units = self.calibration.depth_unit_mm / _MM_PER_M
        if sensor is self._stereo:
            told = rs.frame_metadata_value
            sensor.set_metadata(told.actual_exposure, EXPOSURE_US)
            sensor.set_metadata(told.gain_level, GAIN)
        sensor.on_video_frame(frame)


_BYTES_PER_PX = {"depth": 2, "color": 3, "left": 1, "right": 1}


class EmulatedCameras:
    """The bus of emulated cameras, which can be plugged in and out.

    Parameters
    ----------
    cameras
    speed
        Factor on their clock; 1 = real time.
    """

    def __init__(self, cameras: Iterable[EmulatedCamera], speed: float = 1.0) -> None:
        self._cameras = {camera.serial: camera for camera in cameras}
        self._plugged = {serial: index for index, serial in enumerate(self._cameras)}
        self._period_s = 1 / (DEPTH_FPS * speed)
        self._ended = threading.Event()
        self._plays = threading.Thread(target=self._play, name="emulated-realsense", daemon=True)
        self._plays.start()
        atexit.register(self.close)  # before the interpreter goes, which the library would call

    def places(self) -> frozenset[UsbPlace]:
        """Return where cameras are plugged in."""
        return frozenset(UsbPlace(0, address) for address in self._plugged.values())

    def devices(self) -> Sequence[Any]:
        """Return the devices that are plugged in."""
        return tuple(self._cameras[serial].device for serial in tuple(self._plugged))

    def unplug(self, serial: str) -> None:
        """Pull a camera's cable out."""
        del self._plugged[serial]

    def plug(self, serial: str) -> None:
        """Plug a camera in again, which gives it another address."""
        self._plugged[serial] = max(self._plugged.values(), default=0) + len(self._cameras)

    def close(self) -> None:
        """Send nothing any more."""
        self._ended.set()
        self._plays.join(_PATIENCE_S)

    def _play(self) -> None:
        number, next_s = 0, time.monotonic()
        while not self._ended.wait(max(next_s - time.monotonic(), 0)):
            now_s = time.monotonic()
            for serial in tuple(self._plugged):
                camera = self._cameras[serial]
                depth, color = camera.streams
                if color and number % (DEPTH_FPS // COLOR_FPS) == 0:
                    camera.send_color(number // (DEPTH_FPS // COLOR_FPS), now_s)
                if depth:
                    camera.send_depth(number, now_s)
            number += 1
            next_s = max(next_s + self._period_s, time.monotonic() - self._period_s)


def record(camera: EmulatedCamera, path: Path, frames: int) -> None:
    """Write what a camera sends into a recording of the library (``.db3``).

    Parameters
    ----------
    camera
    path
    frames
        Number of depth pictures; there are half as many of colour.
    """
    rs = library()
    recorder = rs.recorder(str(path), camera.device)
    queue = rs.frame_queue(4 * frames, True)
    sensors = recorder.query_sensors()
    for sensor in sensors:
        sensor.open(sensor.get_stream_profiles())
        sensor.start(queue)
    for number in range(frames):
        time.sleep(1 / DEPTH_FPS)  # it is played as it was written
        time_s = number / DEPTH_FPS
        camera.send_depth(number, time_s)
        if number % (DEPTH_FPS // COLOR_FPS) == 0:
            camera.send_color(number // (DEPTH_FPS // COLOR_FPS), time_s)
    for sensor in sensors:
        sensor.stop()
        sensor.close()


def _range(rs: Any, least: float, most: float, default: float) -> Any:
    limits = rs.option_range()
    limits.min, limits.max, limits.step, limits.default = least, most, 1.0, default
    return limits


def _library_intrinsics(camera: Intrinsics, rs: Any) -> Any:
    values = rs.intrinsics()
    values.width, values.height = camera.width, camera.height
    values.fx, values.fy, values.ppx, values.ppy = camera.fx, camera.fy, camera.cx, camera.cy
    kinds = rs.distortion
    values.model = kinds.inverse_brown_conrady if camera.inverse else kinds.brown_conrady
    values.coeffs = list(camera.distortion)
    return values
