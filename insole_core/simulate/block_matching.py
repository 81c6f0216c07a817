"""A physical model of a structured-light sensor, from its dots to its raw values.

The infrared image of the dots is rendered (speckle, blur, noise), and every window of 7 x 9 pixels
of it is compared with the pattern as it would look at each raw value. The window's averaging,
widened rims, and the error due to the positions of the dots result as in a real device. It is
slower than the parametric model of `depth_image`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import cv2
import numpy as np

from insole_core.geometry.arrays import Float32Array, FloatArray, IntArray, RawArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.sensing.disparity import NO_READING
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.simulate.device import BLIND_COLUMNS, WINDOW_PX, Device
from insole_core.simulate.dot_pattern import BLUR_PX, RAW_PER_PX, DotPattern
from insole_core.simulate.scene import Caster, Hits
from insole_core.simulate.surroundings import BARE, Surroundings

_SUBSAMPLES = 4
_BRIGHT_MM = 800.0
_ALBEDO = 0.8
_LEAST_CORRELATION = 0.56
_LEAST_VARIANCE = 1e-4
_SEARCH_RAW = 12
"""Margin of the search in raw units; the real sensor's full range would only add rare outliers."""
_MARGIN_PX = 14
_BLACK, _PER_BRIGHTNESS, _GREATEST = 8.0, 60.0, 1023
"""Numbers of an infrared picture without light, for brightness 1, and the greatest of 10 bits."""

Region = tuple[slice, slice]
"""Rows and columns of a depth image."""


@dataclass(frozen=True)
class Matcher:
    """How a kind of sensor sees and matches its dots: by default like real ones.

    Which figures of real ones it meets: ``docs/simulator.md``.

    Parameters
    ----------
    window_px
        Width and height of the window that is compared; odd, or readings would be shifted.
    speckle_contrast
        Standard deviation of the dots' brightness by speckle, relative to the mean.
    shot_noise, read_noise
        Standard deviations of the camera's noise: at brightness 1, and without light.
    px_per_dot
        None takes the real dots; else dots are drawn at random, each from so many pixels.
    """

    window_px: tuple[int, int] = WINDOW_PX
    speckle_contrast: float = 0.22
    shot_noise: float = 0.175
    read_noise: float = 0.06
    px_per_dot: float | None = None


REAL_MATCHER = Matcher()


@dataclass(frozen=True, eq=False)
class MatchedRecording:
    """The infrared image of a scene, to be matched with the pattern.

    Parameters
    ----------
    infrared : (height, width) float32
        The dots, without the camera's noise; about 1 on a wall at 800 mm.
    region
        Of the depth image; nothing is measured elsewhere.
    pattern : (height, columns) float32
        As the camera sees it, eight columns per pixel, in the rows of the region.
    search_raw
        First and last raw value that is compared.
    camera
        The depth camera.
    matcher
    """

    infrared: Float32Array
    region: Region
    pattern: Float32Array
    search_raw: tuple[int, int]
    camera: PinholeCamera
    matcher: Matcher

    def frame(self, rng: np.random.Generator) -> RawArray:
        """Draw one frame: (480, 640) uint16."""
        raw = np.full((self.camera.height, self.camera.width), NO_READING, np.uint16)
        raw[self.region] = self._match(self._exposed(rng))
        raw[:, BLIND_COLUMNS] = NO_READING
        return raw

    def picture(self, rng: np.random.Generator) -> RawArray:
        """Draw one infrared picture: (480, 640) uint16, 10 bits; 0 outside the region."""
        numbers = np.rint(_BLACK + _PER_BRIGHTNESS * self._exposed(rng))
        picture = np.zeros((self.camera.height, self.camera.width), np.uint16)
        picture[self.region] = np.clip(numbers, 0, _GREATEST)
        return picture

    def _exposed(self, rng: np.random.Generator) -> Float32Array:
        """Return the brightness of one exposure, with the camera's noise."""
        matcher = self.matcher
        std = np.sqrt(matcher.shot_noise**2 * self.infrared + matcher.read_noise**2)
        noise = rng.standard_normal(self.infrared.shape, dtype=np.float32)
        return np.asarray(self.infrared + std * noise)

    def _match(self, image: Float32Array) -> RawArray:
        """Find for every window the raw value at which the pattern correlates with it best."""
        window = self.matcher.window_px
        mean, spread = _moments(image, window)
        best = np.full(image.shape, -np.inf, np.float32)
        found = np.full(image.shape, NO_READING, np.uint16)
        for raw, reference, its_mean, its_spread in self._references():
            covariance = cv2.blur(image * reference, window) - mean * its_mean
            likeness = covariance / its_spread
            found[likeness > best] = raw
            np.maximum(best, likeness, out=best)
        return np.asarray(np.where(best > _LEAST_CORRELATION * spread, found, NO_READING))

    def _references(self) -> Iterator[tuple[int, Float32Array, Float32Array, Float32Array]]:
        """Return every raw value with its pattern, local mean and standard deviation."""
        columns = self.region[1]
        width = columns.stop - columns.start
        first, last = self.search_raw
        # Raw values that differ by whole pixels have the same pattern, shifted.
        for phase in range(RAW_PER_PX):
            picture = np.ascontiguousarray(self.pattern[:, phase::RAW_PER_PX])
            mean, spread = _moments(picture, self.matcher.window_px)
            for raw in range(first + (phase - first) % RAW_PER_PX, last + 1, RAW_PER_PX):
                start = columns.start + raw // RAW_PER_PX
                part = (slice(None), slice(start, start + width))
                yield raw, picture[part], mean[part], spread[part]


