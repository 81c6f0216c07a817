"""Folders of images as a technician records them, of a sensor whose every parameter is known."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
from simulated_board import board_poses, chequer_print, photograph
from simulated_device import CAMERA, DISPARITY, SimulatedDevice

from insole_core.calibration.boards.board import Chequerboard
from insole_core.calibration.boards.intrinsics import with_shift
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

BOARD = Chequerboard(9, 6, 30.0)
BOARD_CALL = ["--board", "9x6", "--square", "30"]
SENSOR = Sensor(
    model="kinect-v1",
    serial="SIM1",
    depth_camera=CAMERA,
    color_camera=PinholeCamera(640, 480, 525.0, 526.5, 322.0, 243.0, (0.1, -0.2, 0.0, 0.0, 0.0)),
    depth2color=rigid(rotation_about(np.array([1.0, 2, 0.5]), 0.8), np.array([-25.0, 0.6, -1.5])),
    disparity=DISPARITY,
    faces=("sole",),
)
_PX_PER_MM = 1.0
"""About as fine as the pictures: a finer print would be sampled with gaps."""


def write_boards(
    folder: Path,
    device: SimulatedDevice,
    count: int,
    kinds: Sequence[str] = ("color", "depth"),
    tilt_deg: float = 30,
) -> Path:
    """Write pictures of a board at `count` positions: colour, infrared, raw depth."""
    folder.mkdir(parents=True, exist_ok=True)
    for i, board2depth in enumerate(board_poses(5, count, BOARD.points_mm.mean(0), 800, tilt_deg)):
        for kind in ("color", "ir"):
            if kind in kinds:
                write_board_picture(folder / f"{kind}_{i:03d}.png", board2depth)
        if "depth" in kinds:
            (frame,) = device.frames(plane_of(board2depth), 1)
            cv2.imwrite(str(folder / f"depth_{i:03d}.png"), frame)
    return folder


def write_board_picture(path: Path, board2depth: FloatArray) -> None:
    """Write what the colour camera, or the infrared camera by the name, sees of a board."""
    texture = chequer_print(BOARD.columns, BOARD.rows, round(BOARD.square_mm * _PX_PER_MM))
    print2depth = board2depth.copy()
    print2depth[:3, 3] -= board2depth[:3, :2] @ np.full(2, 1.5 * BOARD.square_mm)
    placed, camera = SENSOR.depth2color @ print2depth, SENSOR.color_camera
    if path.name.startswith("ir"):
        # Pixels of the infrared image are those of the depth image, shifted by half a window.
        placed, camera = print2depth, with_shift(SENSOR.depth_camera, (4.8, 3.9))
    cv2.imwrite(str(path), photograph(texture, _PX_PER_MM, placed, camera))


def write_walls(
    folder: Path, device: SimulatedDevice, planes: Sequence[FloatArray], frames: int = 2
) -> Path:
    """Write a sub-folder of raw depth images for each wall, with the serial number beside them."""
    for i, plane in enumerate(planes):
        wall = folder / f"wall_{i:03d}"
        wall.mkdir(parents=True)
        (wall / "sensor.json").write_text(json.dumps({"serial": device.serial}))
        for number, frame in enumerate(device.frames(plane, frames)):
            cv2.imwrite(str(wall / f"depth_{number:03d}.png"), frame)
    return folder


def plane_of(board2depth: FloatArray) -> FloatArray:
    """(3,) 1/mm: 1/Z = plane · (x, y, 1) of a board's plane."""
    normal, origin = board2depth[:3, 2], board2depth[:3, 3]
    return np.asarray(normal / (normal @ origin))
