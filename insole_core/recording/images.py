"""Encoding, validation and decoding of the image files of a session."""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from insole_core.errors import InputError
from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.given_file import read_given
from insole_core.messages import joined
from insole_core.picture_size import picture_size
from insole_core.sensing.disparity import NO_READING

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
MAX_PICTURE_BYTES = 64 * 2**20
MAX_PIXELS, MAX_SIDE = 4 * 2**20, 4096
"""Three times the largest picture of a Kinect; finding a board takes 200 bytes for each."""
_QUICK = (cv2.IMWRITE_PNG_STRATEGY, cv2.IMWRITE_PNG_STRATEGY_RLE)
"""Against zlib's level 6 in an eighth of the time; colour gets smaller, depth a third larger."""
_KINDS = {0: "grey", 2: "RGB", 3: "palette", 4: "grey with alpha", 6: "RGB with alpha"}


@dataclass(frozen=True)
class PngKind:
    """Properties that a PNG file must have.

    Parameters
    ----------
    width, height
        px.
    bits
        Per channel.
    color_type
        As in the IHDR chunk, such as 0 for grey and 2 for RGB.
    """

    width: int
    height: int
    bits: int
    color_type: int

    def __str__(self) -> str:
        kind = _KINDS.get(self.color_type, f"kind {self.color_type}")
        return f"{self.width}×{self.height} {self.bits}-bit {kind}"


def check_png(name: str, content: bytes, *expected: PngKind) -> None:
    """Check that a PNG is complete and of one of the expected kinds, without decoding it.

    OpenCV silently fills the missing part of a truncated image with black, so the chunks and their
    checksums are checked here.

    Parameters
    ----------
    name
        Of the file, for messages.

    Raises
    ------
    InputError
        When it is not a PNG, damaged, or of another kind.
    """
    if not content.startswith(_SIGNATURE):
        raise InputError("{name} is not a PNG image; restore it from the recording.", name=name)
    damaged = InputError(
        "{name} is truncated or damaged; restore it from the recording.", name=name
    )
    position, kind = len(_SIGNATURE), b""
    while kind != b"IEND":
        if position + 12 > len(content):
            raise damaged
        length, kind = struct.unpack_from(">I4s", content, position)
        end = position + 12 + length
        if end > len(content):
            raise damaged
        body = memoryview(content)[position + 4 : end - 4]
        if zlib.crc32(body) != struct.unpack_from(">I", content, end - 4)[0]:
            raise damaged
        if kind == b"IHDR":
            found = PngKind(*struct.unpack_from(">IIBB", content, position + 8))
            if found not in expected:
                raise InputError(
                    "{name} is {found}, but must be {expected}.",
                    name=name,
                    found=str(found),
                    expected=joined(map(str, expected), " or "),
                )
        position = end


def decode_depth(name: str, content: bytes) -> RawArray:
    """Decode a depth frame of a Kinect.

    Parameters
    ----------
    name
        Of the file, for messages.

    Returns
    -------
    (height, width) uint16, raw, 2047 = no reading

    Raises
    ------
    InputError
        When it cannot be decoded, or holds numbers that the sensor cannot send.
    """
    image = decode_grey(name, content)
    if image.max() > NO_READING:
        raise InputError(
            "{picture} holds the number {number}, but the sensor's raw numbers end at {greatest}; "
            "it is no raw depth frame.",
            picture=name,
            number=image.max(),
            greatest=NO_READING,
        )
    return image


def decode_grey(name: str, content: bytes) -> RawArray:
    """Decode a grey picture of 8 or 16 bits, such as depth in a unit of its own, or infrared.

    Parameters
    ----------
    name
        Of the file, for messages.

    Returns
    -------
    (height, width) uint16

    Raises
    ------
    InputError
        When it cannot be decoded.
    """
    return _decode(name, content, cv2.IMREAD_UNCHANGED).astype(np.uint16, copy=False)


def decode_color(name: str, content: bytes) -> ByteArray:
    """Decode a colour frame.

    Parameters
    ----------
    name
        Of the file, for messages.

    Returns
    -------
    (height, width, 3) uint8, RGB

    Raises
    ------
    InputError
        When it cannot be decoded.
    """
    return _decode(name, content, cv2.IMREAD_COLOR_RGB).astype(np.uint8, copy=False)


def read_picture(path: Path, flags: int) -> npt.NDArray[Any] | None:
    """Decode a picture that somebody put into a folder, as `cv2.imread` does.

    Returns
    -------
    array or None
        None where there is no picture, or a damaged one.

    Raises
    ------
    InputError
        When it cannot be read, or is far larger than what a sensor sends.
    """
    if not path.exists():
        return None
    content = read_given(path, MAX_PICTURE_BYTES)
    size = picture_size(content)
    if size is None:
        return None
    width, height = size
    if not (0 < width * height <= MAX_PIXELS and max(size) <= MAX_SIDE):
        raise InputError(
            "{path} is {width}×{height}, far larger than the pictures of a sensor; put in the "
            "pictures as it sends them.",
            path=path,
            width=width,
            height=height,
        )
    image = cv2.imdecode(np.frombuffer(content, np.uint8), flags)
    return None if image is None else np.asarray(image)


def encode_png(image: RawArray | ByteArray) -> bytes:
    """Encode a depth frame (h, w) uint16, or a colour frame (h, w, 3) uint8, RGB, as PNG."""
    stored = image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_RGB2BGR)
    return bytes(cv2.imencode(".png", stored, _QUICK)[1])


def _decode(name: str, content: bytes, flags: int) -> RawArray | ByteArray:
    image = cv2.imdecode(np.frombuffer(content, np.uint8), flags)
    if image is None:
        raise InputError("{name} cannot be decoded; restore it from the recording.", name=name)
    return np.asarray(image)
