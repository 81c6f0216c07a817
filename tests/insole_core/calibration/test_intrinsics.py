from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from simulated_board import COLOR_CAMERA, board_poses, chequer_print, photograph, sight

from insole_core.calibration.boards.board import (
    BoardDetection,
    Charuco,
    Chequerboard,
    picture_paths,
    read_grey,
)
from insole_core.calibration.boards.intrinsics import (
    PARAMETERS,
    IntrinsicsOptions,
    calibrate_camera,
    parameters_of,
)
from insole_core.errors import CalibrationError, InputError, UsageError
from insole_core.geometry.arrays import ByteArray
from insole_core.sensing.pinhole_camera import PinholeCamera

BOARD = Chequerboard(10, 7, 30)
CENTER = np.array([135.0, 90, 0])
SMALL = PinholeCamera(640, 480, 525.0, 526.0, 322.0, 250.0, (0.05, -0.1, 0.0, 0.0, 0.0))


def sightings(
    camera: PinholeCamera = COLOR_CAMERA, count: int = 20, seed: int = 1
) -> list[BoardDetection]:
    return [
        sight(f"color_{i:03d}.png", BOARD, placed, camera, 0.15, i + 1000 * seed)
        for i, placed in enumerate(board_poses(seed, count, CENTER))
    ]


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("options", [IntrinsicsOptions(), IntrinsicsOptions(fit_k3=True)])
def test_every_parameter_lies_within_three_deviations(
    seed: int, options: IntrinsicsOptions
) -> None:
    result = calibrate_camera(sightings(seed=seed), options)
    true, found = parameters_of(COLOR_CAMERA), parameters_of(result.camera)
    for name in PARAMETERS:
        assert abs(found[name] - true[name]) <= 3 * result.deviations[name] + 1e-12, name
    assert 0 < result.deviations["fx"] < 3
    assert result.rms_px == pytest.approx(0.15 * np.sqrt(2), rel=0.1)


def test_skew_is_found_when_asked_for() -> None:
    skewed = replace(COLOR_CAMERA, skew=1.5)
    result = calibrate_camera(sightings(skewed, 12), IntrinsicsOptions(fit_skew=True))
    assert abs(result.camera.skew - 1.5) < 3 * result.deviations["skew"] < 1
    assert result.camera.fx == pytest.approx(skewed.fx, abs=3 * result.deviations["fx"])


def test_an_outlying_picture_is_left_out_by_name() -> None:
    seen = sightings(count=12)
    generator = np.random.default_rng(0)
    bad = replace(seen[4], pixels=seen[4].pixels + generator.normal(0, 3, seen[4].pixels.shape))
    result = calibrate_camera([*seen[:4], bad, *seen[5:]])
    assert list(result.left_out) == ["color_004.png"]
    assert "far above" in result.left_out["color_004.png"]
    assert len(result.pictures) == 11


def test_coverage_names_what_is_missing() -> None:
    upper_left = [
        s for s in sightings(count=60) if s.pixels[:, 0].max() < 850 and s.pixels[:, 1].max() < 750
    ]
    result = calibrate_camera(upper_left)
    assert result.coverage.sum() == 70 * len(result.pictures)
    assert "lower right" in result.advice[-1]


@pytest.mark.parametrize("turn", [0, 1, 2, 3])
def test_a_photographed_board_is_found_upright_and_turned(turn: int) -> None:
    px_per_mm = 2.0
    pose = board_poses(3, 1, CENTER, 700, 20)[0]
    corner = pose.copy()
    corner[:3, 3] = pose[:3, 3] - pose[:3, :2] @ [45.0, 45.0]
    picture = photograph(chequer_print(10, 7, 60), px_per_mm, corner, SMALL)
    found = BOARD.find("picture", np.ascontiguousarray(np.rot90(picture, turn)))
    expected = sight("", BOARD, pose, SMALL).pixels
    width, height = SMALL.width, SMALL.height
    for _ in range(turn):
        expected = np.column_stack([expected[:, 1], width - 1 - expected[:, 0]])
        width, height = height, width
    nearest = np.linalg.norm(found.pixels[:, None] - expected[None], axis=-1).min(1)
    assert nearest.max() < 0.5


