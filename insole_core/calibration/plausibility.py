"""Plausibility of a calibrated sensor as a Kinect v1.

Sensors of this kind differ by a few per cent. A larger difference indicates a wrong input, above
all of the side of the board's square or of the distances of walls: they scale every depth, and no
residual shows it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from insole_core.calibration.walls.disparity_fit import linear_inverse_near
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rotation_angle_deg
from insole_core.messages import Message, joined
from insole_core.sensing.disparity import (
    DisparityModel,
    FactoryDisparity,
    LinearInverseDisparity,
)
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import BURRUS, COLOR_CAMERA, DEPTH2COLOR, DEPTH_CAMERA, Sensor

Kind = Literal["depth", "color"]

_FOCAL_PX, _PROJECTOR_MM, _INFINITY_RAW = 580.0, 75.0, 1090.0
_SLOPE = 1000 / (8 * _FOCAL_PX * _PROJECTOR_MM)
USUAL_DEPTH = LinearInverseDisparity(a=_INFINITY_RAW * _SLOPE, b=-_SLOPE)
"""Z = 8 f b / (1090 - raw) with f = 580 px and b = 75 mm (Konolige and Mihelich, technical
description of kinect_calibration, ROS): a = 3.132 and b = -0.002874 per metre. The toolbox of
Herrera et al. (2012) starts from 3.112 and -0.002853; the numbers stored in the devices correspond
to 3.153 and -0.002894; a real device has 3.155 and -0.002878 (docs/calibration.md). Burrus's
numbers, thesis (17), differ from all of these by 7 %."""
_TOLERANCE = 0.03
"""Tolerance of the depth and of the focal lengths, as a share."""
_FOCAL_NAMES: dict[Kind, str] = {
    "depth": "the focal length of the depth camera",
    "color": "the focal length of the colour camera",
}
_CENTRE_NAMES: dict[Kind, tuple[str, str]] = {
    "depth": ("cx of the depth camera", "cy of the depth camera"),
    "color": ("cx of the colour camera", "cy of the colour camera"),
}
_TOLERANCE_OF_WALLS = 0.08
"""Of the depth where distances were measured by hand: they are a truth of their own, and Burrus's
numbers, which many programs use, are 7 % off."""
_SLOPE_NAME, _BASELINE_NAME = "b of the depth", "the distance between the cameras"
_BASELINE_MM = (20.0, 28.0)
"""Real devices: 23.1 to 26.7 mm; nominal 25 mm."""
_MOST_TURN_DEG = 2.0
"""A real device: 0.6°."""
_MOST_OFF_SHARE = 0.1
"""How far a principal point lies from the middle at most, as a share of the width; real devices: up
to 0.02."""
_MOST_LEFT_SHARE = 0.02
"""What a shift leaves over all distances at most, as a share of the width: 25 mm between the
cameras, seen at 600 instead of 1000 mm."""
_MOST_ERROR = (0.0, 3.0)
"""Error of a measured distance in per cent; a tape is better than 1 %."""
_STEPS_OF_SCALE = ("disparity", "stereo")
_COMPARED_AT_MM = np.array([600.0, 800.0, 1000.0])
_MOST_BETWEEN_SCALES = 0.01
"""As a share of the depth; a tape is better than 1 %."""
_FARTHEST_RAW = 1080.0
"""A raw number at about 35 m: beyond any wall."""


@dataclass(frozen=True)
class _Number:
    """A number of a sensor, and its limits over all devices."""

    name: str
    value: float
    usual: tuple[float, float]
    digits: int
    unit: str = ""

    @property
    def fits(self) -> bool:
        return self.usual[0] <= self.value <= self.usual[1]

    @property
    def finding(self) -> Message:
        """The value and its usual range, as a sentence."""
        value = f"{self.value:.{self.digits}f}{self.unit}"
        low, high = (f"{limit:.{self.digits}f}" for limit in self.usual)
        return Message(
            "{name} is {value} (usual: {low} to {high})",
            name=self.name,
            value=value,
            low=low,
            high=high,
        )


@dataclass(frozen=True)
class Distances:
    """Distances of walls as they were measured by hand.

    Parameters
    ----------
    names
        Of the captures.
    raw, depth_mm : (n,) float64, raw units and mm
        The raw number of each at the image centre, and its measured distance.
    """

    names: Sequence[str]
    raw: FloatArray
    depth_mm: FloatArray


def find_camera_misfit(camera: PinholeCamera, kind: Kind) -> str:
    """Report which numbers of one camera no Kinect v1 has, and the likely reason.

    Parameters
    ----------
    kind
        ``depth`` or ``color``.

    Returns
    -------
    str
        A sentence; empty if everything is plausible.
    """
    reason = Message(
        "the pictures may be those of another camera, cut or scaled, or the board was hardly "
        "turned, so take them again"
    )
    return _misfit([_focal_number(camera, kind), *_centre_numbers(camera, kind)], lambda _: reason)


def find_shift_misfit(color: PinholeCamera, left_px: float) -> str:
    """Report whether a colour camera that was shifted onto the depth is none of a Kinect v1.

    Parameters
    ----------
    color
        After the shift.
    left_px
        The largest offset that the shift has left.

    Returns
    -------
    str
        A sentence; empty if everything is plausible.
    """
    most_px = _MOST_LEFT_SHARE * color.width
    left = _Number("the largest offset that is left", left_px, (0.0, most_px), 1, " px")
    reason = Message(
        "the points may be assigned to the wrong places, or the cameras were not calibrated yet, "
        "so mark the points again"
    )
    return _misfit([left, *_centre_numbers(color, "color")], lambda _: reason)


def find_depth_misfit(model: DisparityModel, measured: Distances) -> str:
    """Report which numbers of a depth scale no Kinect v1 has, and the likely reason.

    Parameters
    ----------
    model
        As it was fitted to the distances.

    Returns
    -------
    str
        A sentence; empty if everything is plausible.
    """
    found_mm = model.depth_mm(measured.raw)
    error = np.nan_to_num(np.abs(found_mm / measured.depth_mm - 1), nan=1.0)
    worst = _Number("the largest error of a distance", 100 * error.max(), _MOST_ERROR, 1, " %")
    if worst.fits:
        near = linear_inverse_near(model, measured.raw)
        numbers = [*_depth_numbers(near, _TOLERANCE_OF_WALLS)]
    else:
        numbers = [worst]
    return _misfit(numbers, lambda _: _distance_reason(measured))


def unusual_distances(measured: Distances) -> tuple[str, ...]:
    """Return advice, in a sentence, where all walls are nearer or farther than usual sensors say.

    Not so far that `find_depth_misfit` reports it; empty otherwise.
    """
    off = float(np.median(measured.depth_mm / _usual_mm(measured))) - 1
    if abs(off) <= _TOLERANCE:
        return ()
    return (
        Message(
            "The distances differ by {share:+.0%} from what a usual Kinect v1 measures; make sure "
            "that they reach from the front of the sensor to the wall.",
            share=off,
        ),
    )


def find_other_scale(sensor: Sensor, after: DisparityModel) -> tuple[str, ...]:
    """Return a warning where a new depth scale contradicts one that was calibrated before.

    Both come from lengths that somebody gave: the side of a square, or distances of walls. Their
    residuals show nothing of a wrong one.

    Parameters
    ----------
    sensor
        As it was before the step.
    after
        The new scale.
    """
    before = sensor.disparity
    done = any(record.step in _STEPS_OF_SCALE for record in sensor.calibration)
    if not done or before == BURRUS or isinstance(before, FactoryDisparity):
        return ()
    raw = USUAL_DEPTH.raw(_COMPARED_AT_MM)
    shares = after.depth_mm(raw) / before.depth_mm(raw) - 1
    worst = int(np.argmax(np.abs(shares)))
    if abs(shares[worst]) < _MOST_BETWEEN_SCALES:
        return ()
    return (
        Message(
            "Depths at {distance_mm:.0f} mm differ by {share:+.1%} from the scale that was "
            "calibrated before, and one of the two is wrong; measure the side of the board's "
            "square, and the distances of the walls from the front of the sensor.",
            distance_mm=float(_COMPARED_AT_MM[worst]),
            share=float(shares[worst]),
        ),
    )


def _usual_mm(measured: Distances) -> FloatArray:
    return USUAL_DEPTH.depth_mm(np.minimum(measured.raw, _FARTHEST_RAW))


def _distance_reason(measured: Distances) -> str:
    """Name the capture whose distance differs most from what a usual sensor measures."""
    usual_mm = _usual_mm(measured)
    worst = int(np.argmax(np.abs(np.log(usual_mm / measured.depth_mm))))
    values = {
        "capture": measured.names[worst],
        "given_mm": measured.depth_mm[worst],
        "usual_mm": usual_mm[worst],
    }
    if (np.argsort(measured.raw) != np.argsort(measured.depth_mm)).any():
        return Message(
            "the distances are in another order than the captures ({capture} is about "
            "{usual_mm:.0f} mm away, but {given_mm:.0f} mm was given), so give one for each, in "
            "the order of their names",
            **values,
        )
    return Message(
        "{capture} is about {usual_mm:.0f} mm away, but {given_mm:.0f} mm was given, so measure "
        "again from the front of the sensor to the wall, with walls from 500 to 1000 mm",
        **values,
    )


def find_misfit(sensor: Sensor, square_mm: float, depth: LinearInverseDisparity | None) -> str:
    """Report which numbers of a sensor no Kinect v1 has, and the likely reason.

    Parameters
    ----------
    sensor
        As it was calibrated with a board.
    square_mm
        Side of the board's squares as it was given.
    depth
        As measured with the board; None where only its pictures were used.

    Returns
    -------
    str
        A sentence; empty if everything is plausible.
    """
    return _misfit(
        [*_depth_numbers(depth), *_camera_numbers(sensor)],
        lambda wrong: _reason(sensor, square_mm, depth, wrong),
    )


def _misfit(numbers: Sequence[_Number], reason: Callable[[list[_Number]], str]) -> str:
    wrong = [number for number in numbers if not number.fits]
    if not wrong:
        return ""
    return Message(
        "The result does not fit a Kinect v1: {findings}; {reason}.",
        findings=joined(number.finding for number in wrong),
        reason=reason(wrong),
    )


def _depth_numbers(
    depth: LinearInverseDisparity | None, tolerance: float = _TOLERANCE
) -> Iterator[_Number]:
    if depth is not None:
        yield _Number("a of the depth", depth.a, _about(USUAL_DEPTH.a, tolerance), 3)
        yield _Number(_SLOPE_NAME, depth.b, _about(USUAL_DEPTH.b, tolerance), 5)


def _camera_numbers(sensor: Sensor) -> Iterator[_Number]:
    yield _focal_number(sensor.depth_camera, "depth")
    yield _focal_number(sensor.color_camera, "color")
    baseline_mm = _length(sensor.depth2color)
    yield _Number(_BASELINE_NAME, baseline_mm, _BASELINE_MM, 1, " mm")
    turn_deg = rotation_angle_deg(sensor.depth2color[:3, :3])
    yield _Number("the angle between the cameras", turn_deg, (0.0, _MOST_TURN_DEG), 1, "°")


def _focal_number(camera: PinholeCamera, kind: Kind) -> _Number:
    nominal = DEPTH_CAMERA if kind == "depth" else COLOR_CAMERA
    usual_px = nominal.fx * camera.width / nominal.width
    name = _FOCAL_NAMES[kind]
    return _Number(name, _unlike(camera, usual_px), _about(usual_px), 1, " px")


def _centre_numbers(camera: PinholeCamera, kind: Kind) -> Iterator[_Number]:
    most_px = _MOST_OFF_SHARE * camera.width
    for name, value, length in (
        (_CENTRE_NAMES[kind][0], camera.cx, camera.width),
        (_CENTRE_NAMES[kind][1], camera.cy, camera.height),
    ):
        middle = (length - 1) / 2
        yield _Number(name, value, (middle - most_px, middle + most_px), 1, " px")


def _reason(
    sensor: Sensor, square_mm: float, depth: LinearInverseDisparity | None, wrong: list[_Number]
) -> str:
    likely_mm = _likely_square(square_mm, depth, {number.name: number for number in wrong})
    if likely_mm:
        return Message(
            "the square of the board is more likely {likely_mm} mm than {square_mm:g} mm, "
            "so measure it and give its true side",
            likely_mm=likely_mm,
            square_mm=square_mm,
        )
    if depth is not None and sensor.correction is None:
        return Message("the distortion of the depth was not corrected yet, so calibrate it first")
    return Message(
        "pictures of different positions may have been put together, or the board was hardly "
        "turned, so take them again"
    )


def _likely_square(
    square_mm: float, depth: LinearInverseDisparity | None, wrong: Mapping[str, _Number]
) -> str:
    """Return the side that would make all numbers fit; empty if no other side explains them.

    The depth determines it well; the distance of the cameras, which varies more, to whole mm.
    """
    if depth is not None and _SLOPE_NAME in wrong:
        scale = depth.b / USUAL_DEPTH.b
        low, high = _about(USUAL_DEPTH.a)
        return f"{square_mm * scale:.1f}" if low <= depth.a / scale <= high else ""
    if depth is None and set(wrong) == {_BASELINE_NAME}:
        return f"{square_mm * _length(DEPTH2COLOR) / wrong[_BASELINE_NAME].value:.0f}"
    return ""


def _about(usual: float, tolerance: float = _TOLERANCE) -> tuple[float, float]:
    low, high = sorted((usual * (1 - tolerance), usual * (1 + tolerance)))
    return low, high


def _unlike(camera: PinholeCamera, usual_px: float) -> float:
    """Return the focal length that differs more from the usual one."""
    return max(camera.fx, camera.fy, key=lambda focal_px: abs(focal_px - usual_px))


def _length(a2b: FloatArray) -> float:
    return float(np.linalg.norm(a2b[:3, 3]))
