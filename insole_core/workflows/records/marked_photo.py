"""A photo with its marks drawn on it, for whoever has not this program."""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Final

from PIL import Image, ImageDraw, ImageFont

from insole_core.records.photo import PhotoMark
from insole_core.records.photo_picture import jpeg_of

COLOR: Final = "#ff5f00"
"""Stands out from skin, and from the red and green of the sides."""
_LINE, _TEXT = 1 / 250, 1 / 32
"""Width of a line, and height of a number, as parts of the longer side."""


def with_marks(picture: bytes, marks: Sequence[PhotoMark]) -> bytes:
    """Return a JPEG with lines and places drawn on it, each with its number from 1."""
    with Image.open(io.BytesIO(picture), formats=("JPEG",)) as read:
        image = read.convert("RGB")
    drawn = ImageDraw.Draw(image)
    longest = max(image.size)
    width, font = max(round(longest * _LINE), 1), ImageFont.load_default(longest * _TEXT)
    for number, mark in enumerate(marks, start=1):
        points = [(x * image.width, y * image.height) for x, y in mark.points]
        x, y = points[0]
        if len(points) > 1:
            drawn.line(points, fill=COLOR, width=width, joint="curve")
        else:
            drawn.circle((x, y), 3 * width, outline=COLOR, width=width)
        place = (x + 4 * width, y)
        drawn.text(place, str(number), fill=COLOR, font=font, stroke_width=1, stroke_fill="white")
    return jpeg_of(image)
