"""The picture of a photo as it is stored and handed out."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Final

import cv2
from PIL import Image

from insole_core.errors import InputError
from insole_core.pressure.picture import MOST_PIXELS, read_picture_file

MOST_PX: Final = 2400
"""Greatest width and height of a stored photo."""
_QUALITY: Final = 88


def photo_jpeg(path: Path) -> bytes:
    """Return a picture of a file as it is stored: upright, not too large, and nothing but pixels.

    Raises
    ------
    InputError
        When it is no PNG, JPEG or TIFF, damaged, or far larger than cameras make them.
    """
    too_large = InputError(
        "{path} has more than {most} million pixels; take the photo with fewer, or save it "
        "smaller.",
        path=path,
        most=MOST_PIXELS // 1_000_000,
    )
    colors = read_picture_file(path, too_large).colors
    height, width = colors.shape[:2]
    shrunk = MOST_PX / max(height, width)
    if shrunk < 1.0:
        size = max(round(width * shrunk), 1), max(round(height * shrunk), 1)
        colors = cv2.resize(colors, size, interpolation=cv2.INTER_AREA)
    return jpeg_of(Image.fromarray(colors))


def jpeg_of(image: Image.Image) -> bytes:
    """Return an image as JPEG, nothing but pixels."""
    written = io.BytesIO()
    image.save(written, "JPEG", quality=_QUALITY)
    return written.getvalue()
