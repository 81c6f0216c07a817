"""Packed bits, Bayer mosaics."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kinect_v1.modes import BAYER_640, DEPTH_11
from kinect_v1.pixels import decode_image, demosaic, encode_image, mosaic, pack, unpack


def test_eleven_bits_most_significant_first() -> None:
    packed = np.array([0b10000000, 0b00111111, 0b11111000, *[0] * 8], np.uint8)
    assert unpack(packed, 11).tolist() == [0b10000000001, 0b11111111110, 0, 0, 0, 0, 0, 0]


def test_ten_bits_most_significant_first() -> None:
    packed = np.array([0xFF, 0xC0, 0x30, 0x00, 0x01, *[0] * 5], np.uint8)
    assert unpack(packed, 10).tolist() == [0x3FF, 3, 0, 1, 0, 0, 0, 0]


@given(st.sampled_from([10, 11]), st.integers(1, 40), st.integers(0, 2**32))
def test_unpacking_equals_reading_the_bit_stream(bits: int, groups: int, seed: int) -> None:
    packed = np.random.default_rng(seed).integers(0, 256, groups * bits, np.uint8)
    stream = int.from_bytes(packed.tobytes(), "big")
    count = 8 * groups
    expected = [stream >> bits * (count - 1 - i) & (1 << bits) - 1 for i in range(count)]
    pixels = unpack(packed, bits)
    assert pixels.tolist() == expected
    assert np.array_equal(pack(pixels, bits), packed)


def test_demosaicing_keeps_red_red_and_blue_blue() -> None:
    for channel in range(3):
        picture = np.full((16, 16, 3), 10, np.uint8)
        picture[..., channel] = 200
        inner = demosaic(mosaic(picture))[4:-4, 4:-4]
        assert np.array_equal(inner, picture[4:-4, 4:-4])


def test_the_mosaic_begins_with_green_red() -> None:
    picture = np.zeros((4, 4, 3), np.uint8)
    picture[:] = (1, 2, 3)
    assert mosaic(picture)[:2, :2].tolist() == [[2, 1], [3, 2]]


def test_images_survive_the_wire() -> None:
    generator = np.random.default_rng(5)
    for mode in (DEPTH_11, BAYER_640):
        kind = np.uint8 if mode.bits == 8 else np.uint16
        image = generator.integers(0, 1 << mode.bits, (480, 640), kind)
        data = np.frombuffer(encode_image(image, mode), np.uint8)
        assert len(data) == mode.frame_bytes
        assert np.array_equal(decode_image(data, mode), image)


def test_an_image_of_the_wrong_size_is_refused() -> None:
    with pytest.raises(ValueError, match="640 x 480"):
        encode_image(np.zeros((480, 639), np.uint16), DEPTH_11)
