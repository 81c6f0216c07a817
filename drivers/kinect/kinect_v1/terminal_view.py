"""Pictures in a terminal, two pixels per character; needs no window and works over a network."""

from __future__ import annotations

import cv2
import numpy as np

from kinect_v1.modes import PixelFormat
from kinect_v1.pixels import NO_READING, ByteArray, demosaic
from kinect_v1.streams import Frame

HOME = "\x1b[H"
CLEAR = "\x1b[2J"
_RESET = "\x1b[0m"
_NEAREST, _FARTHEST = 400, 1050


def color_picture(frame: Frame) -> ByteArray:
    """Return any frame in colour: near depth red, far depth blue, no reading black."""
    if frame.mode.pixels is PixelFormat.BAYER:
        return demosaic(frame.image)
    if frame.mode.pixels is PixelFormat.IR:
        grey = (frame.image >> 2).astype(np.uint8)
        return np.repeat(grey[..., None], 3, axis=2)
    near = np.clip((_FARTHEST - frame.image.astype(float)) / (_FARTHEST - _NEAREST), 0, 1)
    colored = cv2.applyColorMap((near * 255).astype(np.uint8), cv2.COLORMAP_TURBO)[..., ::-1]
    return np.asarray(np.where((frame.image < NO_READING)[..., None], colored, 0), np.uint8)


def render(picture: ByteArray, columns: int, lines: int) -> str:
    """Draw an RGB picture with half blocks, as large as fits.

    Parameters
    ----------
    picture : (height, width, 3) uint8, RGB
    columns, lines
        Size of the terminal.

    Returns
    -------
    str
        Lines with ANSI colour codes.
    """
    height, width = picture.shape[:2]
    scale = min(columns / width, 2 * lines / height)
    size = (max(1, int(width * scale)), max(2, int(height * scale) // 2 * 2))
    small = np.asarray(cv2.resize(picture, size, interpolation=cv2.INTER_AREA))
    rows = [
        "".join(
            f"\x1b[38;2;{a[0]};{a[1]};{a[2]};48;2;{b[0]};{b[1]};{b[2]}m▀"
            for a, b in zip(upper, lower, strict=True)
        )
        + _RESET
        for upper, lower in zip(small[::2].tolist(), small[1::2].tolist(), strict=True)
    ]
    return "\n".join(rows)


def beside(left: str, right: str) -> str:
    """Put two drawings next to each other.

    Parameters
    ----------
    left, right
        Drawings by `render`.
    """
    pairs = zip(left.split("\n"), right.split("\n"), strict=False)
    return "\n".join(f"{one} {other}" for one, other in pairs)
