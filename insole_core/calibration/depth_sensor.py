"""A depth sensor as a function from planes in space to raw numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.disparity import DisparityModel
from insole_core.sensing.pinhole_camera import PinholeCamera


@dataclass(frozen=True, eq=False)
class DepthSensor:
    """Camera and disparity model of a depth sensor, which predict its raw numbers.

    Parameters
    ----------
    tilt_raw
        Added to the raw numbers at the right edge, and at the lower edge, of the image.
    """

    camera: PinholeCamera
    disparity: DisparityModel
    tilt_raw: tuple[float, float] = (0.0, 0.0)

    def raw(self, planes: FloatArray, pixels: FloatArray) -> FloatArray:
        """Predict the raw numbers of planes at pixels.

        Parameters
        ----------
        planes : (k, 3) float64, 1/mm
            1/Z = plane · (x, y, 1), depth camera frame, normalised coordinates.
        pixels : (k, 2) float64, px

        Returns
        -------
        (k,) float64, raw units
        """
        rays = self.camera.normalised(pixels)
        inverse_depth = (planes[:, :2] * rays).sum(-1) + planes[:, 2]
        tilted = tilt_columns(pixels, self.camera) @ np.asarray(self.tilt_raw)
        return np.asarray(self.disparity.raw(1 / inverse_depth) + tilted)


def add_tilt(
    correction: DisparityCorrection, camera: PinholeCamera, tilt_raw: tuple[float, float]
) -> DisparityCorrection:
    """Return a correction that also removes the tilt of all raw numbers.

    Parameters
    ----------
    tilt_raw
        At the right edge, and at the lower edge, of the image.
    """
    v, u = np.indices(correction.offset.shape)
    columns = tilt_columns(np.stack([u, v], axis=-1).reshape(-1, 2).astype(float), camera)
    tilted = (columns @ np.asarray(tilt_raw)).reshape(u.shape)
    return replace(correction, offset=(correction.offset + tilted).astype(np.float32))


def tilt_columns(pixels: FloatArray, camera: PinholeCamera) -> FloatArray:
    """Return coordinates (k, 2) from -1 to 1, left to right and top to bottom of the image.

    Parameters
    ----------
    pixels : (k, 2) float64, px
    """
    half = np.array([camera.width, camera.height]) / 2
    return np.asarray((pixels + 0.5) / half - 1)
