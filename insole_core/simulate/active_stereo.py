"""A physical model of a stereo camera with a dot projector, as a RealSense D415.

Both infrared images of the dots are rendered (speckle, blur, noise) and matched: every window of
the left one with those of the right one at each whole disparity, and a parabola through the best
correlations. The window's averaging, pixel locking, rims and holes behind edges result as in a real
camera. All projectors shine at once: their dots add up, and nobody needs to know them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray, RawArray
from insole_core.geometry.transforms import inverse, rigid, rotation_about, transform
from insole_core.sensing.correction import CorrectionRecord, DisparityCorrection
from insole_core.sensing.metric_depth import RAW_PER_PX, StereoDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor
from insole_core.simulate.scene import Hits, SceneCaster

MODEL = "realsense-d415"
SIZE, COLOR_SIZE = (1280, 720), (1920, 1080)
UNIT_MM, BASELINE_MM = 0.1, 55.0
_PROJECTOR_MM = np.array([29.0, 0.0, 0.0])
_WINDOW_PX = (9, 9)
_STEP_PX = 1 / 32
"""To which a camera of this family rounds its disparities."""
_SUBSAMPLES = 2
_MARGIN_PX = 14
_SEARCH_PX = 2
_ERROR_PX, _WAVE_PX, _WAVE_LENGTH_PX, _RESIDUAL_PX = 0.1, 0.03, 140.0, 0.02
_RESIDUAL_CORRELATION_PX = 30.0
_TEXELS_PER_PX, _PX_PER_DOT, _DOT_SIGMA_PX = 2, 24.0, 0.6
_FIELD = (0.8, 0.5)
"""Tangents of half the angles that a projector lights."""
_AMBIENT, _BRIGHT_MM = 0.15, 600.0
_SPECKLE, _BLUR_PX, _SHOT_NOISE, _READ_NOISE = 0.15, 0.6, 0.1, 0.05
LEAST_LIKENESS, _LEAST_VARIANCE = 0.6, 1e-4
_LEVELS = 100.0
"""Grey level of a stored infrared picture at brightness 1."""

Region = tuple[slice, slice]
"""Rows and columns of the depth image."""


@dataclass(frozen=True, eq=False)
class StereoDevice:
    """One simulated stereo camera.

    Parameters
    ----------
    sensor
        Its calibration; the correction is nearly, but not exactly, the true error.
    error_px : (720, 1280) float64
        What its disparities are too large by.
    dots : (rows, columns) float32, about 1 on average
        Its projector's pattern over the tangents of the direction.
    least_likeness
        Correlation of windows below which it gives no reading: high by a strict preset.
    """

    sensor: Sensor
    error_px: FloatArray
    dots: Float32Array
    least_likeness: float = LEAST_LIKENESS


def make_stereo_device(
    serial: str,
    faces: tuple[str, ...],
    rng: np.random.Generator,
    least_likeness: float = LEAST_LIKENESS,
) -> StereoDevice:
    """Draw a device.

    Parameters
    ----------
    serial
    faces
        The marker groups it sees.
    rng
    least_likeness
        As of `StereoDevice`.

    Returns
    -------
    StereoDevice
    """
    width, height = SIZE
    focal_px = rng.normal(920.0, 5.0)
    depth_camera = PinholeCamera(
        width, height, focal_px, focal_px, rng.normal(640.0, 5.0), rng.normal(360.0, 4.0)
    )
    color_px = rng.normal(1370.0, 6.0)
    color_camera = PinholeCamera(
        *COLOR_SIZE, color_px, color_px, rng.normal(960.0, 6.0), rng.normal(540.0, 6.0)
    )
    rotation = rotation_about(rng.standard_normal(3), rng.normal(0.0, 0.4))
    error = _error_px(rng)
    residual = scipy.ndimage.gaussian_filter(
        rng.standard_normal((height, width)), _RESIDUAL_CORRELATION_PX
    )
    measured = np.rint((error + _RESIDUAL_PX * residual / residual.std()) * 512) / 512
    record = CorrectionRecord(serial, "2026-01-01T00:00:00Z", "simulated", unit="px")
    sensor = Sensor(
        model=MODEL,
        serial=serial,
        depth_camera=depth_camera,
        color_camera=color_camera,
        depth2color=rigid(rotation, np.array([-15.0, 0.0, 0.0]) + rng.normal(0.0, 0.2, 3)),
        disparity=StereoDisparity(focal_px, BASELINE_MM),
        correction=DisparityCorrection((-RAW_PER_PX * measured).astype(np.float32), record=record),
        faces=faces,
        depth_unit_mm=UNIT_MM,
        baseline_mm=BASELINE_MM,
    )
    return StereoDevice(sensor, error, _draw_dots(focal_px, rng), least_likeness)


def _error_px(rng: np.random.Generator) -> FloatArray:
    """Draw what flat walls show: a smooth surface with waves across it."""
    width, height = SIZE
    v, u = np.meshgrid(np.linspace(-1, 1, height), np.linspace(-1, 1, width), indexing="ij")
    smooth = sum(rng.standard_normal() * u**i * v**j for i in range(4) for j in range(4 - i))
    wave = np.sin(np.pi * width / _WAVE_LENGTH_PX * (u + 0.2 * v) + rng.uniform(0, 2 * np.pi))
    return np.asarray(_ERROR_PX * smooth / np.std(smooth) + _WAVE_PX * wave)


def _draw_dots(focal_px: float, rng: np.random.Generator) -> Float32Array:
    scale = focal_px * _TEXELS_PER_PX
    columns, rows = (int(2 * tangent * scale) for tangent in _FIELD)
    texture = np.zeros((rows, columns), np.float32)
    count = int(rows * columns / (_PX_PER_DOT * _TEXELS_PER_PX**2))
    at = rng.integers(0, rows, count), rng.integers(0, columns, count)
    np.add.at(texture, at, rng.uniform(0.5, 1.5, count) * _PX_PER_DOT * _TEXELS_PER_PX**2)
    return np.asarray(cv2.GaussianBlur(texture, (0, 0), _DOT_SIGMA_PX * _TEXELS_PER_PX))


@dataclass(frozen=True, eq=False)
class Projector:
    """A device's projector in its place.

    Parameters
    ----------
    device
    sensor2reference : (4, 4) float64, mm
        Pose of its depth camera.
    """

    device: StereoDevice
    sensor2reference: FloatArray

    def light_on(self, hits: Hits, caster: SceneCaster) -> FloatArray:
        """Compute the light (n,) that surfaces reflect: dots, slant and distance."""
        own = transform(inverse(self.sensor2reference), hits.points) - _PROJECTOR_MM
        place = transform(self.sensor2reference, _PROJECTOR_MM)
        ways = place - hits.points
        far_mm = np.linalg.norm(ways, axis=1)
        facing = np.clip(np.einsum("nc,nc->n", hits.normals, ways) / far_mm, 0, 1)
        scale = self.device.sensor.depth_camera.fx * _TEXELS_PER_PX
        with np.errstate(divide="ignore", invalid="ignore"):
            texel = (own[:, :2] / own[:, 2:] + _FIELD) * scale
        rows, columns = self.device.dots.shape
        lit = (own[:, 2] > 0) & np.all((texel >= 0) & (texel < [columns - 1, rows - 1]), axis=1)
        lit[lit] = ~caster.is_blocked(hits.points[lit], place)
        light = np.zeros(len(ways))
        light[lit] = _between(self.device.dots, texel[lit])
        return np.asarray(light * facing * (_BRIGHT_MM / far_mm) ** 2)


def _between(texture: Float32Array, texel: FloatArray) -> FloatArray:
    """Interpolate a texture linearly at positions (n, 2) inside it."""
    low = texel.astype(int)
    right, down = (texel - low).T
    column, row = low.T
    upper = texture[row, column] * (1 - right) + texture[row, column + 1] * right
    lower = texture[row + 1, column] * (1 - right) + texture[row + 1, column + 1] * right
    return np.asarray(upper * (1 - down) + lower * down)


@dataclass(frozen=True, eq=False)
class StereoRecording:
    """Both infrared images of a scene, to be matched.

    Parameters
    ----------
    device
    left, right : (height, width) float32
        Without the cameras' noise; the right one reaches farther to the left, by the largest
        disparity.
    region
        Of the depth image that `left` covers; nothing is measured elsewhere.
    search_px
        First and last whole disparity that is compared.
    """

    device: StereoDevice
    left: Float32Array
    right: Float32Array
    region: Region
    search_px: tuple[int, int]

    def frame(self, rng: np.random.Generator) -> RawArray:
        """Draw one depth frame: (720, 1280) uint16, 0.1 mm, 0 = no reading."""
        disparity, known = self._match(_noisy(self.left, rng), _noisy(self.right, rng))
        steps = np.rint(disparity / _STEP_PX)
        camera = self.device.sensor.depth_camera
        depth_mm = camera.fx * BASELINE_MM / (np.maximum(steps, 1) * _STEP_PX)
        stored = np.zeros((camera.height, camera.width), np.uint16)
        stored[self.region] = np.where(known, np.rint(depth_mm / UNIT_MM), 0)
        return stored

    def infrared(self, rng: np.random.Generator) -> dict[str, RawArray]:
        """Draw the rectified pair by file name: each (720, 1280) uint16, 0 to 255."""
        rows, columns = self.region
        sides = {"left": self.left, "right": self.right}
        starts = {"left": columns.start, "right": columns.start - self.search_px[1]}
        pair = {}
        for side, image in sides.items():
            seen = image[:, max(-starts[side], 0) :]
            start = max(starts[side], 0)
            whole = np.zeros((SIZE[1], SIZE[0]), np.uint16)
            levels = np.clip(np.rint(_LEVELS * _noisy(seen, rng)), 0, 255)
            whole[rows, start : start + seen.shape[1]] = levels
            pair[f"infrared_{side}"] = whole
        return pair

    def _match(self, left: Float32Array, right: Float32Array) -> tuple[Float32Array, BoolArray]:
        """Return the disparities (height, width), px, and where one stands out."""
        first, last = self.search_px
        width = left.shape[1]
        mean, spread = _moments(left)
        its_mean, its_spread = _moments(right)
        best = np.full(left.shape, -1.0, np.float32)
        before, after, previous = best.copy(), best.copy(), best.copy()
        found = np.zeros(left.shape, np.int32)
        for disparity in range(first, last + 1):
            part = (slice(None), slice(last - disparity, last - disparity + width))
            covariance = cv2.blur(left * right[part], _WINDOW_PX) - mean * its_mean[part]
            likeness = covariance / (spread * its_spread[part])
            np.copyto(after, likeness, where=found == disparity - 1)
            better = likeness > best
            np.copyto(before, previous, where=better)
            np.copyto(best, likeness, where=better)
            found[better] = disparity
            previous = likeness
        bend = np.maximum(2 * best - before - after, 1e-6)
        known = (best > self.device.least_likeness) & (found > first) & (found < last)
        return np.asarray(found + (after - before) / (2 * bend), np.float32), np.asarray(known)


def record_stereo(
    caster: SceneCaster,
    own: Projector,
    projectors: Sequence[Projector],
    rng: np.random.Generator,
    *,
    things: FloatArray,
) -> StereoRecording:
    """Record a scene with a device's depth camera.

    Parameters
    ----------
    caster
        The scene, reference frame.
    own
        The device and its place.
    projectors
        All that shine meanwhile, its own as well.
    rng
        For the speckle of the surfaces.
    things : (n, 3) float64, mm, reference frame
        Points to be measured; only the region around them is simulated.

    Returns
    -------
    StereoRecording
    """
    camera = own.device.sensor.depth_camera
    placed = transform(inverse(own.sensor2reference), things)
    pixels = camera.project(placed)
    low = np.maximum(np.floor(pixels.min(0)).astype(int) - _MARGIN_PX, 0)
    high = np.minimum(np.ceil(pixels.max(0)).astype(int) + _MARGIN_PX, SIZE)
    disparities = camera.fx * BASELINE_MM / placed[:, 2]
    search = int(disparities.min()) - _SEARCH_PX, int(disparities.max()) + 1 + _SEARCH_PX
    rows, columns = slice(int(low[1]), int(high[1])), slice(int(low[0]), int(high[0]))
    wider = slice(columns.start - search[1], columns.stop - search[0])
    aside = own.sensor2reference @ rigid(np.eye(3), np.array([BASELINE_MM, 0.0, 0.0]))
    bent = _bent(_pixels((rows, wider)), own.device, sum(search) / 2)
    left, right = (
        _speckled(_seen(caster, camera, pose, projectors, pixels), rng)
        for pose, pixels in ((own.sensor2reference, _pixels((rows, columns))), (aside, bent))
    )
    return StereoRecording(own.device, left, right, (rows, columns), search)


def _pixels(region: Region) -> FloatArray:
    """Return the places (height, width, 2) of the pixels of a region."""
    v, u = np.mgrid[region].astype(float)
    return np.stack([u, v], axis=-1)


def _bent(pixels: FloatArray, device: StereoDevice, disparity_px: float) -> FloatArray:
    """Return the places that pixels of the right image show.

    What the factory's calibration leaves is in this image, and so in every match with it.
    """
    along = np.array([1.0, 0.0])
    u, v = np.rint(pixels + disparity_px * along).astype(int).transpose(2, 0, 1)
    error = device.error_px[v, np.clip(u, 0, SIZE[0] - 1)]
    return np.asarray(pixels + error[..., None] * along)


def _seen(
    caster: SceneCaster,
    camera: PinholeCamera,
    camera2reference: FloatArray,
    projectors: Sequence[Projector],
    pixels: FloatArray,
) -> Float32Array:
    """Render what an infrared image (height, width) shows at places (height, width, 2)."""
    image = np.zeros(pixels.shape[:2], np.float32)
    inside = (np.arange(_SUBSAMPLES) + 0.5) / _SUBSAMPLES - 0.5
    flat = pixels.reshape(-1, 2)
    for du in inside:
        for dv in inside:
            normalised = camera.normalised(flat + np.array([du, dv]))
            rays = np.c_[normalised, np.ones(len(flat))] @ camera2reference[:3, :3].T
            hits = caster.cast(camera2reference[:3, 3], rays)
            light = sum(projector.light_on(hits, caster) for projector in projectors)
            albedo = hits.colors.mean(axis=1) / 255
            image.flat[hits.ray] += albedo * (light + _AMBIENT) / _SUBSAMPLES**2
    return image


def _speckled(image: Float32Array, rng: np.random.Generator) -> Float32Array:
    speckle = rng.gamma(_SPECKLE**-2, _SPECKLE**2, image.shape).astype(np.float32)
    return np.asarray(cv2.GaussianBlur(image * speckle, (0, 0), _BLUR_PX))


def _noisy(image: Float32Array, rng: np.random.Generator) -> Float32Array:
    std = np.sqrt(_SHOT_NOISE**2 * image + _READ_NOISE**2)
    return np.asarray(image + std * rng.standard_normal(image.shape, dtype=np.float32))


def _moments(image: Float32Array) -> tuple[Float32Array, Float32Array]:
    """Compute mean and standard deviation in every window."""
    mean = cv2.blur(image, _WINDOW_PX)
    variance = cv2.blur(image * image, _WINDOW_PX) - mean * mean
    return np.asarray(mean), np.sqrt(np.maximum(variance, _LEAST_VARIANCE))
