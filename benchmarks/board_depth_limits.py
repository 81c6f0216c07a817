"""The best pose obtainable from boards in colour and depth: its Cramér-Rao bound.

Run as ``python benchmarks/board_depth_limits.py``.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests/insole_core/calibration"))
from simulated_board import spread_poses

from insole_core.calibration.boards.board import Chequerboard
from insole_core.calibration.boards.boards_in_depth import board_planes
from insole_core.calibration.depth_sensor import DepthSensor
from insole_core.calibration.least_squares import Blocks, pose, pose_vector
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import inverse, rigid, rotation_about, transform
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera

BOARD = Chequerboard(10, 7, 30)
COLOR = PinholeCamera(1280, 1024, 1034.4, 1036.1, 640.2, 528.0, (0.14, -0.24, 0.001, -0.0005, 0.0))
DEPTH = PinholeCamera(640, 480, 585.0, 587.0, 317.5, 243.5)
DISPARITY = LinearInverseDisparity(3.3309495, -0.0030711016)
DEPTH2COLOR = rigid(rotation_about(np.array([0.3, 1, -0.5]), 0.8), np.array([-25.3, 0.6, -1.2]))
CORNER_PX, RAW, BLOCK_PX = 0.1, 0.3, 8
SHARED = 14
PLANS = ((15, 600, 1500, 30), (15, 600, 1000, 45), (30, 600, 1000, 45), (40, 570, 1000, 50))


def main() -> None:
    """Print the bound of each plan, averaged over three draws."""
    print("| boards | distance, mm | tilted | shift, mm | angle, ° |\n|---|---|---|---|---|")
    for count, near, far, tilt in PLANS:
        print_bound(
            f"| {count} | {near} – {far} | up to {tilt}°",
            [draw_poses(seed, count, near, far, tilt) for seed in (1, 2, 3)],
        )
    for count in (24, 48):
        print_bound(f"| {count} | 500 – 1050 | 40 – 55° to four sides", [
            [DEPTH2COLOR @ placed for placed in spread_poses(seed, count, BOARD, DEPTH2COLOR)]
            for seed in (1, 2, 3)
        ])  # fmt: skip


def print_bound(plan: str, draws: list[list[FloatArray]]) -> None:
    """Print the mean bound over the draws of a plan."""
    shift, angle = np.mean([bound(poses) for poses in draws], axis=0)
    print(f"{plan} | {shift:.2f} | {angle:.3f} |", flush=True)


def draw_poses(seed: int, count: int, near: float, far: float, tilt_deg: float) -> list[FloatArray]:
    """Draw boards in front of the colour camera, entirely within its picture.

    Parameters
    ----------
    near, far
        Range of the distance, mm.
    """
    generator = np.random.default_rng(seed)
    poses: list[FloatArray] = []
    while len(poses) < count:
        a, b = generator.uniform(-tilt_deg, tilt_deg, 2)
        rotation = rotation_about(np.array([1.0, 0, 0]), a) @ rotation_about(
            np.array([0, 1.0, 0]), b
        )
        depth_mm = 1 / generator.uniform(1 / far, 1 / near)
        place = depth_mm * np.array([*generator.uniform([-0.5, -0.4], [0.5, 0.4]), 1])
        placed = rigid(rotation, place - rotation @ BOARD.points_mm.mean(0))
        pixels = COLOR.project(transform(placed, BOARD.points_mm))
        if ((pixels > 5) & (pixels < (COLOR.width - 5, COLOR.height - 5))).all():
            poses.append(placed)
    return poses


def bound(poses: list[FloatArray]) -> tuple[float, float]:
    """Return the norm of the standard deviations of the translation, mm, and rotation, degrees."""
    patches = [patch(placed) for placed in poses]

    def residuals(unknowns: FloatArray) -> FloatArray:
        a, b, cx, cy, fx, fy, *tilt = unknowns[6:SHARED].tolist()
        camera = replace(DEPTH, cx=cx, cy=cy, fx=fx, fy=fy)
        depth = DepthSensor(camera, LinearInverseDisparity(a, b), (tilt[0], tilt[1]))
        placed = np.array([pose(vector) for vector in unknowns[SHARED:].reshape(-1, 6)])
        planes = board_planes(placed, pose(unknowns))
        parts = []
        for board, plane, pixels in zip(placed, planes, patches, strict=True):
            corners = COLOR.project(transform(board, BOARD.points_mm))
            raw = depth.raw(np.broadcast_to(plane, (len(pixels), 3)), pixels)
            parts += [corners.ravel() / CORNER_PX, raw / (RAW / BLOCK_PX)]
        return np.concatenate(parts)

    numbers = [DISPARITY.a, DISPARITY.b, DEPTH.cx, DEPTH.cy, DEPTH.fx, DEPTH.fy, 0, 0]
    truth = np.concatenate([pose_vector(DEPTH2COLOR), numbers, *[pose_vector(p) for p in poses]])
    lengths = tuple(2 * len(BOARD.points_mm) + len(pixels) for pixels in patches)
    jacobian = Blocks(lengths, SHARED).jacobian(residuals, truth)
    scale = np.sqrt((jacobian**2).sum(0))
    information = (jacobian / scale).T @ (jacobian / scale)
    deviations = np.sqrt(np.diag(np.linalg.inv(information))) / scale
    return float(np.linalg.norm(deviations[3:6])), float(np.degrees(np.linalg.norm(deviations[:3])))


def patch(board2color: FloatArray) -> FloatArray:
    """Return the centres (k, 2) of the squares of 8 x 8 depth pixels that lie on the board."""
    corners = BOARD.points_mm[[0, BOARD.columns - 1, -1, -BOARD.columns]]
    board2depth = inverse(DEPTH2COLOR) @ board2color
    outline = DEPTH.project(transform(board2depth, corners))
    grid = np.stack(np.meshgrid(np.arange(4, 640, BLOCK_PX), np.arange(4, 480, BLOCK_PX)), axis=-1)
    centres = grid.reshape(-1, 2).astype(float)
    sides = np.roll(outline, -1, axis=0) - outline
    away = centres[:, None] - outline
    turned = sides[:, 0] * away[..., 1] - sides[:, 1] * away[..., 0]
    return np.asarray(centres[(turned > 0).all(1) | (turned < 0).all(1)])


if __name__ == "__main__":
    main()
