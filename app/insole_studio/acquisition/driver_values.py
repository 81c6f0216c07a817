"""What the driver says in the core's words: errors, and the calibration stored in the device."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

from insole_core.sensing.disparity import FactoryDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor, nominal_kinect
from insole_studio.acquisition.sensor_port import BusFullError, NoSensorFoundError, SensorError
from kinect_v1.calibration import Calibration
from kinect_v1.errors import BandwidthError, KinectError, NoSensorError

_MM_PER_CM = 10.0
log = logging.getLogger(__name__)
log.addHandler(logging.NullHandler())  # a command tells the error itself, a window has a log


def factory_sensor(
    calibration: Calibration,
    serial: str,
    faces: tuple[str, ...],
    color_size: tuple[int, int] = (1280, 1024),
) -> Sensor:
    """Return the sensor as the factory calibrated it, with nominal values for what it did not.

    The depth camera is the device's own pinhole: f = D / (2 p), principal point at the centre of
    the image. Of the colour camera alone, apart from the depth camera, the device stores nothing.

    Parameters
    ----------
    faces
        Marker groups that the sensor sees.
    color_size
        Width and height of the colour pictures, px.
    """
    plane = calibration.zero_plane
    focal_px = calibration.focal_length_px
    return replace(
        usual_sensor(serial, faces, color_size),
        depth_camera=PinholeCamera(640, 480, focal_px, focal_px, 320.0, 240.0),
        disparity=FactoryDisparity(
            reference_distance_mm=plane.reference_distance_cm * _MM_PER_CM,
            reference_pixel_size_mm=plane.reference_pixel_cm * _MM_PER_CM,
            baseline_mm=plane.emitter_distance_cm * _MM_PER_CM,
            constant_shift=float(calibration.constant_shift),
        ),
    )


def usual_sensor(serial: str, faces: tuple[str, ...], color_size: tuple[int, int]) -> Sensor:
    """Return a sensor with nominal values, nothing measured.

    Parameters
    ----------
    faces
        Marker groups that the sensor sees.
    color_size
        Width and height of the colour pictures, px.
    """
    sensor = nominal_kinect(serial)
    return replace(
        sensor, faces=faces, color_camera=resized_camera(sensor.color_camera, color_size)
    )


def resized_camera(camera: PinholeCamera, size: tuple[int, int]) -> PinholeCamera:
    """Return the camera for pictures scaled to `size` and cropped at top and bottom.

    Parameters
    ----------
    size
        Width and height of the smaller pictures, px.
    """
    width, height = size
    scale = width / camera.width
    cut = (camera.height * scale - height) / 2
    return replace(
        camera,
        width=width,
        height=height,
        fx=camera.fx * scale,
        fy=camera.fy * scale,
        cx=(camera.cx + 0.5) * scale - 0.5,
        cy=(camera.cy + 0.5) * scale - 0.5 - cut,
    )


_KINDS: tuple[tuple[type[KinectError], type[SensorError]], ...] = (
    (BandwidthError, BusFullError),
    (NoSensorError, NoSensorFoundError),
)


@contextmanager
def translating() -> Iterator[None]:
    """Convert the driver's errors, whose messages are sentences already, to the application's."""
    try:
        yield
    except KinectError as error:
        log.warning("%s", error)
        kind = next((ours for theirs, ours in _KINDS if isinstance(error, theirs)), SensorError)
        raise kind(str(error)) from error
