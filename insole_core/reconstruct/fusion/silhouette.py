"""The silhouette of the foot in a colour image, from the CIE L*a*b* colours at its readings."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, ByteArray, Float32Array, FloatArray, IndexArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.reconstruct.fusion.depth_view import DepthView

_MAX_LEVEL = 255
_LINEAR_STEPS = 8
"""Steps of linear light for one of the colour's: dark ones lie close together."""
_MATRIX_BITS, _ROOT_BITS = 12, 15
"""Binary places of the fixed-point numbers."""
_RGB2XYZ = np.array(  # ITU-R BT.709 primaries
    [
        [0.412453, 0.357580, 0.180423],
        [0.212671, 0.715160, 0.072169],
        [0.019334, 0.119193, 0.950227],
    ]
)
_WHITE_XYZ = np.array([0.950456, 1.0, 1.088754])  # D65
_CORE_PX = 4
"""Depth widens the foot by up to half of the sensor's window; this far inside it is surely foot."""
_RING = (6.0, 25.0)
"""Distances from the depth readings, in depth pixels, between which there is surely background."""
_REACH = 8.0
_BINS = 32
_LARGEST_ERROR = 0.04
_SURE = 0.3
_LEAST_SAMPLES = 500
_TOLERANCE_MM, _FULL_WIDTH = 0.8, 1280
"""In a picture of that width; with half as many pixels an outline is known half as well."""


def _linear_light() -> Float32Array:
    """Return the linear light (256,) of each level of sRGB (IEC 61966-2-1), in steps."""
    level = np.arange(_MAX_LEVEL + 1) / _MAX_LEVEL
    light = np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4)
    return np.asarray(np.rint(_MAX_LEVEL * _LINEAR_STEPS * light), np.float32)


def _roots() -> IndexArray:
    """Return the cube root of each step of light, or what CIE 15 puts in its place in the dark."""
    light = np.linspace(0, 1, _MAX_LEVEL * _LINEAR_STEPS + 1)
    root = np.where(light < 216 / 24389, light * 841 / 108 + 16 / 116, np.cbrt(light))
    return np.asarray(np.rint(2**_ROOT_BITS * root), np.int32)


_LIGHT = _linear_light()
_MATRIX = np.rint(2**_MATRIX_BITS * _RGB2XYZ / _WHITE_XYZ[:, None]).astype(np.float32)
_ROOT = _roots()


def rgb2lab(rgb: ByteArray) -> ByteArray:
    """Convert colours of sRGB to L*a*b*.

    Parameters
    ----------
    rgb : (..., 3) uint8

    Returns
    -------
    (..., 3) uint8
        L* from 0 to 255 instead of 100, a* and b* increased by 128, as in OpenCV.
    """
    channels = rgb.reshape(-1, 3).T
    xyz = _MATRIX @ _LIGHT.take(channels)  # whole numbers below 2^24, so that sums are exact
    x, y, z = _ROOT.take(_rounded(xyz.astype(np.int32), _MATRIX_BITS))
    offset = 128 << _ROOT_BITS
    lightness = (116 * _MAX_LEVEL + 50) // 100 * y - ((16 * _MAX_LEVEL << _ROOT_BITS) + 50) // 100
    lab = np.empty(rgb.shape, np.uint8)
    for channel, value in enumerate([lightness, 500 * (x - y) + offset, 200 * (y - z) + offset]):
        lab.reshape(-1, 3)[:, channel] = np.clip(_rounded(value, _ROOT_BITS), 0, _MAX_LEVEL)
    return lab


def _rounded(numbers: IndexArray, bits: int) -> IndexArray:
    """Round fixed-point numbers with so many binary places."""
    return (numbers + (1 << bits - 1)) >> bits


@dataclass(frozen=True, eq=False)
class Silhouette:
    """The outline of the foot in a part of a colour image.

    Parameters
    ----------
    corner : (u, v), px
        Position of the arrays' first pixel in the colour image.
    outside_px : (height, width) float32
        Distance from the outline, negative inside.
    background : (height, width) bool
        Pixels that certainly have the colour of the background.
    """

    corner: tuple[int, int]
    outside_px: Float32Array
    background: BoolArray

    def look_up(self, pixels: FloatArray) -> FloatArray:
        """Return the distances (n,), px, outside of the foot at colour pixels (n, 2).

        Negative inside; -inf where it is uncertain and outside of the arrays.
        """
        height, width = self.outside_px.shape
        u, v = (np.rint(pixels).astype(np.int64) - self.corner).T
        within = (u >= 0) & (u < width) & (v >= 0) & (v < height)
        found = np.full(len(pixels), -np.inf)
        u, v = u[within], v[within]
        distance = self.outside_px[v, u]
        found[within] = np.where(self.background[v, u] | (distance < 0), distance, -np.inf)
        return found


