"""Board calibration of simulated devices: true error of the depth camera against the stated one.

Run as ``python benchmarks/board_depth_devices.py SEED …``. Every device has its own cameras, pose,
distortion of 7 mm at 800 mm, and noise, and is calibrated as the manual says: six walls of ten
frames from 500 to 1050 mm, and 48 boards tilted by 40 to 55° to four sides; the infrared method
uses the first 16 boards. All options are those of the product. Each seed is a new device: do not
tune anything by the outcome.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests/insole_core/calibration"))
from simulated_board import COLOR_CAMERA, sight, spread_poses
from simulated_device import CAMERA, DISPARITY, SimulatedDevice, smooth_distortion, wall

from insole_core.calibration.boards.board import BoardDetection, Chequerboard, shifted
from insole_core.calibration.boards.board_depth import calibrate_board_depth
from insole_core.calibration.boards.boards_in_depth import BoardInDepth, board_planes
from insole_core.calibration.boards.intrinsics import calibrate_camera, with_shift
from insole_core.calibration.boards.stereo import (
    IR_TO_DEPTH_PX,
    StereoCalibration,
    calibrate_stereo,
)
from insole_core.calibration.walls.captures import capture_from_frames
from insole_core.calibration.walls.distortion import calibrate_distortion
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import inverse, rigid, rotation_about, rotation_angle_deg
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import BURRUS, DEPTH_CAMERA

BOARD, BOARDS, INFRARED_BOARDS, CORNER_PX = Chequerboard(12, 8, 30), 48, 16, 0.1
WALLS = (
    wall(500, 2, -3), wall(580, -4, 2), wall(670, 3, 4), wall(780, -2, -5), wall(900, 4, 1),
    wall(1050, -3, 4),
)  # fmt: skip
FRAMES = 10
RMS_RAW = 7 / (DISPARITY.depth_mm(np.array([678.1])) - DISPARITY.depth_mm(np.array([677.1])))[0]
NAMES = ("fx", "fy", "cx", "cy")


@dataclass(frozen=True)
class Device:
    """A depth sensor beside a colour camera, and whether its distortion is corrected."""

    seed: int
    depth2color: FloatArray
    color_camera: PinholeCamera
    depth: SimulatedDevice
    correction: DisparityCorrection


def main() -> None:
    """Print all three cases for every seed."""
    print("from | seed | error x, y, z, mm | stated, mm | norm, mm | angle, ° | in stated sd")
    for seed in map(int, sys.argv[1:]):
        calibrate_infrared(draw_device(seed, 0.0))
        for name, rms_raw in (("depth", 0.0), ("depth, 7 mm removed", abs(float(RMS_RAW)))):
            calibrate_depth(name, draw_device(seed, rms_raw))


def draw_device(seed: int, rms_raw: float) -> Device:
    """Draw the parameters of a device around the nominal ones.

    Parameters
    ----------
    rms_raw
        Of the distortion, raw units.
    """
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


def calibrate_infrared(device: Device) -> None:
    """Calibrate as the commands do: both cameras from their pictures, then both together."""
    infrared = with_shift(CAMERA, (-IR_TO_DEPTH_PX[0], -IR_TO_DEPTH_PX[1]))
    poses = spread_poses(device.seed, INFRARED_BOARDS, BOARD, device.depth2color)
    seen = [
        sight(f"ir_{i}", BOARD, placed, infrared, CORNER_PX, 1000 * device.seed + 500 + i)
        for i, placed in enumerate(poses)
    ]
    depth, color = [shifted(one, IR_TO_DEPTH_PX) for one in seen], sight_all(device, poses)
    cameras = [calibrate_camera(sightings).camera for sightings in (depth, color)]
    found = calibrate_stereo(depth, color, *cameras)
    named = {name: (found.values[f"depth {name}"], found.deviations[f"depth {name}"])
             for name in NAMES}  # fmt: skip
    report("infrared", device, found.stereo, named)


def calibrate_depth(name: str, device: Device) -> None:
    """Calibrate as the commands do: the colour camera from its pictures, the rest from nominal."""
    poses = spread_poses(device.seed, BOARDS, BOARD, device.depth2color)
    color = sight_all(device, poses)
    boards = []
    for placed, seen in zip(poses, color, strict=True):
        (plane,) = board_planes((device.depth2color @ placed)[None], device.depth2color)
        raw = capture_from_frames(seen.name, device.depth.frames(plane, FRAMES)).raw
        boards.append(BoardInDepth(seen, device.correction.corrected(raw)))
    camera = calibrate_camera(color).camera
    found = calibrate_board_depth(boards, DEPTH_CAMERA, camera, BURRUS)
    named = {name: (found.values[name], found.deviations[name]) for name in NAMES}
    report(name, device, found.stereo, named)


def sight_all(device: Device, poses: Sequence[FloatArray]) -> list[BoardDetection]:
    """Detect the boards in colour."""
    return [
        sight(
            f"color_{i}", BOARD, device.depth2color @ placed, device.color_camera, CORNER_PX,
            1000 * device.seed + i,
        )
        for i, placed in enumerate(poses)
    ]  # fmt: skip


def report(
    name: str,
    device: Device,
    found: StereoCalibration,
    intrinsics: Mapping[str, tuple[float, float]],
) -> None:
    """Print the errors, also in standard deviations."""
    error = found.depth2color[:3, 3] - device.depth2color[:3, 3]
    stated = found.translation_deviation_mm
    between = (found.depth2color @ inverse(device.depth2color))[:3, :3]
    ratios = {axis: one / sd for axis, one, sd in zip("xyz", error, stated, strict=True)}
    for key, (value, deviation) in intrinsics.items():
        ratios[key] = (value - getattr(CAMERA, key)) / deviation
    cells = [f"{error.round(2)}", f"{stated.round(2)}", f"{np.linalg.norm(error):.2f}"]
    cells += [f"{rotation_angle_deg(between):.3f}"]
    cells += [" ".join(f"{key} {ratio:+.1f}" for key, ratio in ratios.items())]
    print(" | ".join([name, str(device.seed), *cells]), flush=True)


if __name__ == "__main__":
    main()
