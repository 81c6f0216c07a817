"""Colours of vertices, from the numbers of a file or from the picture of a texture."""

from __future__ import annotations

import cv2
import numpy as np

from insole_core.geometry.arrays import ByteArray, FloatArray, IndexArray, IntArray
from insole_core.messages import Message
from insole_core.picture_size import picture_size

MOST_TEXTURE_BYTES = 128 * 2**20
_MOST_PIXELS = 16384 * 8192
NO_COLOR = 128
"""Grey of a vertex whose colour is not known."""
_SEEN_PIXELS = 4096 * 4096  # 0.15 mm of a leg and foot; more than is ever sampled


def colors_of_shares(shares: FloatArray) -> ByteArray:
    """Return colours of shares from 0 to 1, of any shape; what is no number counts as 0."""
    return np.asarray(np.rint(255 * np.clip(np.nan_to_num(shares), 0, 1)), np.uint8)


def colors_of_numbers(numbers: FloatArray) -> ByteArray | None:
    """Return colours of numbers (n, 3) from 0 to 1 or to 255; None where they are others."""
    if not np.isfinite(numbers).all() or numbers.min() < 0 or numbers.max() > 255:
        return None
    return np.rint(numbers * (255.0 if numbers.max() <= 1.0 else 1.0)).astype(np.uint8)


def is_texture(content: bytes) -> bool:
    """Return whether this is a picture of no more pixels than are read."""
    width, height = picture_size(content) or (0, 0)
    return 0 < width * height <= _MOST_PIXELS


def decode_texture(content: bytes) -> ByteArray | None:
    """Decode a picture (h, w, 3) uint8, RGB; None for what is none, or far too large.

    Large ones are decoded at half, a quarter or an eighth of their size.
    """
    size = picture_size(content)
    if size is None or not is_texture(content):
        return None
    reduction = next((n for n in (1, 2, 4, 8) if size[0] * size[1] <= _SEEN_PIXELS * n * n), 8)
    flags = {
        1: cv2.IMREAD_COLOR, 2: cv2.IMREAD_REDUCED_COLOR_2,
        4: cv2.IMREAD_REDUCED_COLOR_4, 8: cv2.IMREAD_REDUCED_COLOR_8,
    }  # fmt: skip
    try:
        picture = cv2.imdecode(np.frombuffer(content, np.uint8), flags[reduction])
    except cv2.error:
        return None
    return None if picture is None else np.ascontiguousarray(picture[..., ::-1])


def missing_texture(name: str) -> Message:
    """Return the sentence for a texture that is not there."""
    return Message(
        "The texture {picture} is not beside the scan or cannot be read; the scan has no colours "
        "there.",
        picture=name[:80],
    )


def sampled(picture: ByteArray, uv: FloatArray) -> ByteArray:
    """Return the colours (n, 3) of a picture at texture coordinates.

    Parameters
    ----------
    uv : (n, 2)
        0 to 1, from the left and the lower edge; the texture repeats beyond.
    """
    height, width = picture.shape[:2]
    repeated = np.where(np.isfinite(uv), uv, 0.0)
    repeated = np.where((repeated < 0) | (repeated > 1), repeated % 1.0, repeated)
    column = np.minimum((repeated[:, 0] * width).astype(np.int32), width - 1)
    row = np.minimum(((1.0 - repeated[:, 1]) * height).astype(np.int32), height - 1)
    return np.asarray(picture[row, column])


def mean_colors(vertex: IntArray | IndexArray, colors: ByteArray, count: int) -> ByteArray:
    """Average the colours (n, 3) of corners over the vertices (n,) in which they lie: (count, 3).

    A vertex without corner is grey.
    """
    corners = np.bincount(vertex, minlength=count)
    sums = [np.bincount(vertex, channel, minlength=count) for channel in colors.T]
    mean = np.column_stack(sums) / np.maximum(corners, 1)[:, None]
    mean[corners == 0] = NO_COLOR
    return np.rint(mean).astype(np.uint8)