def find_silhouette(reading: DepthView) -> Silhouette | None:
    """Find the outline of the foot; None when its colours do not differ from the background's.

    Every pixel is classified (Bayes) by the histograms of the colours inside the foot and in a
    ring around it. When more than a few of the samples themselves are classified wrongly, the
    outline is not reliable.
    """
    camera = reading.sensor.color_camera
    scale = camera.fx / reading.sensor.depth_camera.fx
    known = reading.known
    pixels = _in_color(reading, known)
    margin = int(np.ceil(_RING[1] * scale))
    low = np.maximum(np.floor(pixels.min(0)).astype(np.int64) - margin, 0)
    high = np.minimum(
        np.ceil(pixels.max(0)).astype(np.int64) + margin, [camera.width, camera.height]
    )
    if (high - low < 3).any():
        return None
    shape = (int(high[1] - low[1]), int(high[0] - low[0]))
    kernel = np.ones((2 * _CORE_PX + 1,) * 2, np.uint8)
    core = cv2.erode(known.astype(np.uint8), kernel) > 0
    gap = 2 * int(np.ceil(scale)) + 1
    foot = _painted(pixels - low, shape, 2 * gap + 1)
    inside = _painted(_in_color(reading, core) - low, shape, gap) > 0
    distance = cv2.distanceTransform(1 - foot, cv2.DIST_L2, 5) / scale
    around = (distance > _RING[0]) & (distance < _RING[1])
    color = reading.color[low[1] : high[1], low[0] : high[0]]
    likelihood = _likelihood(color, inside, around)
    if likelihood is None:
        return None
    outline = _largest_filled(((likelihood > 0.5) & (distance < _REACH)).astype(np.uint8))
    outside = cv2.distanceTransform(1 - outline, cv2.DIST_L2, 5)
    depth_inside = cv2.distanceTransform(outline, cv2.DIST_L2, 5)
    signed = np.where(outline > 0, 0.5 - depth_inside, outside - 0.5).astype(np.float32)
    background = (outline == 0) & (cv2.GaussianBlur(likelihood, (0, 0), 1) < _SURE)
    return Silhouette((int(low[0]), int(low[1])), signed, background)


def is_beside(points: FloatArray, reading: DepthView, outline: Silhouette) -> BoolArray:
    """Return which points the colour image shows to lie outside of the foot.

    Parameters
    ----------
    points : (n, 3) float64, mm, reference frame
    reading
        The view to which the outline belongs.
    outline

    Returns
    -------
    (n,) bool
    """
    in_color = transform(inverse(reading.color2reference), points)
    camera = reading.sensor.color_camera
    outside_px = outline.look_up(camera.project(in_color))
    tolerance_mm = _TOLERANCE_MM * max(1.0, _FULL_WIDTH / camera.width)
    return np.asarray(outside_px * in_color[:, 2] / camera.fx > tolerance_mm)


def within_outline(reading: DepthView, outline: Silhouette | None) -> DepthView:
    """Leave out the readings that the colour image shows to lie outside of the foot.

    The sensor compares windows, so the foot's disparity spreads beyond its edge and closes the
    gaps between toes; the colour image has neither fault.

    Parameters
    ----------
    reading
    outline
        None keeps all readings.

    Returns
    -------
    DepthView
    """
    if outline is None:
        return reading
    beside = np.zeros(reading.known.shape, dtype=bool)
    beside[reading.known] = is_beside(reading.surface_points, reading, outline)
    return reading.without(beside)


def _in_color(reading: DepthView, chosen: BoolArray) -> FloatArray:
    points = reading.points(reading.raw)[chosen]
    in_color = transform(inverse(reading.color2reference), points)
    return reading.sensor.color_camera.project(in_color)


def _painted(pixels: FloatArray, shape: tuple[int, int], gap: int) -> ByteArray:
    """Draw positions into an image, the gaps between them closed."""
    image = np.zeros(shape, np.uint8)
    u, v = np.rint(pixels).astype(np.int64).T
    within = (u >= 0) & (u < shape[1]) & (v >= 0) & (v < shape[0])
    image[v[within], u[within]] = 1
    return np.asarray(cv2.morphologyEx(image, cv2.MORPH_CLOSE, np.ones((gap, gap), np.uint8)))


def _likelihood(color: ByteArray, inside: BoolArray, around: BoolArray) -> Float32Array | None:
    """Compute the probability (height, width) of being foot, from the colour alone."""
    if min(inside.sum(), around.sum()) < _LEAST_SAMPLES:
        return None
    lab = rgb2lab(np.asarray(cv2.GaussianBlur(color, (0, 0), 1.0), np.uint8))
    index = np.ravel_multi_index(tuple(np.moveaxis(lab // 8, 2, 0)), (_BINS,) * 3)
    foot, background = _histogram(index[inside]), _histogram(index[around])
    likelihood = (foot / (foot + background + 1e-7)).astype(np.float32)[index]
    wrong = max((likelihood[inside] < 0.5).mean(), (likelihood[around] > 0.5).mean())
    return likelihood if wrong < _LARGEST_ERROR else None


def _histogram(index: IndexArray) -> FloatArray:
    smooth = np.bincount(index, minlength=_BINS**3).astype(float)
    for _ in range(3):  # along each of the three channels in turn
        rows = cv2.GaussianBlur(
            smooth.reshape(_BINS, -1), (1, 9), 1.0, borderType=cv2.BORDER_REFLECT
        )
        smooth = rows.T.ravel()
    return np.asarray(smooth / smooth.sum())


def _largest_filled(mask: ByteArray) -> ByteArray:
    """Keep the largest region, with its holes: pen marks and sores belong to the foot."""
    opened = cv2.morphologyEx(mask, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    outlines, _ = cv2.findContours(opened, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    filled = np.zeros_like(mask)
    if outlines:
        cv2.drawContours(filled, [max(outlines, key=cv2.contourArea)], -1, 1, cv2.FILLED)
    return filled
