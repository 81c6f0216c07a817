"""Plausibility of a calibrated sensor as a Kinect v1.

Sensors of this kind differ by a few per cent. A larger difference indicates a wrong input, above
all of the side of the board's square: it scales every distance, and no residual shows it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rotation_angle_deg
from insole_core.messages import Message, joined
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.nominal_kinect import COLOR_CAMERA, DEPTH2COLOR, DEPTH_CAMERA
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

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
_SLOPE_NAME, _BASELINE_NAME = "b of the depth", "the distance between the cameras"
_BASELINE_MM = (20.0, 28.0)
"""Real devices: 23.1 to 26.7 mm; nominal 25 mm."""
_MOST_TURN_DEG = 2.0
"""A real device: 0.6°."""


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
    found = [*_depth_numbers(depth), *_camera_numbers(sensor)]
    wrong = [number for number in found if not number.fits]
    if not wrong:
        return ""
    findings = joined(number.finding for number in wrong)
    reason = _reason(sensor, square_mm, depth, wrong)
    return Message(
        "The result does not fit a Kinect v1: {findings}; {reason}.",
        findings=findings,
        reason=reason,
    )


def _depth_numbers(depth: LinearInverseDisparity | None) -> Iterator[_Number]:
    if depth is not None:
        yield _Number("a of the depth", depth.a, _about(USUAL_DEPTH.a), 3)
        yield _Number(_SLOPE_NAME, depth.b, _about(USUAL_DEPTH.b), 5)


def _camera_numbers(sensor: Sensor) -> Iterator[_Number]:
    for name, camera, nominal in (
        ("the focal length of the depth camera", sensor.depth_camera, DEPTH_CAMERA),
        ("the focal length of the colour camera", sensor.color_camera, COLOR_CAMERA),
    ):
        usual_px = nominal.fx * camera.width / nominal.width
        yield _Number(name, _unlike(camera, usual_px), _about(usual_px), 1, " px")
    baseline_mm = _length(sensor.depth2color)
    yield _Number(_BASELINE_NAME, baseline_mm, _BASELINE_MM, 1, " mm")
    turn_deg = rotation_angle_deg(sensor.depth2color[:3, :3])
    yield _Number("the angle between the cameras", turn_deg, (0.0, _MOST_TURN_DEG), 1, "°")


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


def _about(usual: float) -> tuple[float, float]:
    low, high = sorted((usual * (1 - _TOLERANCE), usual * (1 + _TOLERANCE)))
    return low, high


def _unlike(camera: PinholeCamera, usual_px: float) -> float:
    """Return the focal length that differs more from the usual one."""
    return max(camera.fx, camera.fy, key=lambda focal_px: abs(focal_px - usual_px))


def _length(a2b: FloatArray) -> float:
    return float(np.linalg.norm(a2b[:3, 3]))
