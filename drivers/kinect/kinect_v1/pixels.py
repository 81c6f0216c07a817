"""Conversion between packed bits and images."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from kinect_v1.modes import PixelFormat, StreamMode

ByteArray = NDArray[np.uint8]
RawArray = NDArray[np.uint16]

NO_READING = 2047
"""The 11-bit depth value for "no reading"."""


def unpack(packed: ByteArray, bits: int) -> RawArray:
    """Unpack numbers of `bits` (9 to 16) bits each, most significant bit first.

    Eight pixels fill `bits` bytes, and lie in the first and the last eight of these.

    Parameters
    ----------
    packed : (8 n / bits,) uint8, contiguous

    Returns
    -------
    (n,) uint16
    """
    groups = len(packed) // bits
    ends = [
        np.ndarray((groups,), ">u8", packed, offset, (bits,)).astype(np.uint64)
        for offset in (0, bits - 8)
    ]
    pixels = np.empty((groups, 8), np.uint16)
    mask = np.uint64((1 << bits) - 1)
    for i in range(8):
        stop = bits * (i + 1)
        word, shift = (ends[0], 64 - stop) if stop <= 64 else (ends[1], 8 * bits - stop)
        pixels[:, i] = (word >> np.uint64(shift)) & mask
    return pixels.reshape(-1)


def pack(pixels: RawArray, bits: int) -> ByteArray:
    """Pack an image; the inverse of `unpack`.

    Parameters
    ----------
    bits
        Bits per pixel, 9 to 16.

    Returns
    -------
    (n bits / 8,) uint8
    """
    groups = pixels.astype(np.uint64).reshape(-1, 8) & np.uint64((1 << bits) - 1)
    packed = np.empty(len(groups) * bits, np.uint8)
    # Eight pixels fill `bits` bytes: two words of eight, from the first and up to the last of them.
    for first_bit in (0, 8 * bits - 64):
        word = np.zeros(len(groups), np.uint64)
        for i in range(8):
            shift = first_bit + 64 - bits * (i + 1)
            if 0 <= shift < 64:
                word |= groups[:, i] << np.uint64(shift)
            elif -bits < shift < 0:
                word |= groups[:, i] >> np.uint64(-shift)
        np.ndarray(word.shape, ">u8", packed, first_bit // 8, (bits,))[:] = word
    return packed


def decode_image(data: ByteArray, mode: StreamMode) -> ByteArray | RawArray:
    """Return the image of a packed frame: (height, width), uint8 Bayer mosaic or uint16.

    Parameters
    ----------
    data : (mode.frame_bytes,) uint8
    """
    shape = (mode.height, mode.width)
    if mode.pixels is PixelFormat.BAYER:
        return data.reshape(shape)
    return unpack(data, mode.bits).reshape(shape)


def encode_image(image: ByteArray | RawArray, mode: StreamMode) -> bytes:
    """Return the packed frame of an image; the inverse of `decode_image`.

    Parameters
    ----------
    image : (height, width)
        uint8 Bayer mosaic or uint16.
    """
    if image.shape != (mode.height, mode.width):
        raise ValueError(f"{mode.name} needs {mode.width} x {mode.height} px, not {image.shape}")
    if mode.pixels is PixelFormat.BAYER:
        return image.astype(np.uint8).tobytes()
    return pack(image.astype(np.uint16), mode.bits).tobytes()


def demosaic(mosaic: ByteArray) -> ByteArray:
    """Interpolate the colours of a Bayer mosaic whose rows are G R G R..., B G B G...

    Parameters
    ----------
    mosaic : (height, width) uint8

    Returns
    -------
    (height, width, 3) uint8, RGB
    """
    return np.asarray(cv2.cvtColor(mosaic, cv2.COLOR_BayerGRBG2RGB), np.uint8)


def mosaic(rgb: ByteArray) -> ByteArray:
    """Return the Bayer mosaic of an RGB image (height, width, 3): one colour per pixel."""
    one = np.array(rgb[..., 1])
    one[0::2, 1::2] = rgb[0::2, 1::2, 0]
    one[1::2, 0::2] = rgb[1::2, 0::2, 2]
    return one
