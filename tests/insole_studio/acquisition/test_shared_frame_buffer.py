from __future__ import annotations

import multiprocessing
import threading

import numpy as np
import pytest

from insole_studio.acquisition.shared_frame_buffer import SharedFrameBuffer


@pytest.fixture
def board() -> SharedFrameBuffer:
    return SharedFrameBuffer(multiprocessing.get_context("spawn"))


def test_nothing_is_there_at_first(board: SharedFrameBuffer) -> None:
    assert board.read(0, "depth") is None


def test_the_newest_picture_of_each_kind_and_sensor(board: SharedFrameBuffer) -> None:
    depth = np.arange(480 * 640, dtype=np.uint32).reshape(480, 640).astype(np.uint16)
    color = np.random.default_rng(0).integers(0, 255, (240, 320, 3)).astype(np.uint8)
    board.write(2, np.zeros((480, 640), np.uint16))
    board.write(2, depth)
    board.write(2, color)
    board.write(3, color[::-1])
    infrared = color[..., 0]
    board.write(3, infrared)
    found = board.read(2, "depth")
    assert found is not None
    assert found.number == 2
    assert np.array_equal(found.image, depth)
    assert np.array_equal(board.read(2, "color").image, color)  # type: ignore[union-attr]
    assert np.array_equal(board.read(3, "color").image, color[::-1])  # type: ignore[union-attr]
    assert np.array_equal(board.read(3, "infrared").image, infrared)  # type: ignore[union-attr]
    assert board.read(3, "depth") is None
    assert board.read(2, "depth", after=found.number) is None


def test_a_picture_is_never_half_of_another(board: SharedFrameBuffer) -> None:
    stop = threading.Event()

    def write() -> None:
        value = 0
        while not stop.is_set():
            value = (value + 1) % 60_000
            board.write(0, np.full((480, 640), value, np.uint16))

    writer = threading.Thread(target=write)
    writer.start()
    try:
        number = 0
        for _ in range(200):
            found = board.read(0, "depth", after=number)
            if found is not None:
                assert found.image.min() == found.image.max()
                assert found.number > number
                number = found.number
    finally:
        stop.set()
        writer.join()
