"""What the infrared picture of a view says of a mesh: every pixel of a dot is a reading.

The mesh tells the disparity of every pixel, and so which part of the device's pattern it should
show. What the picture shows instead, divided by the pattern's slope there, is the error of the
mesh. So the window in which dots are compared is the surface itself: it follows every slant and
curve, and ends where the surface ends.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.observation import Observations, hits_of
from insole_core.sensing.infrared_reference import InfraredReference

_WINDOW_PX = 8.0
"""Standard deviation of the windows in which gain, offset and likeness are judged."""
_SHARPER, _SHARPER_PX = 2.0, 0.7
"""Speckle lies before the lens, which blurs dots and speckle alike, so that neighbours share it.
Where both picture and pattern are sharpened, what a pixel says is more its own."""
_READ_NOISE, _SPECKLE = 0.3, 0.5
"""Standard deviations relative to the mean brightness, and to that of the dot."""
_SHARED_PX = 6
"""Number of pixels that share the error of their dot: speckle, and where the pattern has it."""
_ROBUST = 2.5
_LEAST_COSINE = 0.25
_NEAR_RAW = 8.0
_LARGEST_SHIFT_RAW = 2.0
"""Of a window; where another foot was before the sensor, most are farther from the surface."""
_LEAST_LIKENESS, _LEAST_GAIN = 0.7, 0.2
_BRIGHT_GAIN = 0.55
"""Share of the light that is the dots', below which other light drowns them; 0.6 to 0.9 indoors."""
_MOST_NOISE = 0.85
"""What is left of a picture relative to its dots, in units of the noise that is assumed; of the
mean of six pictures 0.6 to 0.75, with twice the noise 0.8 to 1, with speckle of 50 % 1 to 1.2."""
_LEAST_SLOPE = 1e-3
_LARGEST_RAW = 40.0
_LEAST_INFORMATION = 1e-9
_UNSEEN_RAW = 600.0


@dataclass(frozen=True, eq=False)
class InfraredView:
    """The infrared picture of a view, with the pattern of its sensor.

    Parameters
    ----------
    picture : (height, width) float32
        Mean of the frames.
    reference
        What the picture shows at every disparity.
    finer
        Number of its pixels across a reading.
    usual_noise
        Of picture minus pattern, relative to that of a picture and a learnt pattern.
    moved_raw
        As of `DotPictures`.
    """

    picture: Float32Array
    reference: InfraredReference
    finer: int = 1
    usual_noise: float = 1.0
    moved_raw: float | None = None

    @cached_property
    def sharpened(self) -> Float32Array:
        """The picture, sharpened as `sharp_reference` is."""
        return _sharpened(self.picture, 1)

    @cached_property
    def sharp_reference(self) -> InfraredReference:
        """The pattern, sharpened."""
        pattern = _sharpened(self.reference.pattern, self.reference.fine)
        return replace(self.reference, pattern=pattern)


@dataclass(frozen=True, eq=False)
class Evidence:
    """The equations of one view, and how far its picture is to be trusted.

    Parameters
    ----------
    observations
    share
        Of the foot's pixels, on which picture and pattern agree.
    bright, noisy
        Share on which they do, but other light outshines the dots, or noise covers them.
    """

    observations: Observations
    share: float
    bright: float
    noisy: float


@dataclass(frozen=True, eq=False)
class _Windows:
    """What is left of a picture after gain, offset and likeness of the surroundings.

    Parameters
    ----------
    left, per_raw : (height, width) float64
        Picture minus pattern, and how the pattern changes by raw unit.
    information : (height, width) float64
        Inverse variance of a pixel's brightness, less where it is an outlier.
    trusted : (height, width) bool
    bright, noisy : (height, width) bool
        Of those, where other light outshines the dots, or else noise covers them.
    """

    left: FloatArray
    per_raw: FloatArray
    information: FloatArray
    trusted: BoolArray
    bright: BoolArray
    noisy: BoolArray


