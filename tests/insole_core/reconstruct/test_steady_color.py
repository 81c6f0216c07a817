from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.reconstruct.views.coloring import steady_color
from insole_core.recording.session import View
from insole_core.sensing.disparity import NO_READING
from insole_core.simulate.device import make_device


def recorded(levels: list[int]) -> View:
    """A view with colour frames that are each of one level."""
    device = make_device("S", ("sole",), 800.0, (640, 480), np.random.default_rng(0))

    def read_depth(_: int) -> RawArray:
        return np.full((480, 640), NO_READING, dtype=np.uint16)

    def read_color(index: int) -> ByteArray:
        return np.full((480, 640, 3), levels[index], dtype=np.uint8)

    return View("left", device.sensor, 1, len(levels), read_depth, read_color)


@pytest.mark.parametrize(
    ("levels", "expected"),
    [
        ([7], 7),
        ([7, 10], 8),
        ([100, 255, 100], 100),
        ([100, 255, 100, 100], 100),
        ([255, 255, 255, *[100] * 7], 100),  # a hand at the beginning
        ([*[100] * 5, 0, 0, 0, *[100] * 2], 100),  # in the middle
        ([*[100] * 7, 0, 0, 255], 100),  # at the end
        ([*range(90, 99)], 94),
    ],
)
def test_what_passes_by_leaves_no_trace(levels: list[int], expected: int) -> None:
    assert set(steady_color(recorded(levels)).ravel().tolist()) == {expected}
