from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from simulated_board import COLOR_CAMERA, board_poses, sight, spread_poses
from simulated_device import CAMERA, DISPARITY, SimulatedDevice

from insole_core.calibration.boards.board import BoardDetection, Chequerboard, shifted
from insole_core.calibration.boards.board_depth import BoardDepthOptions, calibrate_board_depth
from insole_core.calibration.boards.boards_in_depth import (
    BoardInDepth,
    board_planes,
    read_boards_in_depth,
)
from insole_core.calibration.boards.intrinsics import calibrate_camera, parameters_of
from insole_core.calibration.boards.stereo import IR_TO_DEPTH_PX, calibrate_stereo
from insole_core.calibration.depth_sensor import add_tilt
from insole_core.errors import CalibrationError, InputError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import inverse, rigid, rotation_about, rotation_angle_deg
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera

BOARD = Chequerboard(10, 7, 30)
CENTER = np.array([135.0, 90, 0])
DEPTH2COLOR = rigid(rotation_about(np.array([0.3, 1, -0.5]), 0.8), np.array([-25.3, 0.6, -1.2]))


def pose_error(found: FloatArray) -> tuple[float, float]:
    difference = found @ inverse(DEPTH2COLOR)
    shift = np.linalg.norm(found[:3, 3] - DEPTH2COLOR[:3, 3])
    return float(shift), rotation_angle_deg(difference[:3, :3])


def pairs(count: int) -> tuple[list[BoardDetection], list[BoardDetection]]:
    """The board in infrared pixels and in colour."""
    infrared = replace(CAMERA, cx=CAMERA.cx - IR_TO_DEPTH_PX[0], cy=CAMERA.cy - IR_TO_DEPTH_PX[1])
    poses = spread_poses(7, count, BOARD, DEPTH2COLOR)
    ir = [sight(f"ir_{i}", BOARD, p, infrared, 0.1, i) for i, p in enumerate(poses)]
    color = [
        sight(f"color_{i}", BOARD, DEPTH2COLOR @ p, COLOR_CAMERA, 0.1, 99 + i)
        for i, p in enumerate(poses)
    ]
    return ir, color


@pytest.mark.slow
def test_pose_from_infrared_and_colour() -> None:
    ir, color = pairs(16)
    depth = [shifted(sighting, IR_TO_DEPTH_PX) for sighting in ir]
    alone = [calibrate_camera(sightings).camera for sightings in (depth, color)]
    found = calibrate_stereo(depth, color, *alone)
    result = found.stereo
    shift, turn = pose_error(result.depth2color)
    assert shift < 0.25
    assert turn < 0.05
    off = np.abs(result.depth2color[:3, 3] - DEPTH2COLOR[:3, 3])
    assert (off < 3 * result.translation_deviation_mm).all()
    assert result.baseline_mm == pytest.approx(np.linalg.norm(DEPTH2COLOR[:3, 3]), abs=0.25)
    assert result.rms == pytest.approx(0.1 * np.sqrt(2), rel=0.1)
    for kind, camera in (("depth", CAMERA), ("color", COLOR_CAMERA)):
        for name in ("fx", "fy", "cx", "cy", "k1", "k2"):
            error = found.values[f"{kind} {name}"] - parameters_of(camera)[name]
            assert abs(error) < 3 * found.deviations[f"{kind} {name}"]
    assert found.depth_camera.fx == found.values["depth fx"]


def test_corners_are_matched_by_their_place_on_the_board() -> None:
    ir, color = pairs(6)
    depth = [shifted(sighting, IR_TO_DEPTH_PX) for sighting in ir]
    part = [replace(s, points_mm=s.points_mm[20:], pixels=s.pixels[20:]) for s in color]
    shift, turn = pose_error(calibrate_stereo(depth, part, CAMERA, COLOR_CAMERA).stereo.depth2color)
    assert shift < 1
    assert turn < 0.1


def test_too_few_pairs() -> None:
    ir, color = pairs(2)
    with pytest.raises(CalibrationError, match="2 pairs of pictures"):
        calibrate_stereo(ir, color, CAMERA, COLOR_CAMERA)


def boards_in_depth(poses: list[FloatArray]) -> list[BoardInDepth]:
    device = SimulatedDevice(np.zeros((480, 640)))
    boards = []
    for i, placed in enumerate(poses):
        board2color = DEPTH2COLOR @ placed
        plane = board_planes(board2color[None], DEPTH2COLOR)[0]
        boards.append(
            BoardInDepth(
                sight(f"color_{i}", BOARD, board2color, COLOR_CAMERA, 0.1, i),
                np.asarray(next(device.frames(plane, 1)), dtype=float),
            )
        )
    return boards