def infrared_evidence(
    infrared: InfraredView,
    reading: DepthView,
    mesh: TriangleMesh,
    normals: FloatArray,
    caster: RayCaster,
) -> Evidence:
    """Compare the infrared picture of a view with the pattern on a mesh, pixel by pixel.

    Parameters
    ----------
    infrared
    reading
        Of the same view; where the chip measured nothing, or something else, no dot is expected.
    mesh : mm, reference frame
    normals : (n, 3) float64
        Directions in which the vertices may move.
    caster
        Of the same mesh.

    Returns
    -------
    Evidence
    """
    reading = reading.finer(infrared.finer)
    hits = hits_of(reading, mesh, normals, caster)
    raw, cosine = (np.full(reading.raw.shape, np.nan) for _ in range(2))
    raw.flat[hits.ray] = reading.sensor.disparity.raw(hits.depth_mm)
    cosine.flat[hits.ray] = hits.cosine
    shown = (np.abs(reading.raw - raw) < _NEAR_RAW) & (cosine > _LEAST_COSINE)
    windows = _compare(infrared, reading, raw, shown)
    used = windows.trusted.ravel()[hits.ray]
    at = hits.ray[used]
    per_raw = windows.per_raw.ravel()[at]
    per_raw = np.where(np.abs(per_raw) > _LEAST_SLOPE, per_raw, _LEAST_SLOPE)
    residuals = np.clip(windows.left.ravel()[at] / per_raw, -_LARGEST_RAW, _LARGEST_RAW)
    variance = 1 / np.maximum(windows.information.ravel()[at] * per_raw**2, _LEAST_INFORMATION)
    chosen = np.flatnonzero(used)
    observations = hits.equations(
        reading, mesh, chosen, residuals=residuals, variance=variance, shared_px=_SHARED_PX
    )
    trusted, bright, noisy = (
        float(part.sum() / max(shown.sum(), 1))
        for part in (windows.trusted, windows.bright, windows.noisy)
    )
    return Evidence(observations, trusted, bright, noisy)


def _compare(
    infrared: InfraredView, reading: DepthView, raw: FloatArray, shown: BoolArray
) -> _Windows:
    """Find gain and offset around every pixel, and how well picture and pattern agree there."""
    pattern, slope = _pattern(infrared.sharp_reference, reading, raw)
    height, width = raw.shape
    u, v = reading.corner
    mask = shown.astype(float)
    area = np.maximum(_around(mask), 1e-6)
    picture = infrared.sharpened[v : v + height, u : u + width].astype(float)
    picture = picture / np.maximum(_around(mask * picture) / area, 1.0)
    noise = _READ_NOISE**2 + (_SPECKLE * pattern) ** 2
    weight = mask / noise
    for _ in range(2):
        total = np.maximum(_around(weight), 1e-9)
        dots = _around(weight * pattern) / total
        light = _around(weight * picture) / total
        contrast = _around(weight * pattern**2) / total - dots**2
        gain = (_around(weight * pattern * picture) / total - dots * light) / np.maximum(
            contrast, 1e-6
        )
        left = picture - light - gain * (pattern - dots)
        moving = gain * _around(weight * slope**2)
        shift = _around(weight * slope * left) / np.where(np.abs(moving) > 1e-9, moving, np.inf)
        unexplained = left - gain * shift * slope
        variance = np.maximum(_around(mask * unexplained**2 / noise) / area, 1e-6)
        weight = mask / noise / (1 + unexplained**2 / (noise * variance * _ROBUST**2)) ** 2
    spread = _around(mask * picture**2) / area - (_around(mask * picture) / area) ** 2
    missed = _around(mask * unexplained**2) / area / np.maximum(spread, 1e-6)
    likeness = np.sqrt(np.clip(1 - missed, 0, 1))
    trusted = shown & (likeness > _LEAST_LIKENESS) & (gain > _LEAST_GAIN)
    trusted &= np.abs(shift) < _LARGEST_SHIFT_RAW
    bright = trusted & (gain < _BRIGHT_GAIN)
    noisy = trusted & ~bright & (np.sqrt(variance) > _MOST_NOISE * infrared.usual_noise * gain)
    return _Windows(left, gain * slope, weight / variance, trusted, bright, noisy)


def _pattern(
    reference: InfraredReference, reading: DepthView, raw: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the pattern (height, width) that a view should show, and its slope per raw unit."""
    camera, (height, width), (u, v) = reading.sensor.depth_camera, raw.shape, reading.corner
    part = slice(v, v + height), slice(u, u + width)
    whole = np.full((camera.height, camera.width), _UNSEEN_RAW)
    whole[part] = np.where(np.isfinite(raw), raw, _UNSEEN_RAW)
    seen, slope = reference.shown(reference.distorted(whole)[part], reading.corner)
    return seen.astype(float), slope.astype(float)


def _sharpened(image: Float32Array, fine: int) -> Float32Array:
    """Sharpen an image that has so many columns per pixel."""
    blurred = cv2.GaussianBlur(image, (0, 0), sigmaX=_SHARPER_PX * fine, sigmaY=_SHARPER_PX)
    return np.asarray(image + np.float32(_SHARPER) * (image - blurred), np.float32)


def _around(image: FloatArray) -> FloatArray:
    """Take the weighted mean around every pixel, with nothing beyond the edges."""
    blurred = cv2.GaussianBlur(image, (0, 0), _WINDOW_PX, borderType=cv2.BORDER_CONSTANT)
    return np.asarray(blurred)
