"""A recorded session as live sensors: its frames go through packets and the whole driver."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import ByteArray
from insole_core.recording.session import Session, View
from insole_core.sensing.disparity import DisparityModel, FactoryDisparity, LinearInverseDisparity
from insole_core.sensing.sensor import Sensor
from kinect_v1.calibration import Calibration, ZeroPlane
from kinect_v1.emulation.bus import EmulatedBus
from kinect_v1.emulation.device import EmulatedKinect
from kinect_v1.emulation.playback import TYPICAL_CALIBRATION, make_footage
from kinect_v1.models import Model
from kinect_v1.pixels import mosaic

_CUT_ROWS = 32
"""A picture of 1280 × 960 is one of 1280 × 1024 without so many rows at top and bottom."""


def emulated_bus(session: Session, speed: float = 1.0) -> EmulatedBus:
    """Plug in a sensor for each serial number of a session, each with a controller of its own.

    A sensor that gave several views plays the first of them.

    Parameters
    ----------
    session
    speed
        Of the sensors' time; 1 = real.
    """
    first = {view.sensor.serial: view for view in reversed(session.views)}
    serials = dict.fromkeys(view.sensor.serial for view in session.views)
    return EmulatedBus([_kinect(first[serial]) for serial in serials], speed=speed)


def emulated_views(session: Session) -> tuple[tuple[str, str], ...]:
    """Give view and serial number of the views that the emulated sensors play."""
    serials: dict[str, str] = {}
    for view in session.views:
        serials.setdefault(view.sensor.serial, view.name)
    return tuple((view, serial) for serial, view in serials.items())


def _kinect(view: View) -> EmulatedKinect:
    depth = [view.read_depth(index) for index in range(view.depth_count)]
    mosaics = [mosaic(_whole(view.read_color(index))) for index in range(view.color_count)]
    footage = make_footage(depth, mosaics)
    return EmulatedKinect(
        Model.XBOX_1414, view.sensor.serial, factory_calibration(view.sensor), footage
    )


def _whole(color: ByteArray) -> ByteArray:
    if color.shape[:2] != (960, 1280):
        return color
    return np.pad(color, ((_CUT_ROWS, _CUT_ROWS), (0, 0), (0, 0)))


def factory_calibration(sensor: Sensor) -> Calibration:
    """Give the factory values of a device that measures as a sensor does.

    With the constant shift held (the device stores a whole number), focal length, slope and
    offset of 1 / Z over the raw number determine the other three: D, p = D / (2 f), and the
    baseline b.
    """
    slope_offset = _inverse_depth(sensor.disparity)
    if slope_offset is None:
        return TYPICAL_CALIBRATION
    slope, offset = slope_offset
    shift = TYPICAL_CALIBRATION.constant_shift
    distance_mm = 1 / (offset + (4 * shift + 1.5) * slope)
    plane = ZeroPlane(
        emitter_distance_cm=1 / (-80 * sensor.depth_camera.fx * slope),
        rgb_distance_cm=TYPICAL_CALIBRATION.zero_plane.rgb_distance_cm,
        reference_distance_cm=distance_mm / 10,
        reference_pixel_cm=distance_mm / (20 * sensor.depth_camera.fx),
    )
    typical = TYPICAL_CALIBRATION
    return Calibration(plane, typical.registration, typical.padding, shift)


def _inverse_depth(model: DisparityModel) -> tuple[float, float] | None:
    """Give slope and offset of 1 / Z over the raw number; None where it is no straight line."""
    if not isinstance(model, FactoryDisparity | LinearInverseDisparity):
        return None
    low, high = 400.0, 900.0
    at_low, at_high = (1 / float(model.depth_mm(np.array(raw))) for raw in (low, high))
    slope = (at_high - at_low) / (high - low)
    return slope, at_low - low * slope
