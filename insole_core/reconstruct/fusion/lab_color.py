"""Colours in CIE L*a*b*, with 8 bits each, as OpenCV computes them.

OpenCV fills its tables when it converts the first colour, in software floating point, which takes
0.1 s: a fifteenth of a whole `reconstruct`. The few that are needed here take 0.001 s. They hold
correctly rounded numbers, so that one colour of 10 000 differs from OpenCV's, by one.
"""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import ByteArray, Float32Array, IndexArray

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
