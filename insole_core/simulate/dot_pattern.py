"""The dot pattern of a projector, and the reference image of it that the sensor stores."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import cv2
import numpy as np

from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.recording.sensor_folder import DEPTH_SIZE
from insole_core.resources import resource_path
from insole_core.sensing.disparity import NO_READING

RAW_PER_PX = 8
"""Raw values are eighths of a pixel of disparity (Konolige & Mihelich)."""
BLUR_PX = 0.5
"""Standard deviation of the infrared camera's blur."""
_DOTS = "dot_pattern/dots.npz"
_PICTURE_WIDTH, _PICTURE_HEIGHT = 640, 512
"""Size of the picture in which the dots were found, in pixels of the depth image."""
_FULL_WIDTH = 608
"""Columns of it in which the dots were found. A strip without any, wider than the matching window,
is a strip in which nothing is read: of an unlucky foot a third."""
_SLACK_PX = 12.0
"""By which the patterns of two devices differ in height at most."""
_DOT_SIGMA_PX = 0.45
_ACROSS, _DOWN = RAW_PER_PX, 4
"""Texels per pixel: horizontally one per raw unit, so that references need no resampling."""
_WIDTH, _HEIGHT = DEPTH_SIZE
_ALL_ROWS = slice(0, _HEIGHT)
_SPREAD_PX = 6
"""Largest distance of a row in which a dot is visible."""


@dataclass(frozen=True, eq=False)
class DotPattern:
    """The dots of one projector; those of real sensors are differently aligned in every device.

    A surface at the raw value r shows at pixel (u, v) the pattern at (u + r / 8, v). Beyond the
    picture of the real dots the pattern begins anew.

    Parameters
    ----------
    texture : (height * 4, (640 + 256) * 8) float32, about 1 on average
        Some rows of the pattern.
    rows
        Rows of the depth image that the texture covers.
    drift_raw
        By which the projector throws the dots elsewhere than when the pattern was drawn.
    """

    texture: Float32Array
    rows: slice
    drift_raw: float = 0.0

    @staticmethod
    def draw(
        rng: np.random.Generator, rows: slice = _ALL_ROWS, *, px_per_dot: float | None = None
    ) -> DotPattern:
        """Draw the pattern of a device.

        Parameters
        ----------
        rng
        rows
            Rows of the depth image that are needed, without those whose dots blur into them.
        px_per_dot
            None takes the real dots; else dots are drawn at random, each from so many pixels.

        Returns
        -------
        DotPattern
            Of the needed rows with a margin.
        """
        width_px = _WIDTH + (NO_READING + 1) // RAW_PER_PX
        part = slice(max(rows.start - _SPREAD_PX, 0), min(rows.stop + _SPREAD_PX, _HEIGHT))
        texture = np.zeros(((part.stop - part.start) * _DOWN, width_px * _ACROSS), np.float32)
        if px_per_dot is None:
            dots = _aligned(_real_dots(), rng)
            px_per_dot = _PICTURE_WIDTH * _PICTURE_HEIGHT / len(_real_dots())
        else:
            dots = _random_dots(px_per_dot, width_px, rng)
        u, v = dots.T
        column = np.rint(u * _ACROSS).astype(int)
        row = np.rint(v * _DOWN).astype(int) - part.start * _DOWN
        shown = (column >= 0) & (column < texture.shape[1]) & (row >= 0) & (row < len(texture))
        np.add.at(texture, (row[shown], column[shown]), px_per_dot * _ACROSS * _DOWN)
        return DotPattern(_blurred(texture, _DOT_SIGMA_PX), part)

    def brightness(self, u: FloatArray, v: FloatArray, raw: FloatArray) -> Float32Array:
        """Look up the brightness of the pattern on surfaces.

        Parameters
        ----------
        u, v : (n,) float64, px
            Positions in the depth image.
        raw : (n,) float64, raw units
            Of the surfaces there.

        Returns
        -------
        (n,) float32, about 1 on average
        """
        across = np.clip(u * _ACROSS + raw + self.drift_raw, 0, self.texture.shape[1] - 2)
        row = np.rint(v * _DOWN).astype(int) - self.rows.start * _DOWN
        row = np.clip(row, 0, len(self.texture) - 1)
        column = across.astype(int)
        share = (across - column).astype(np.float32)
        return np.asarray(
            self.texture[row, column] * (1 - share) + self.texture[row, column + 1] * share
        )

    def seen(self, rows: slice = _ALL_ROWS) -> Float32Array:
        """Return rows of the pattern as the camera sees it, (height, (640 + 256) * 8)."""
        across, down = _box(_ACROSS), _box(_DOWN)
        image = cv2.sepFilter2D(self.texture, -1, across, down, borderType=cv2.BORDER_REFLECT)
        whole = _blurred(np.asarray(image), BLUR_PX)[::_DOWN]
        return whole[rows.start - self.rows.start : rows.stop - self.rows.start]


@cache
def _real_dots() -> FloatArray:
    """Read the places (n, 2) of the dots in their picture, px of the depth image."""
    with np.load(resource_path(_DOTS)) as stored:
        return np.asarray(stored["dots_px"], float)


def _aligned(dots: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Return the dots (n, 2) as they lie in a device, several times side by side.

    In place of the last columns of their picture stand the first ones again.
    """
    again = dots[dots[:, 0] < _PICTURE_WIDTH - _FULL_WIDTH] + [_FULL_WIDTH, 0.0]
    dots = np.concatenate([dots[dots[:, 0] < _FULL_WIDTH], again])
    middle = (_PICTURE_HEIGHT - _HEIGHT) / 2
    shift = np.array([rng.uniform(0, _PICTURE_WIDTH), rng.uniform(-_SLACK_PX, _SLACK_PX) - middle])
    copies = [dots + shift + [turn * _PICTURE_WIDTH, 0] for turn in (-1, 0, 1)]
    return np.concatenate(copies)


def _random_dots(px_per_dot: float, width_px: int, rng: np.random.Generator) -> FloatArray:
    """Draw the places (n, 2) of dots: one at random in every square of a lattice."""
    step_px = np.sqrt(px_per_dot)
    squares = np.meshgrid(np.arange(0, width_px, step_px), np.arange(0, _HEIGHT, step_px))
    places = [square + rng.uniform(0, step_px, square.shape) for square in squares]
    return np.column_stack([place.ravel() for place in places])


def _blurred(texture: Float32Array, sigma_px: float) -> Float32Array:
    across, down = sigma_px * _ACROSS, sigma_px * _DOWN
    return np.asarray(cv2.GaussianBlur(texture, (0, 0), sigmaX=across, sigmaY=down))


def _box(size: int) -> FloatArray:
    """Return the kernel of the mean over `size` texels, centred: half a texel at either end."""
    kernel = np.full(size + 1, 1 / size)
    kernel[[0, -1]] /= 2
    return kernel
