"""A parametric model of a structured-light sensor: its raw values with their errors.

One raw unit is 1/8 px of disparity. The parameters are fitted to a physical simulation of dot
pattern and block matching, and agree with Khoshelham & Elberink 2012, Nguyen et al. 2012 and
Herrera et al. 2012, who do not separate temporal noise from fixed errors.

- *Fixed error*: the few dots in a matching window lie off its centre, so that a pixel reports
  the disparity of a point about 0.7 px away. On a slope this is the error
  0.69 px x (disparity gradient); at the border of a body it makes the ragged outline.
- *Temporal noise*: grows with the slant of the surface.
- Then the distortion of the device, and rounding to whole raw units.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray, RawArray
from insole_core.geometry.transforms import transform
from insole_core.sensing.disparity import NO_READING
from insole_core.simulate.device import BLIND_COLUMNS, WINDOW_PX, Device
from insole_core.simulate.scene import SceneCaster

TEMPORAL_RAW = 0.36
TEMPORAL_SLOPE_RAW = 0.45
FIXED_RAW = 0.25
FIXED_SHIFT_PX = 0.69
_ROUNDING_VARIANCE = 1 / 12
_CORRELATION_PX = 2.0
_UNCORRELATED_SHARE = 0.2
_STEEPEST_DEG = 72.0
_STEEPEST_SPREAD_DEG = 1.5
_LEAST_SUPPORT = 0.4


@dataclass(frozen=True, eq=False)
class DepthRecording:
    """A depth view without what changes from frame to frame.

    Parameters
    ----------
    expected_raw : (480, 640) float64, raw units
        Distorted, with the fixed error, not yet rounded; NaN where nothing can be measured.
    slant_deg : (480, 640) float64
        Angle of the surface normal against the line of sight; NaN where there is no surface.
    """

    expected_raw: FloatArray
    slant_deg: FloatArray

    def frame(self, rng: np.random.Generator) -> RawArray:
        """Draw one frame: (480, 640) uint16."""
        noise = rng.standard_normal(self.expected_raw.shape) * temporal_sigma_raw(self.slant_deg)
        limit = rng.normal(_STEEPEST_DEG, _STEEPEST_SPREAD_DEG, self.expected_raw.shape)
        raw = np.round(self.expected_raw + noise)
        valid = (self.slant_deg < limit) & (raw >= 0) & (raw < NO_READING)
        return np.where(valid, raw, NO_READING).astype(np.uint16)


def temporal_sigma_raw(slant_deg: FloatArray) -> FloatArray:
    """Compute the standard deviation of the temporal noise before rounding, raw units.

    After rounding it is sigma^2 = 0.36^2 + (0.45 tan slant)^2.
    """
    tangent = np.tan(np.radians(np.clip(slant_deg, 0, 80)))
    total = TEMPORAL_RAW**2 + (TEMPORAL_SLOPE_RAW * tangent) ** 2
    return np.asarray(np.sqrt(total - _ROUNDING_VARIANCE))


def record_depth(
    caster: SceneCaster, device: Device, sensor2reference: FloatArray, rng: np.random.Generator
) -> DepthRecording:
    """Record a scene with a device's depth camera by the parametric model.

    Parameters
    ----------
    caster
        The scene, reference frame.
    device
    sensor2reference : (4, 4) float64, mm
        Depth camera frame to reference frame.
    rng
        For the fixed errors.

    Returns
    -------
    DepthRecording
    """
    camera = device.sensor.depth_camera
    shape = (camera.height, camera.width)
    v, u = np.mgrid[: camera.height, : camera.width].astype(float)
    shifts = [FIXED_SHIFT_PX * _correlated_noise(shape, rng) for _ in range(2)]
    rays = camera.normalised(np.stack([u + shifts[0], v + shifts[1]], axis=-1)).reshape(-1, 2)
    directions = np.c_[rays, np.ones(len(rays))] @ sensor2reference[:3, :3].T
    hits = caster.cast(sensor2reference[:3, 3], directions)
    lit = ~caster.is_blocked(hits.points, transform(sensor2reference, device.projector_mm))

    raw = np.full(shape, np.nan)
    raw.flat[hits.ray[lit]] = device.sensor.disparity.raw(hits.distance[lit])
    slant_deg = np.full(shape, np.nan)
    slant_deg.flat[hits.ray] = _slant_deg(hits.normals, directions[hits.ray])
    raw = np.where(_is_matchable(raw), raw, np.nan)
    raw += FIXED_RAW * _correlated_noise(shape, rng)
    return DepthRecording(device.distort(raw), slant_deg)


def _slant_deg(normals: FloatArray, directions: FloatArray) -> FloatArray:
    cosine = -np.einsum("nc,nc->n", normals, directions) / np.linalg.norm(directions, axis=1)
    return np.asarray(np.degrees(np.arccos(np.clip(cosine, 0, 1))))


def _is_matchable(raw: FloatArray) -> BoolArray:
    """Return where the matching window is complete and enough of it has a surface."""
    valid = np.isfinite(raw)
    support = scipy.ndimage.uniform_filter(valid.astype(float), WINDOW_PX[::-1], mode="nearest")
    matchable = valid & (support >= _LEAST_SUPPORT)
    matchable[:, BLIND_COLUMNS] = False
    return matchable


def _correlated_noise(shape: tuple[int, int], rng: np.random.Generator) -> FloatArray:
    """Draw unit noise, correlated over about 4 px because neighbouring windows share dots."""
    smooth = scipy.ndimage.gaussian_filter(rng.standard_normal(shape), _CORRELATION_PX)
    share = _UNCORRELATED_SHARE
    white = rng.standard_normal(shape)
    return np.asarray(np.sqrt(1 - share) * smooth / smooth.std() + np.sqrt(share) * white)
