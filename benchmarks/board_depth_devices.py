"""Boards in colour and depth on simulated devices: the error of the pose against what is stated.

Run as ``python benchmarks/board_depth_devices.py SEED …``. Every device has its own cameras, pose,
distortion of 7 mm at 800 mm, noise, six walls of ten frames, and 40 boards; all options are those
of the product. Each seed is a fresh device: do not choose anything by the outcome.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests/insole_core/calibration"))
from simulated_board import COLOR_CAMERA, sight, spread_poses
from simulated_device import CAMERA, DISPARITY, WALLS, SimulatedDevice, smooth_distortion

from insole_core.calibration.board import Chequerboard
from insole_core.calibration.board_depth import BoardDepthCalibration, calibrate_board_depth
from insole_core.calibration.boards_in_depth import BoardInDepth, board_planes
from insole_core.calibration.distortion import calibrate_distortion
from insole_core.calibration.intrinsics import calibrate_camera
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import inverse, rigid, rotation_about, rotation_angle_deg
from insole_core.sensing.camera import Camera
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.nominal import BURRUS, DEPTH_CAMERA

BOARD, BOARDS, CORNER_PX = Chequerboard(10, 7, 30), 40, 0.1
FRAMES = 10
RMS_RAW = 7 / (DISPARITY.depth_mm(np.array([651.0])) - DISPARITY.depth_mm(np.array([650.0])))[0]
NAMES = ("fx", "fy", "cx", "cy")


@dataclass(frozen=True)
class Device:
    """A depth sensor beside a colour camera, and whether its distortion is taken out."""

    seed: int
    depth2color: FloatArray
    color_camera: Camera
    depth: SimulatedDevice
    correction: DisparityCorrection


def main() -> None:
    """Print both cases of every seed."""
    print("distortion | seed | error x, y, z, mm | stated, mm | norm, mm | angle, ° | in stated sd")
    for seed in map(int, sys.argv[1:]):
        for name, rms_raw in (("none", 0.0), ("7 mm, removed", abs(float(RMS_RAW)))):
            device = draw_device(seed, rms_raw)
            report(name, device, calibrate(device))


def draw_device(seed: int, rms_raw: float) -> Device:
    """Draw the numbers of a device round the usual ones."""
    generator = np.random.default_rng([seed, 7])
    shift = np.array([-25.0, 0, 0]) + generator.uniform([-2, -1.5, -1.5], [2, 1.5, 1.5])
    turn = rotation_about(generator.normal(size=3), generator.uniform(0.3, 1.2))
    fx, fy, cx, cy = generator.uniform(-6, 6, 4)
    color = replace(
        COLOR_CAMERA, fx=COLOR_CAMERA.fx + fx, fy=COLOR_CAMERA.fy + fy,
        cx=COLOR_CAMERA.cx + cx, cy=COLOR_CAMERA.cy + cy,
    )  # fmt: skip
    distortion = smooth_distortion(seed, rms_raw) if rms_raw else np.zeros((480, 640))
    depth = SimulatedDevice(distortion, generator=generator)
    correction = DisparityCorrection(np.zeros((480, 640), np.float32))
    if rms_raw:
        walls = [depth.capture(plane, FRAMES) for plane in WALLS]
        correction = calibrate_distortion(walls, DEPTH_CAMERA, BURRUS).correction
    return Device(seed, rigid(turn, shift), color, depth, correction)


def calibrate(device: Device) -> BoardDepthCalibration:
    """Do as the commands do: the colour camera from its pictures, the rest from the nominal."""
    boards = []
    for i, placed in enumerate(spread_poses(device.seed, BOARDS, BOARD, device.depth2color)):
        board2color = device.depth2color @ placed
        plane = board_planes(board2color[None], device.depth2color)[0]
        seed = 1000 * device.seed + i
        seen = sight(f"{i}", BOARD, board2color, device.color_camera, CORNER_PX, seed)
        raw = np.asarray(next(device.depth.frames(plane, 1)), dtype=float)
        boards.append(BoardInDepth(seen, device.correction.corrected(raw)))
    color = calibrate_camera([board.color for board in boards]).camera
    return calibrate_board_depth(boards, DEPTH_CAMERA, color, BURRUS)


def report(name: str, device: Device, found: BoardDepthCalibration) -> None:
    """Print the errors, and the worst of them in standard deviations."""
    error = found.stereo.depth2color[:3, 3] - device.depth2color[:3, 3]
    stated = found.stereo.translation_deviation_mm
    between = (found.stereo.depth2color @ inverse(device.depth2color))[:3, :3]
    cells = [f"{error.round(2)}", f"{stated.round(2)}", f"{np.linalg.norm(error):.2f}"]
    cells.append(f"{rotation_angle_deg(between):.3f}")
    ratios = {axis: one / sd for axis, one, sd in zip("xyz", error, stated, strict=True)}
    for key in NAMES:
        ratios[key] = (found.values[key] - getattr(CAMERA, key)) / found.deviations[key]
    cells.append(" ".join(f"{key} {ratio:+.1f}" for key, ratio in ratios.items()))
    print(" | ".join([name, str(device.seed), *cells]), flush=True)


if __name__ == "__main__":
    main()
