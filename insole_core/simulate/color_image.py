"""Simulated colour images of a scene: shading, lens distortion, slight blur and noise."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.geometry.arrays import ByteArray, Float32Array, FloatArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor
from insole_core.simulate.ray_caster import Hits, SceneCaster

_BACKGROUND = 26.0
_AMBIENT = 0.42
_LAMP_MM = np.array([150.0, -350.0, -100.0])
"""Position of the lamp, colour camera frame: above and behind the camera."""
_BLUR_SIGMA_PX = 0.6
_NOISE = 0.35
_NOISE_PER_LEVEL = 0.006
_RAY_GRID_PX = 8
_RAYS_AT_ONCE = 1 << 18
"""Number of rays cast at once; a whole image would take half a gigabyte."""


@dataclass(frozen=True, eq=False)
class ColorRecording:
    """A colour view that does not change from frame to frame.

    Parameters
    ----------
    expected : (height, width, 3) float32, RGB
        The image without noise, 0 to 255.
    """

    expected: Float32Array

    def frame(self, rng: np.random.Generator) -> ByteArray:
        """Draw one frame: (height, width, 3) uint8, RGB."""
        noise = rng.standard_normal(self.expected.shape, dtype=np.float32)
        levels = self.expected + noise * (_NOISE + _NOISE_PER_LEVEL * self.expected)
        return np.clip(np.round(levels), 0, 255).astype(np.uint8)


def record_color(
    caster: SceneCaster, sensor: Sensor, sensor2reference: FloatArray
) -> ColorRecording:
    """Record a scene with a sensor's colour camera.

    Parameters
    ----------
    caster
        The scene, reference frame.
    sensor
    sensor2reference : (4, 4) float64, mm
        *Depth* camera frame to reference frame.

    Returns
    -------
    ColorRecording
    """
    camera = sensor.color_camera
    color2reference = sensor2reference @ inverse(sensor.depth2color)
    rays = _pixel_rays(camera).reshape(-1, 2)
    directions = np.c_[rays, np.ones(len(rays))] @ color2reference[:3, :3].T
    lamp = transform(color2reference, _LAMP_MM)
    image = np.full((camera.height * camera.width, 3), _BACKGROUND, dtype=np.float32)
    for first in range(0, len(directions), _RAYS_AT_ONCE):
        hits = caster.cast(color2reference[:3, 3], directions[first : first + _RAYS_AT_ONCE])
        image[first + hits.ray] = _lit(hits, lamp)
    sharp = image.reshape(camera.height, camera.width, 3)
    return ColorRecording(np.asarray(cv2.GaussianBlur(sharp, (0, 0), _BLUR_SIGMA_PX)))


def _lit(hits: Hits, lamp: FloatArray) -> FloatArray:
    """Compute the colours (n, 3) of surfaces, darker the less they face the lamp."""
    to_lamp = lamp - hits.points
    to_lamp /= np.linalg.norm(to_lamp, axis=1, keepdims=True)
    facing = np.clip(np.einsum("nc,nc->n", hits.normals, to_lamp), 0, 1)
    return np.asarray(hits.colors * (_AMBIENT + (1 - _AMBIENT) * facing)[:, None])


def _pixel_rays(camera: PinholeCamera) -> FloatArray:
    """Compute the rays of all pixels by interpolation in a coarse grid, 60 times as fast.

    Lens distortion is so smooth that this is accurate to 0.01 px.
    """
    step = _RAY_GRID_PX
    # One node in the middle of every block of pixels, and one block more on every side.
    rows = (np.arange(-1, -(-camera.height // step) + 1) + 0.5) * step - 0.5
    columns = (np.arange(-1, -(-camera.width // step) + 1) + 0.5) * step - 0.5
    v, u = np.meshgrid(rows, columns, indexing="ij")
    nodes = camera.normalised(np.stack([u, v], axis=-1))
    fine = cv2.resize(nodes, (len(columns) * step, len(rows) * step))
    return np.asarray(fine[step : step + camera.height, step : step + camera.width])
