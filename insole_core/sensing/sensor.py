"""One depth sensor as it was calibrated: its two cameras and the way from raw numbers to mm."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.geometry.transforms import transform
from insole_core.sensing.camera import Camera
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.disparity import DisparityModel


@dataclass(frozen=True, eq=False)
class Sensor:
    """A depth camera, the colour camera beside it, and their calibration.

    Parameters
    ----------
    model, serial
        As the device names itself.
    depth_camera, color_camera
    depth2color : (4, 4) float64, mm
        Depth camera frame to colour camera frame, thesis (13).
    disparity
        Raw number, already corrected, to depth.
    correction_raw : (height, width) float32, raw units, optional
        Subtracted from the raw number of every pixel before the conversion, thesis (16).
    correction : optional
        The same with what refines it; where it is given it takes the place of `correction_raw`.
    faces
        The marker groups of the reference system that this sensor sees.
    """

    model: str
    serial: str
    depth_camera: Camera
    color_camera: Camera
    depth2color: FloatArray
    disparity: DisparityModel
    correction_raw: Float32Array | None = None
    faces: tuple[str, ...] = field(default_factory=tuple)
    correction: DisparityCorrection | None = None

    def depth_mm(self, raw: FloatArray) -> FloatArray:
        """Correct and convert a raw image (height, width), NaN = no reading, to mm along z."""
        if self.correction is not None:
            return self.correction.depth_mm(raw, self.disparity)
        corrected = raw if self.correction_raw is None else raw - self.correction_raw
        return self.disparity.depth_mm(corrected)

    def points(self, depth_mm: FloatArray) -> FloatArray:
        """Every pixel of a depth image in space, thesis (10), (11).

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
        """Colour pixels (..., 2) of points (..., 3) in the depth camera frame, (13) - (15)."""
        return self.color_camera.project(transform(self.depth2color, points))
