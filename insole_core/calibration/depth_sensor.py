"""A depth sensor as what turns a plane in space into raw numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.disparity import DisparityModel
from insole_core.sensing.pinhole_camera import PinholeCamera


@dataclass(frozen=True, eq=False)
class DepthSensor:
    """What turns a plane in space into raw numbers.

    Parameters
    ----------
    camera
    disparity
    tilt_raw
        What is added to the raw numbers at the right edge, and at the lower edge, of the image.
    """

    camera: PinholeCamera
    disparity: DisparityModel
    tilt_raw: tuple[float, float] = (0.0, 0.0)

    def raw(self, planes: FloatArray, pixels: FloatArray) -> FloatArray:
        """Give the raw numbers (k,) of planes (k, 3), 1/Z = plane · (x, y, 1), at pixels (k, 2)."""
        rays = self.camera.normalised(pixels)
        inverse_depth = (planes[:, :2] * rays).sum(-1) + planes[:, 2]
        tilted = tilt_columns(pixels, self.camera) @ np.asarray(self.tilt_raw)
        return np.asarray(self.disparity.raw(1 / inverse_depth) + tilted)


def add_tilt(
    correction: DisparityCorrection, camera: PinholeCamera, tilt_raw: tuple[float, float]
) -> DisparityCorrection:
    """Give a correction that takes the tilt of all raw numbers out as well."""
    v, u = np.indices(correction.offset.shape)
    columns = tilt_columns(np.stack([u, v], axis=-1).reshape(-1, 2).astype(float), camera)
    tilted = (columns @ np.asarray(tilt_raw)).reshape(u.shape)
    return replace(correction, offset=(correction.offset + tilted).astype(np.float32))


def tilt_columns(pixels: FloatArray, camera: PinholeCamera) -> FloatArray:
    """(k, 2) -1 to 1 from left to right, and from top to bottom, of the image."""
    half = np.array([camera.width, camera.height]) / 2
    return np.asarray((pixels + 0.5) / half - 1)
