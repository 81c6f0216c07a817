"""Pictures that somebody puts into a folder: decoded only when they are as small as a sensor's."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import cv2
import numpy as np
import pytest

from insole_core.errors import InputError
from insole_core.recording.images import read_picture

PICTURE = np.random.default_rng(1).integers(0, 255, (480, 640, 3)).astype(np.uint8)


@pytest.mark.parametrize("suffix", [".png", ".jpg", ".bmp", ".tif"])
def test_usual_pictures_are_read(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"color_000{suffix}"
    cv2.imwrite(str(path), PICTURE)
    read = read_picture(path, cv2.IMREAD_COLOR)
    assert read is not None
    assert read.shape == PICTURE.shape


def png_header(width: int, height: int) -> bytes:
    body = b"IHDR" + struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + body + struct.pack(">I", zlib.crc32(body))


@pytest.mark.parametrize("size", [(6000, 6000), (60_000, 60_000), (20_000, 1), (0, 5)])
def test_pictures_that_fill_the_memory_are_refused(tmp_path: Path, size: tuple[int, int]) -> None:
    path = tmp_path / "color_000.png"
    path.write_bytes(png_header(*size))
    with pytest.raises(InputError, match=f"is {size[0]}×{size[1]}, far larger than the pictures"):
        read_picture(path, cv2.IMREAD_COLOR)


@pytest.mark.parametrize(
    "start", [b"", b"GIF89a", b"\xff\xd8\xff", b"II*\0\xff\xff\xff\xff", b"BM"]
)
def test_no_pictures_are_none(tmp_path: Path, start: bytes) -> None:
    path = tmp_path / "color_000.png"
    path.write_bytes(start)
    assert read_picture(path, cv2.IMREAD_COLOR) is None