def charuco_picture(board: Charuco, clip: slice | None = None) -> ByteArray:
    image = board.pattern().generateImage((1000, 700), marginSize=20, borderBits=1)
    if clip is not None:
        image[:, clip] = 255
    return np.asarray(image)


def test_charuco_is_found_in_part() -> None:
    board = Charuco(10, 7, 30, 22)
    whole = board.find("whole", charuco_picture(board))
    part = board.find("part", charuco_picture(board, slice(500, None)))
    assert len(whole.pixels) == 54
    assert 15 < len(part.pixels) < 54
    # The corner's number, not its place in the list, says where it is on the board.
    row = {tuple(p): q for p, q in zip(whole.points_mm, whole.pixels, strict=True)}
    for point, pixel in zip(part.points_mm, part.pixels, strict=True):
        assert np.allclose(row[tuple(point)], pixel, atol=0.1)


def flat_picture(columns: int = 10, rows: int = 7) -> ByteArray:
    return chequer_print(columns, rows, 60)


def test_no_board() -> None:
    with pytest.raises(CalibrationError, match="empty: no chequerboard of 10×7"):
        BOARD.find("empty", np.full((480, 640), 128, np.uint8))
    with pytest.raises(CalibrationError, match="0 corners of the ChArUco board"):
        Charuco(10, 7, 30, 22).find("empty", np.full((480, 640), 128, np.uint8))


def test_a_board_of_another_size_or_seen_in_part() -> None:
    with pytest.raises(CalibrationError, match="is seen, but not one of 10×7"):
        BOARD.find("other", flat_picture(8, 5))
    with pytest.raises(CalibrationError, match="is seen, but not one of 10×7"):
        BOARD.find("part", np.ascontiguousarray(flat_picture()[:, :450]))


def test_a_blurred_board() -> None:
    with pytest.raises(CalibrationError, match="soft is blurred"):
        BOARD.find("soft", np.asarray(cv2.GaussianBlur(flat_picture(), (0, 0), 6)))


def test_too_few_pictures() -> None:
    with pytest.raises(CalibrationError, match="Only 2 pictures"):
        calibrate_camera(sightings(count=2))


def test_parallel_boards() -> None:
    poses = board_poses(1, 8, CENTER, tilt_deg=1)
    parallel = [sight(f"{i}", BOARD, p, COLOR_CAMERA, 0.1, i) for i, p in enumerate(poses)]
    with pytest.raises(CalibrationError, match="held the same way"):
        calibrate_camera(parallel)


def test_wrong_unit_of_the_square() -> None:
    with pytest.raises(UsageError, match=r"A square of 0.03 mm"):
        Chequerboard(10, 7, 0.03)
    small = [replace(s, points_mm=s.points_mm / 10) for s in sightings(count=6)]
    with pytest.raises(CalibrationError, match="must be given in millimetres"):
        calibrate_camera(small)


def test_pictures_of_different_sizes() -> None:
    other = replace(sightings(count=1)[0], size=(640, 480), name="small.png")
    with pytest.raises(CalibrationError, match="differ in size"):
        calibrate_camera([*sightings(count=4), other])


@pytest.mark.parametrize(
    ("board", "words"),
    [
        ((2, 7, 30), "too small"),
        ((10, 7, 500), "cannot be"),
    ],
)
def test_impossible_boards(board: tuple[int, int, float], words: str) -> None:
    with pytest.raises(UsageError, match=words):
        Chequerboard(*board)


def test_impossible_charuco() -> None:
    with pytest.raises(UsageError, match="does not fit"):
        Charuco(10, 7, 30, 31)
    with pytest.raises(UsageError, match="no marker dictionary"):
        Charuco(10, 7, 30, 22, "DICT_9X9")


def test_folders_without_pictures(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="There is no folder"):
        picture_paths(tmp_path / "none")
    with pytest.raises(InputError, match="holds no pictures"):
        picture_paths(tmp_path)
    (tmp_path / "color_0.png").write_bytes(b"no picture")
    with pytest.raises(InputError, match="no readable picture"):
        read_grey(picture_paths(tmp_path)[0])
