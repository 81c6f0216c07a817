"""A simulated sensor: the true properties of one device, and its calibration."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.polynomial import chebyshev

from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.recording.sensor_folder import DEPTH_SIZE
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.disparity import DisparityModel, FactoryDisparity, LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

BASELINE_MM = 75.0
WINDOW_PX = (7, 9)
"""Width and height of the matching window."""
BLIND_COLUMNS = slice(-8, None)
"""Columns of the depth image without a reading, as in all real captures."""
_WIDTH, _HEIGHT = DEPTH_SIZE
_FULL_COLOR_WIDTH = 1280
_DISTORTION_RMS_RAW = 3.0
_DISTORTION_DECAY = 0.002
"""Per raw unit: the distortion is stronger near the device (Herrera et al. 2012)."""
_RESIDUAL_RMS_RAW = 0.2
_RESIDUAL_CORRELATION_PX = 20.0
_CORRECTION_STEP_RAW = 1 / 128
"""Step to which the correction is rounded: far below its error, and the file is 4 times smaller."""


@dataclass(frozen=True, eq=False)
class Device:
    """One simulated physical sensor.

    Parameters
    ----------
    sensor
        Its calibration; the correction is nearly, but not exactly, the true distortion.
    distortion_raw : (480, 640) float64, raw units
        True distortion at `reference_raw`.
    reference_raw
        The raw value at which the distortion was calibrated.
    """

    sensor: Sensor
    distortion_raw: FloatArray
    reference_raw: float

    @property
    def projector_mm(self) -> FloatArray:
        """(3,) position of the dot projector, depth camera frame: beside the colour camera, +x."""
        return np.array([BASELINE_MM, 0.0, 0.0])

    def distort(self, raw: FloatArray) -> FloatArray:
        """Add the distortion to ideal raw values (480, 640)."""
        return self._distorted(raw, self.distortion_raw)

    def distort_at(self, raw: FloatArray, pixels: FloatArray) -> FloatArray:
        """Add the distortion to ideal raw values at some pixels.

        Parameters
        ----------
        raw : (n,) float64, raw units
        pixels : (n, 2) float64, px, depth image

        Returns
        -------
        (n,) float64, raw units
        """
        nearest = np.clip(np.rint(pixels).astype(int), 0, [_WIDTH - 1, _HEIGHT - 1])
        return self._distorted(raw, self.distortion_raw[nearest[:, 1], nearest[:, 0]])

    def _distorted(self, raw: FloatArray, distortion_raw: FloatArray) -> FloatArray:
        decay = np.exp(-_DISTORTION_DECAY * (raw - self.reference_raw))
        return np.asarray(raw + distortion_raw * decay)


def make_device(
    serial: str,
    faces: tuple[str, ...],
    distance_mm: float,
    color_size: tuple[int, int],
    rng: np.random.Generator,
) -> Device:
    """Draw a device; spreads as measured on real ones (THESIS_NOTES, table 1; Herrera et al.).

    Parameters
    ----------
    serial
    faces
        The marker groups it sees.
    distance_mm
        Distance at which its distortion was calibrated.
    color_size
        Width and height of the colour image, px.
    rng

    Returns
    -------
    Device
    """
    focal_px = rng.normal(583.0, 3.0)
    depth_camera = PinholeCamera(
        _WIDTH, _HEIGHT, focal_px, focal_px, rng.normal(318.0, 3.0), rng.normal(242.0, 3.0)
    )
    disparity = _disparity(focal_px, rng)
    distortion = _distortion(rng)
    residual = _unit(
        scipy.ndimage.gaussian_filter(
            rng.standard_normal((_HEIGHT, _WIDTH)), _RESIDUAL_CORRELATION_PX
        )
    )
    sensor = Sensor(
        model="kinect-v1",
        serial=serial,
        depth_camera=depth_camera,
        color_camera=_color_camera(color_size, rng),
        depth2color=_depth2color(rng),
        disparity=disparity,
        correction=DisparityCorrection(_rounded(distortion + _RESIDUAL_RMS_RAW * residual)),
        faces=faces,
    )
    return Device(sensor, distortion, float(disparity.raw(np.array(distance_mm))))


def _color_camera(size: tuple[int, int], rng: np.random.Generator) -> PinholeCamera:
    """Draw a colour camera; images smaller than 1280 x 1024 are scaled and cropped vertically."""
    width, height = size
    scale = width / _FULL_COLOR_WIDTH
    focal_px = rng.normal(1035.0, 4.0) * scale
    return PinholeCamera(
        width,
        height,
        focal_px,
        focal_px * rng.normal(1.0, 0.0005),
        (width - 1) / 2 + rng.normal(0.0, 6.0) * scale,
        (height - 1) / 2 + rng.normal(0.0, 6.0) * scale,
        (
            rng.normal(0.14, 0.005),
            rng.normal(-0.24, 0.008),
            rng.normal(0, 5e-4),
            rng.normal(0, 5e-4),
            0.0,
        ),
    )


def _depth2color(rng: np.random.Generator) -> FloatArray:
    rotation = rotation_about(rng.standard_normal(3), rng.normal(0.0, 0.4))
    return rigid(rotation, np.array([-25.0, 0.0, 0.0]) + rng.normal(0.0, 0.4, 3))


def _disparity(focal_px: float, rng: np.random.Generator) -> DisparityModel:
    """Draw Z = 8 f b / (d0 - raw), in one of the two forms in which devices are described."""
    offset_raw = rng.normal(1090.0, 2.0)
    if rng.random() < 0.5:
        slope = 1000.0 / (8 * focal_px * BASELINE_MM)
        return LinearInverseDisparity(a=offset_raw * slope, b=-slope)
    distance_mm = 1200.0
    return FactoryDisparity(
        reference_distance_mm=distance_mm,
        # half of a pixel of the sensor's full resolution, seen at the reference distance
        reference_pixel_size_mm=distance_mm / (2 * focal_px),
        baseline_mm=BASELINE_MM,
        constant_shift=200.0 + rng.normal(0.0, 1.0),
    )


def _distortion(rng: np.random.Generator) -> FloatArray:
    """Draw a smooth map (480, 640), raw units: a polynomial of degree 4 in both directions."""
    order = np.add.outer(np.arange(5), np.arange(5))
    coefficients = rng.standard_normal((5, 5)) * np.where(order <= 4, 1.0 / (1 + order), 0)
    v, u = np.linspace(-1, 1, _HEIGHT), np.linspace(-1, 1, _WIDTH)
    return _DISTORTION_RMS_RAW * _unit(np.asarray(chebyshev.chebgrid2d(v, u, coefficients)))


def _rounded(correction_raw: FloatArray) -> Float32Array:
    steps = np.round(correction_raw / _CORRECTION_STEP_RAW)
    return (steps * _CORRECTION_STEP_RAW).astype(np.float32)


def _unit(values: FloatArray) -> FloatArray:
    """Scale to a root mean square of one."""
    return np.asarray(values / np.sqrt(np.mean(values**2)))
