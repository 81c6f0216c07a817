"""Boards before cameras of known parameters."""

from __future__ import annotations

from functools import cache

import cv2
import numpy as np

from insole_core.calibration.boards.board import Board, BoardDetection
from insole_core.geometry.arrays import ByteArray, FloatArray
from insole_core.geometry.transforms import rigid, rotation_about, transform
from insole_core.sensing.pinhole_camera import PinholeCamera

COLOR_CAMERA = PinholeCamera(
    1280, 1024, 1034.4, 1036.1, 640.2, 528.0, (0.14, -0.24, 0.001, -0.0005, 0.0)
)


def board_poses(
    seed: int, count: int, center_mm: FloatArray, distance_mm: float = 800, tilt_deg: float = 35
) -> list[FloatArray]:
    """Poses ``board2camera`` of boards about `distance_mm` away, tilted to all sides."""
    generator = np.random.default_rng(seed)
    poses = []
    for _ in range(count):
        tilts = generator.uniform(-tilt_deg, tilt_deg, 2)
        rotation = (
            rotation_about(np.array([1.0, 0, 0]), tilts[0])
            @ rotation_about(np.array([0, 1.0, 0]), tilts[1])
            @ rotation_about(np.array([0, 0, 1.0]), generator.uniform(-20, 20))
        )
        place = generator.uniform([-110, -80, -0.2 * distance_mm], [110, 80, 0.25 * distance_mm])
        place[2] += distance_mm
        poses.append(rigid(rotation, place - rotation @ center_mm))
    return poses


def spread_poses(seed: int, count: int, board: Board, depth2color: FloatArray) -> list[FloatArray]:
    """Poses ``board2depth`` as the instruction asks for them.

    Tilted by 40 to 55° to one of four sides in turn, wholly 500 to 1050 mm away, in all parts of
    the colour picture.
    """
    generator, center = np.random.default_rng(seed), board.points_mm.mean(0)
    poses: list[FloatArray] = []
    while len(poses) < count:
        tilts = np.array([generator.uniform(40, 55), generator.uniform(-15, 15)])
        tilts[0] *= (-1) ** len(poses)
        if len(poses) % 4 < 2:
            tilts = tilts[::-1]
        rotation = (
            rotation_about(np.array([1.0, 0, 0]), tilts[0])
            @ rotation_about(np.array([0, 1.0, 0]), tilts[1])
            @ rotation_about(np.array([0, 0, 1.0]), generator.uniform(-20, 20))
        )
        depth_mm = 1 / generator.uniform(1 / 1000, 1 / 570)
        place = depth_mm * np.array([*generator.uniform([-0.4, -0.3], [0.4, 0.3]), 1])
        pose = rigid(rotation, place - rotation @ center)
        points = transform(pose, board.points_mm)
        pixels = COLOR_CAMERA.project(transform(depth2color, points))
        inside = (pixels > 5) & (pixels < (COLOR_CAMERA.width - 5, COLOR_CAMERA.height - 5))
        if inside.all() and points[:, 2].min() > 500 and points[:, 2].max() < 1050:
            poses.append(pose)
    return poses


def sight(
    name: str,
    board: Board,
    board2camera: FloatArray,
    camera: PinholeCamera,
    noise_px: float = 0.0,
    seed: int = 0,
) -> BoardDetection:
    """Project all corners, with noise."""
    pixels = camera.project(transform(board2camera, board.points_mm))
    noise = np.random.default_rng(seed).normal(0, noise_px, pixels.shape) if noise_px else 0
    return BoardDetection(name, (camera.width, camera.height), board.points_mm, pixels + noise)


def chequer_print(columns: int, rows: int, square_px: int) -> ByteArray:
    """A chequerboard; its first inner corner is 1.5 squares from the print's corner."""
    dark = np.indices((rows + 1, columns + 1)).sum(0) % 2
    squares = np.kron(255 * dark, np.ones((square_px, square_px))).astype(np.uint8)
    return np.pad(squares, square_px // 2, constant_values=255)


@cache
def ray_rows(camera: PinholeCamera) -> FloatArray:
    """(height, width, 3) directions with z = 1; undone distortion takes most of a rendering."""
    rays = camera.pixel_rays()
    return np.concatenate([rays, np.ones((*rays.shape[:2], 1))], axis=-1)


def photograph(
    texture: ByteArray, px_per_mm: float, board2camera: FloatArray, camera: PinholeCamera
) -> ByteArray:
    """Render a flat print (its first pixel at the board's origin) before a grey wall."""
    rows = ray_rows(camera)
    normal, origin = board2camera[:3, 2], board2camera[:3, 3]
    points = rows * ((normal @ origin) / (rows @ normal))[..., None]
    flat = (points - origin) @ board2camera[:3, :2] * px_per_mm - 0.5
    image = cv2.remap(
        texture,
        flat[..., 0].astype(np.float32),
        flat[..., 1].astype(np.float32),
        cv2.INTER_AREA if px_per_mm > 4 else cv2.INTER_LINEAR,
        borderValue=128,
    )
    return np.asarray(cv2.GaussianBlur(image, (0, 0), 0.8))
