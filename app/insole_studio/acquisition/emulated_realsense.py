"""Recorded views and recordings of the library as RealSense cameras that stream."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.recording.session import InfraredPictures, View
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.realsense_sensors import translating
from realsense_d400.camera import Calibration, Intrinsics
from realsense_d400.cameras import RecordedCameras
from realsense_d400.emulation import EmulatedCamera, Make

InfraredPair = tuple[ByteArray, ByteArray]


def emulated_camera(view: View, bus: int) -> EmulatedCamera:
    """Return a camera that plays a view.

    Parameters
    ----------
    view
        Of a stereo camera with metric depth.
    bus
        Number of its USB controller.

    Raises
    ------
    SensorError
        When the library of the cameras is missing.
    """
    with translating():
        name = f"Intel RealSense {view.sensor.model.removeprefix('realsense-').upper()}"
        calibration = calibration_of(view.sensor)
        return EmulatedCamera(
            view.sensor.serial, calibration, *_pictures(view), make=Make(name, bus=bus)
        )


def face(camera: EmulatedCamera, view: View) -> None:
    """Let a camera play another view, as if somebody had moved it."""
    camera.depth, camera.color, camera.infrared = _pictures(view)


def recorded_cameras(paths: Sequence[Path]) -> RecordedCameras:
    """Return the cameras that play recordings.

    Raises
    ------
    SensorError
        When one is damaged or of another kind of camera, or the library is missing.
    """
    with translating():
        return RecordedCameras(paths)


def calibration_of(sensor: Sensor) -> Calibration:
    """Return the factory values of a camera that measures as a sensor does; of it to be emulated.

    Parameters
    ----------
    sensor
        One with metric depth by stereo.
    """
    assert sensor.depth_unit_mm is not None
    return Calibration(
        _intrinsics(sensor.depth_camera),
        _intrinsics(sensor.color_camera),
        sensor.depth2color[:3, :3],
        sensor.depth2color[:3, 3],
        sensor.depth_unit_mm,
        sensor.baseline_mm or 0.0,
    )


def _pictures(view: View) -> tuple[list[RawArray], list[ByteArray], list[InfraredPair]]:
    depth = [view.read_depth(index) for index in range(view.depth_count)]
    color = [view.read_color(index) for index in range(view.color_count)]
    eyes = [view.infrared.get(f"infrared_{side}") for side in ("left", "right")]
    left, right = ([] if eye is None else _in_grey(eye) for eye in eyes)
    return depth, color, list(zip(left, right, strict=False))


def _in_grey(pictures: InfraredPictures) -> list[ByteArray]:
    """Return infrared pictures with eight bits, as the cameras send them."""
    images = [pictures.read(index) for index in range(pictures.count)]
    return [(image >> (pictures.bits - 8)).astype(np.uint8) for image in images]


def _intrinsics(camera: PinholeCamera) -> Intrinsics:
    return Intrinsics(
        camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy,
        camera.distortion, inverse=False,
    )  # fmt: skip
