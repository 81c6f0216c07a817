"""Pictures and factory values that tell every frame, pixel and sensor apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kinect_v1.calibration import Calibration, Padding, RegistrationInfo, ZeroPlane
from kinect_v1.modes import PixelFormat, StreamMode

Images = dict[str, dict[str, list[NDArray[Any]]]]
"""Pictures by serial number and mode."""
Footage = dict[str, dict[str, list[bytes]]]
"""The same, packed as the sensors send them."""

SERIALS = ("A00362A00127049A", "A00364817648045A", "B00366600698045B")
FRAMES = 3
SPEED = 10.0
"""Of the emulated sensors' time: tests need not wait."""

MOST = {"depth": "depth-11", "video": "bayer-1280x1024"}
"""The modes that send the most."""


def in_turn(modes: Sequence[dict[str, str]]) -> list[dict[str, dict[str, str]]]:
    """Modes of each sensor, turn by turn: different ones at once, and all on each in the end."""
    return [
        {serial: modes[(turn + i) % len(modes)] for i, serial in enumerate(SERIALS)}
        for turn in range(len(modes))
    ]


def make_image(mode: StreamMode, seed: int) -> NDArray[Any]:
    """Noise of the mode's full range."""
    generator = np.random.default_rng(seed)
    kind = np.uint8 if mode.pixels is PixelFormat.BAYER else np.uint16
    return generator.integers(0, 1 << mode.bits, (mode.height, mode.width), kind)


def make_calibration(seed: int) -> Calibration:
    """Plausible factory values, different for every sensor."""
    generator = np.random.default_rng(seed)

    def near(value: float, spread: float) -> float:
        return float(np.float32(value * (1 + spread * generator.uniform(-1, 1))))

    def number(bits: int) -> int:
        return int(generator.integers(-(1 << bits), 1 << bits))

    sizes = {"x_start": 15, "y_start": 15, "dxdx_start": 12, "dydy_start": 12}
    registration = {
        field.name: number(sizes.get(field.name[1:], sizes.get(field.name, 8)))
        for field in fields(RegistrationInfo)
    }
    return Calibration(
        ZeroPlane(near(7.5, 0.05), 2.3, near(120.0, 0.05), near(0.1042, 0.05)),
        RegistrationInfo(**registration),
        Padding(0, 0, 0),
        int(generator.integers(190, 211)),
    )
