"""A calibrated depth sensor, how well it was calibrated, and a Kinect v1 before any calibration."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal, get_args

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rigid, transform
from insole_core.sensing.correction import OF_A_KINECT, CorrectedImage, DisparityCorrection
from insole_core.sensing.disparity import DisparityModel, LinearInverseDisparity
from insole_core.sensing.family import ACTIVE_STEREO, DIRECT_DEPTH, KINECT_V1, SensorFamily
from insole_core.sensing.pinhole_camera import PinholeCamera

Unit = Literal["px", "raw", "mm"]
UNITS: tuple[Unit, ...] = get_args(Unit)
BURRUS = LinearInverseDisparity(3.3309495, -0.0030711016)
"""Thesis (17), with the values that Burrus published."""
DEPTH_CAMERA = PinholeCamera(640, 480, 585.0, 585.0, 319.5, 239.5)
COLOR_CAMERA = PinholeCamera(1280, 1024, 1050.0, 1050.0, 639.5, 511.5)
DEPTH2COLOR = rigid(np.eye(3), np.array([-25.0, 0.0, 0.0]))


@dataclass(frozen=True)
class CalibrationRecord:
    """One step of a calibration, as it was done last.

    Parameters
    ----------
    step
        Key of its section in the report, such as ``camera`` or ``distortion``.
    made_at
        ISO 8601, UTC.
    residual
        What the step left unexplained (rms; of a shift the largest), in `unit`.
    """

    step: str
    made_at: str
    residual: float
    unit: Unit


@dataclass(frozen=True, eq=False)
class Sensor:
    """A depth camera, the colour camera beside it, and their calibration.

    Parameters
    ----------
    model, serial
        As the device reports them.
    depth2color : (4, 4) float64, mm
        Depth camera frame to colour camera frame, thesis (13).
    disparity
        Conversion of corrected raw numbers to depth.
    correction : optional
        Subtracted from every raw number before the conversion, thesis (16).
    faces
        The marker groups of the reference system that this sensor sees.
    calibration
        When its parts were calibrated, and how well; empty where nobody has noted it.
    depth_unit_mm
        Of the numbers in the depth frames of a sensor that delivers millimetres; None for one that
        delivers raw numbers.
    baseline_mm
        Of a sensor that delivers millimetres, if it is a stereo camera.
    """

    model: str
    serial: str
    depth_camera: PinholeCamera
    color_camera: PinholeCamera
    depth2color: FloatArray
    disparity: DisparityModel
    correction: DisparityCorrection | None = None
    faces: tuple[str, ...] = field(default_factory=tuple)
    calibration: tuple[CalibrationRecord, ...] = ()
    depth_unit_mm: float | None = None
    baseline_mm: float | None = None

    @property
    def family(self) -> SensorFamily:
        """The sensors that measure as this one."""
        if self.depth_unit_mm is None:
            return KINECT_V1
        return DIRECT_DEPTH if self.baseline_mm is None else ACTIVE_STEREO

    @property
    def corrected_image(self) -> CorrectedImage:
        """The depth image that a correction of it is for."""
        if self.depth_unit_mm is None:
            return OF_A_KINECT
        return CorrectedImage(self.depth_camera.width, self.depth_camera.height, "px")

    @property
    def calibrated_at(self) -> str:
        """When a part of it was calibrated last, ISO 8601; empty where nobody has noted it."""
        moments = [step.made_at for step in self.calibration]
        if self.correction is not None:
            moments.append(self.correction.record.made_at)
        return max(moments, default="")

    def calibrated(self, done: CalibrationRecord) -> Sensor:
        """Return the sensor with a step noted in place of the same step before."""
        others = (step for step in self.calibration if step.step != done.step)
        return replace(self, calibration=(*others, done))

    def corrected(self, raw: FloatArray) -> FloatArray:
        """Remove the sensor's distortion from a raw image (height, width), NaN = no reading."""
        return raw if self.correction is None else self.correction.corrected(raw)

    def depth_mm(self, raw: FloatArray) -> FloatArray:
        """Correct and convert a raw image (height, width), NaN = no reading, to mm along z."""
        return self.disparity.depth_mm(self.corrected(raw))

    def points(self, depth_mm: FloatArray) -> FloatArray:
        """Back-project every pixel of a depth image, thesis (10), (11).

        Parameters
        ----------
        depth_mm : (height, width) float64, mm, NaN = no reading

        Returns
        -------
        (height, width, 3) float64, mm, depth camera frame
        """
        rays = self.depth_camera.pixel_rays()
        return np.concatenate([rays * depth_mm[..., None], depth_mm[..., None]], axis=-1)

    def color_pixels(self, points: FloatArray) -> FloatArray:
        """Project points into the colour image, thesis (13) - (15).

        Parameters
        ----------
        points : (..., 3) float64, mm, depth camera frame

        Returns
        -------
        (..., 2) float64, px
        """
        return self.color_camera.project(transform(self.depth2color, points))


def nominal_kinect(serial: str) -> Sensor:
    """Return a Kinect v1 with the nominal parameters of its model."""
    return Sensor(
        model="kinect-v1",
        serial=serial,
        depth_camera=DEPTH_CAMERA,
        color_camera=COLOR_CAMERA,
        depth2color=DEPTH2COLOR,
        disparity=BURRUS,
        faces=("sole",),
    )
