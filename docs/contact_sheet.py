"""Puts pictures on one sheet, to look at them together."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PIL import Image, ImageDraw

COLUMNS, GAP_PX, CAPTION_PX = 3, 8, 16
WIDTH_PX = 640
"""Of one picture on the sheet."""


def write_sheet(pictures: Sequence[Path], path: Path) -> None:
    """Write pictures in rows, each with its name."""
    small = [_scaled(picture) for picture in pictures]
    tall = max(image.height for image in small) + CAPTION_PX + GAP_PX
    rows = -(-len(small) // COLUMNS)
    sheet = Image.new("RGB", (COLUMNS * (WIDTH_PX + GAP_PX), rows * tall), "white")
    draw = ImageDraw.Draw(sheet)
    for number, (image, picture) in enumerate(zip(small, pictures, strict=True)):
        x, y = number % COLUMNS * (WIDTH_PX + GAP_PX), number // COLUMNS * tall
        draw.text((x, y), picture.stem, fill="black")
        sheet.paste(image, (x, y + CAPTION_PX))
    sheet.save(path)


def _scaled(picture: Path) -> Image.Image:
    image = Image.open(picture).convert("RGB")
    return image.resize(
        (WIDTH_PX, round(image.height * WIDTH_PX / image.width)), Image.Resampling.LANCZOS
    )
