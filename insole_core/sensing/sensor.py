"""A calibrated depth sensor: its two cameras and the conversion from raw numbers to mm."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import transform
from insole_core.sensing.calibration_record import CalibrationRecord
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.disparity import DisparityModel
from insole_core.sensing.pinhole_camera import PinholeCamera


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