def tilted(count: int, tilt_deg: float = 35) -> list[BoardInDepth]:
    return boards_in_depth(board_poses(5, count, CENTER, 900, tilt_deg))


@pytest.fixture(scope="module")
def everywhere() -> list[BoardInDepth]:
    """Forty boards, tilted up to 50° to all sides, in all parts of the picture."""
    return boards_in_depth(spread_poses(1, 40, BOARD, DEPTH2COLOR))


@pytest.mark.slow
def test_everything_from_colour_and_disparity(everywhere: list[BoardInDepth]) -> None:
    rough = PinholeCamera(640, 480, 580, 580, 319.5, 239.5)
    guess = LinearInverseDisparity(DISPARITY.a * 1.02, DISPARITY.b * 1.02)
    color = calibrate_camera([board.color for board in everywhere]).camera
    result = calibrate_board_depth(everywhere, rough, color, guess)
    shift, turn = pose_error(result.stereo.depth2color)
    assert shift < 0.5
    assert turn < 0.1
    assert np.linalg.norm(result.stereo.translation_deviation_mm) < 0.35
    for name in ("fx", "fy", "cx", "cy"):
        error = getattr(result.depth.camera, name) - getattr(CAMERA, name)
        assert abs(error) < 3.5 * result.deviations[name]
        assert 0 < result.deviations[name] < 0.3
    off = result.stereo.depth2color[:3, 3] - DEPTH2COLOR[:3, 3]
    assert (np.abs(off) < 3.5 * result.stereo.translation_deviation_mm).all()
    raw = np.array([500.0, 600, 700])
    assert np.allclose(result.depth.disparity.depth_mm(raw), DISPARITY.depth_mm(raw), rtol=8e-4)


@pytest.mark.slow
def test_few_boards_say_how_little_they_tell() -> None:
    result = calibrate_board_depth(tilted(12, 20), CAMERA, COLOR_CAMERA, DISPARITY)
    shift, _ = pose_error(result.stereo.depth2color)
    assert shift < 3 * np.linalg.norm(result.stereo.translation_deviation_mm)
    assert np.linalg.norm(result.stereo.translation_deviation_mm) > 1


@pytest.mark.slow
def test_pose_alone_when_all_else_is_known() -> None:
    options = BoardDepthOptions(disparity=False, centre=False, focal=False, tilt=False)
    result = calibrate_board_depth(tilted(12), CAMERA, COLOR_CAMERA, DISPARITY, options)
    shift, turn = pose_error(result.stereo.depth2color)
    assert shift < 0.5
    assert turn < 0.1
    assert result.deviations == {}


@pytest.mark.slow
def test_a_tilt_of_all_raw_numbers_goes_into_the_correction(everywhere: list[BoardInDepth]) -> None:
    tilt = DisparityCorrection(np.zeros((480, 640), np.float32))
    slanted = add_tilt(tilt, CAMERA, (-1.5, 1.0))
    boards = [replace(board, raw=slanted.corrected(board.raw)) for board in everywhere[:24]]
    result = calibrate_board_depth(boards, CAMERA, COLOR_CAMERA, DISPARITY)
    assert result.depth.tilt_raw == pytest.approx((1.5, -1.0), abs=0.3)
    mended = add_tilt(slanted, CAMERA, result.depth.tilt_raw)
    assert np.abs(mended.offset).max() < 0.4
    assert pose_error(result.stereo.depth2color)[1] < 0.1


def test_boards_that_are_all_parallel_or_too_few() -> None:
    with pytest.raises(CalibrationError, match="tilted too little"):
        calibrate_board_depth(tilted(6, 1.0), CAMERA, COLOR_CAMERA, DISPARITY)
    with pytest.raises(CalibrationError, match="at 3 positions, but 4"):
        calibrate_board_depth(tilted(3), CAMERA, COLOR_CAMERA, DISPARITY)


def test_depth_beside_the_pictures(tmp_path: Path) -> None:
    raw = np.full((480, 640), 700, np.uint16)
    raw[5, 6] = 2047
    cv2.imwrite(str(tmp_path / "depth_003.png"), raw)
    sighting = sight("color_003.jpg", BOARD, board_poses(1, 1, CENTER)[0], COLOR_CAMERA)
    correction = DisparityCorrection(np.full((480, 640), 2.0, np.float32))
    (board,) = read_boards_in_depth(tmp_path, [sighting], correction)
    assert np.isnan(board.raw[5, 6])
    assert board.raw[0, 0] == 698
    with pytest.raises(InputError, match=r"depth_004.png is no readable image"):
        read_boards_in_depth(tmp_path, [replace(sighting, name="color_004.jpg")])