def record_matched_depth(
    caster: Caster,
    device: Device,
    sensor2reference: FloatArray,
    rng: np.random.Generator,
    *,
    things: FloatArray,
    matcher: Matcher = REAL_MATCHER,
    dots: np.random.Generator | None = None,
    surroundings: Surroundings = BARE,
) -> MatchedRecording:
    """Record a scene with a device's depth camera by block matching.

    Parameters
    ----------
    caster
        The scene, reference frame.
    device
    sensor2reference : (4, 4) float64, mm
        Depth camera frame to reference frame.
    rng
        For the pattern of the device, and the speckle of the surfaces.
    things : (n, 3) float64, mm, reference frame
        Points to be measured; only the region around them is simulated.
    matcher
    dots
        For the pattern of the device; None takes `rng`.
    surroundings

    Returns
    -------
    MatchedRecording
    """
    camera = device.sensor.depth_camera
    region = _region(camera, transform(inverse(sensor2reference), things))
    pattern = DotPattern.draw(dots or rng, region[0], px_per_dot=matcher.px_per_dot)
    drifted = replace(pattern, drift_raw=RAW_PER_PX * surroundings.drift_px)
    light = _Light(caster, device, sensor2reference, drifted, surroundings)
    image, lowest, highest = light.on(region)
    speckle = rng.gamma(matcher.speckle_contrast**-2, matcher.speckle_contrast**2, image.shape)
    infrared = cv2.GaussianBlur(image * speckle.astype(np.float32), (0, 0), BLUR_PX)
    search = (max(int(lowest) - _SEARCH_RAW, 0), min(int(highest) + _SEARCH_RAW, NO_READING - 1))
    return MatchedRecording(infrared, region, pattern.seen(region[0]), search, camera, matcher)


def _region(camera: PinholeCamera, things: FloatArray) -> Region:
    pixels = camera.project(things)
    low = np.maximum(np.floor(pixels.min(0)).astype(int) - _MARGIN_PX, 0)
    high = np.ceil(pixels.max(0)).astype(int) + _MARGIN_PX
    return slice(low[1], min(high[1], camera.height)), slice(low[0], min(high[0], camera.width))


def _moments(image: Float32Array, window_px: tuple[int, int]) -> tuple[Float32Array, Float32Array]:
    """Compute mean and standard deviation in every window."""
    mean = cv2.blur(image, window_px)
    variance = cv2.blur(image * image, window_px) - mean * mean
    return mean, np.sqrt(np.maximum(variance, _LEAST_VARIANCE))


@dataclass(frozen=True, eq=False)
class _Light:
    """A projector that illuminates a scene, and the camera beside it."""

    caster: Caster
    device: Device
    sensor2reference: FloatArray
    pattern: DotPattern
    surroundings: Surroundings

    def on(self, region: Region) -> tuple[Float32Array, float, float]:
        """Render a region (height, width); return it with its least and greatest raw value."""
        rows, columns = region
        shape = (rows.stop - rows.start, columns.stop - columns.start)
        inside = (np.arange(_SUBSAMPLES) + 0.5) / _SUBSAMPLES - 0.5
        image = np.zeros(shape, np.float32)
        lowest, highest = np.inf, -np.inf
        v, u = (axis.ravel() for axis in np.mgrid[rows, columns].astype(float))
        for du in inside:
            for dv in inside:
                ray, light, raw = self._dots(np.column_stack([u + du, v + dv]))
                image.flat[ray] += light / _SUBSAMPLES**2
                lowest, highest = min(lowest, raw.min()), max(highest, raw.max())
        return image, lowest, highest

    def _dots(self, pixels: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
        """Return index and brightness of pixels (n, 2) that show something, and raw of the lit."""
        camera, pose = self.device.sensor.depth_camera, self.sensor2reference
        rays = np.c_[camera.normalised(pixels), np.ones(len(pixels))] @ pose[:3, :3].T
        hits = self.caster.cast(pose[:3, 3], rays)
        projector = transform(pose, self.device.projector_mm)
        lit = ~self.caster.is_blocked(hits.points, projector)
        shown = pixels[hits.ray[lit]]
        ideal = self.device.sensor.disparity.raw(hits.distance[lit])
        raw = self.device.distort_at(ideal, shown)
        light = _shade(hits, projector)
        light[lit] *= self.pattern.brightness(shown[:, 0], shown[:, 1], raw)
        light[~lit] = 0.0
        return hits.ray, self.surroundings.seen(hits, light, pose[:3, 3], projector), raw


def _shade(hits: Hits, projector: FloatArray) -> FloatArray:
    """Compute the light (n,) that diffuse surfaces reflect, by slant and distance."""
    ways = projector - hits.points
    far_mm = np.linalg.norm(ways, axis=1)
    facing = np.einsum("nc,nc->n", hits.normals, ways) / far_mm
    return np.asarray(_ALBEDO * np.clip(facing, 0, 1) * (_BRIGHT_MM / far_mm) ** 2)
