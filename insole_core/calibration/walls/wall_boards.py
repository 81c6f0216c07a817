"""The planes of walls, from a board on each that the colour camera sees."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from insole_core.calibration.boards.board import Board, picture_paths, read_grey
from insole_core.calibration.boards.boards_in_depth import board_planes
from insole_core.calibration.boards.stereo import board_pose
from insole_core.calibration.walls.captures import WallCapture
from insole_core.progress import SILENT, Progress
from insole_core.sensing.sensor import Sensor


def with_board_planes(
    captures: Sequence[WallCapture],
    folder: Path,
    board: Board,
    sensor: Sensor,
    progress: Progress = SILENT,
) -> list[WallCapture]:
    """Add the planes to wall captures: ``color…`` beside the frames shows a board on the wall.

    With known planes the distortion includes the tilt and shift that walls alone cannot determine.

    Parameters
    ----------
    captures
        Named as their sub-folders of `folder`.
    sensor
        Its colour camera and the pose between its cameras are calibrated.

    Raises
    ------
    InputError
        If a wall has no colour picture.
    CalibrationError
        If the picture shows no board.
    """
    known = []
    for done, capture in enumerate(captures):
        progress.step(
            done / len(captures), "Looking for the board on {capture}", capture=capture.name
        )
        picture = picture_paths(folder / capture.name, "color")[0]
        detection = board.find(f"{capture.name}/{picture.name}", read_grey(picture))
        board2color = board_pose(detection, sensor.color_camera)
        (plane,) = board_planes(board2color[None], sensor.depth2color)
        known.append(replace(capture, plane=plane))
    return known
