"""Simulated colour images of a scene: shading, lens distortion, slight blur and noise."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, ByteArray, Float32Array, FloatArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor
from insole_core.simulate.scene import Hits, SceneCaster

_BACKGROUND = 26.0
_AMBIENT = 0.42
_LAMP_MM = np.array([150.0, -350.0, -100.0])
"""Position of the lamp, colour camera frame: above and behind the camera."""
_BLUR_SIGMA_PX = 0.6
_NOISE = 0.35
_NOISE_PER_LEVEL = 0.006
_RAY_GRID_PX = 8
_EDGE_LEVELS = 6.0
"""A pixel that differs by more from one beside it holds an edge."""
_STRATA = 3
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
    sharp = _seen(caster, rays, color2reference).reshape(camera.height, camera.width, 3)
    edges = _edges(sharp)
    sharp[edges] = _seen_by_areas(caster, camera, edges, color2reference)
    return ColorRecording(np.asarray(cv2.GaussianBlur(sharp, (0, 0), _BLUR_SIGMA_PX)))


def _seen(caster: SceneCaster, rays: FloatArray, color2reference: FloatArray) -> Float32Array:
    """Compute the colours (n, 3) along rays (n, 2)."""
    lamp = transform(color2reference, _LAMP_MM)
    colors = np.full((len(rays), 3), _BACKGROUND, dtype=np.float32)
    for first in range(0, len(rays), _RAYS_AT_ONCE):
        part = rays[first : first + _RAYS_AT_ONCE]
        directions = np.c_[part, np.ones(len(part))] @ color2reference[:3, :3].T
        hits = caster.cast(color2reference[:3, 3], directions)
        colors[first + hits.ray] = _lit(hits, lamp)
    return colors


def _edges(image: Float32Array) -> BoolArray:
    """Return which pixels (height, width) hold an edge or touch one."""
    square = np.ones((3, 3), np.uint8)
    change = cv2.subtract(cv2.dilate(image, square), cv2.erode(image, square))
    return np.asarray(change.max(axis=2) > _EDGE_LEVELS)


def _seen_by_areas(
    caster: SceneCaster, camera: PinholeCamera, edges: BoolArray, color2reference: FloatArray
) -> Float32Array:
    """Compute the mean colours (n, 3) over the areas of some pixels (height, width).

    One ray at the centre of a pixel would place an edge along a row or column of pixels up to half
    a pixel off, in all frames alike. Rays are spread at random in equal parts of each area, so that
    no edge can be aligned with them.
    """
    count = int(edges.sum())
    rng = np.random.default_rng(0)
    total = np.zeros((count, 3), dtype=np.float32)
    rays = _pixel_rays(camera)
    # Within a pixel the lens distorts nothing that could be seen.
    per_row, per_column = (np.gradient(rays, axis=axis)[edges] for axis in (0, 1))
    centers = rays[edges]
    for part in np.ndindex(_STRATA, _STRATA):
        right, down = ((np.array(part) + rng.random((count, 2))) / _STRATA - 0.5).T[..., None]
        total += _seen(caster, centers + right * per_column + down * per_row, color2reference)
    return np.asarray(total / _STRATA**2)


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
