"""The dot pattern of a projector, and the reference image of it that the sensor stores."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.recording.sensor_json import DEPTH_SIZE
from insole_core.sensing.disparity import NO_READING

RAW_PER_PX = 8
"""Raw values are eighths of a pixel of disparity (Konolige & Mihelich)."""
BLUR_PX = 0.5
"""Standard deviation of the infrared camera's blur."""
_PX_PER_DOT = 9.0
_DOT_SIGMA_PX = 0.45
_JITTER = 0.98
_ACROSS, _DOWN = RAW_PER_PX, 4
"""Texels per pixel: horizontally one per raw unit, so that references need no resampling."""
_WIDTH, _HEIGHT = DEPTH_SIZE
_ALL_ROWS = slice(0, _HEIGHT)
_SPREAD_PX = 6
"""Largest distance of a row in which a dot is visible."""


@dataclass(frozen=True, eq=False)
class DotPattern:
    """The dots of one projector: uniformly random, one per nine pixels.

    A surface at the raw value r shows at pixel (u, v) the pattern at (u + r / 8, v).

    Parameters
    ----------
    texture : (height * 4, (640 + 256) * 8) float32, about 1 on average
        Some rows of the pattern.
    rows
        Rows of the depth image that the texture covers.
    """

    texture: Float32Array
    rows: slice

    @staticmethod
    def draw(rng: np.random.Generator, rows: slice = _ALL_ROWS) -> DotPattern:
        """Draw the pattern of a device.

        Parameters
        ----------
        rng
        rows
            Rows of the depth image that are needed, without those whose dots blur into them.

        Returns
        -------
        DotPattern
            Of the needed rows with a margin.
        """
        width_px, step_px = _WIDTH + (NO_READING + 1) // RAW_PER_PX, np.sqrt(_PX_PER_DOT)
        nodes = np.meshgrid(np.arange(0, width_px, step_px), np.arange(0, _HEIGHT, step_px))
        u, v = (node + rng.uniform(-0.5, 0.5, node.shape) * step_px * _JITTER for node in nodes)
        part = slice(max(rows.start - _SPREAD_PX, 0), min(rows.stop + _SPREAD_PX, _HEIGHT))
        texture = np.zeros(((part.stop - part.start) * _DOWN, width_px * _ACROSS), np.float32)
        column = np.rint(u * _ACROSS).astype(int)
        row = np.rint(v * _DOWN).astype(int) - part.start * _DOWN
        shown = (column >= 0) & (column < texture.shape[1]) & (row >= 0) & (row < len(texture))
        np.add.at(texture, (row[shown], column[shown]), _PX_PER_DOT * _ACROSS * _DOWN)
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
        across = np.clip(u * _ACROSS + raw, 0, self.texture.shape[1] - 2)
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


def _blurred(texture: Float32Array, sigma_px: float) -> Float32Array:
    across, down = sigma_px * _ACROSS, sigma_px * _DOWN
    return np.asarray(cv2.GaussianBlur(texture, (0, 0), sigmaX=across, sigmaY=down))


def _box(size: int) -> FloatArray:
    """Return the kernel of the mean over `size` texels, centred: half a texel at either end."""
    kernel = np.full(size + 1, 1 / size)
    kernel[[0, -1]] /= 2
    return kernel
