"""Emulated RealSense cameras that see a small, noisy foot, each with pictures of its own."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

pytest.importorskip("pyrealsense2", reason="pyrealsense2, the library of the cameras, is missing")

from realsense_d400.camera import Calibration, Intrinsics
from realsense_d400.emulation import EmulatedCamera

WIDTH, HEIGHT = 160, 96
NO_LENS = (0.0, 0.0, 0.0, 0.0, 0.0)
DEPTH = Intrinsics(WIDTH, HEIGHT, 115.0, 115.0, 79.5, 45.25, NO_LENS, inverse=False)
COLOR = Intrinsics(192, 108, 140.0, 141.0, 95.5, 54.0, NO_LENS, inverse=True)
TURN = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
CALIBRATION = Calibration(DEPTH, COLOR, TURN, np.array([-15.0, 0.25, 0.5]), 0.1, 55.0)
FRAMES = 6


def camera(serial: str, **options: Any) -> EmulatedCamera:
    """Return a camera; those with other serial numbers see other pictures."""
    rng = np.random.default_rng(sum(serial.encode()))
    rows, columns = np.mgrid[:HEIGHT, :WIDTH]
    away = ((rows - HEIGHT / 2) / 30) ** 2 + ((columns - WIDTH / 2) / 60) ** 2
    scene = np.where(away < 1, 5200 - 300 * np.sqrt(np.clip(1 - away, 0, 1)), 6100)
    scene[:, :10] = 0
    noise = rng.integers(-3, 4, (FRAMES, *scene.shape))
    depth = [np.where(scene > 0, scene + one, 0).astype(np.uint16) for one in noise]
    color = [rng.integers(60, 180, (108, 192, 3)).astype(np.uint8) for _ in range(FRAMES // 2)]
    return EmulatedCamera(serial, CALIBRATION, depth, color, **options)
