"""A board as a known object: its corners are detected automatically, without marking points."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from insole_core.calibration.boards.board import BoardDetection
from insole_core.calibration.boards.boards_in_depth import BoardInDepth
from insole_core.calibration.boards.stereo import board_pose
from insole_core.errors import CalibrationError
from insole_core.evaluation.alignment import Correspondence
from insole_core.evaluation.color_points import points_at_color
from insole_core.evaluation.distances import (
    DistanceError,
    ObjectEvaluation,
    evaluate_object,
    summarise,
)
from insole_core.geometry.arrays import IntArray
from insole_core.geometry.transforms import transform
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

_SIDE = 3
"""Corners used along each side of a board, so that short distances do not outnumber long ones."""


def evaluate_boards(sensor: Sensor, boards: Sequence[BoardInDepth]) -> ObjectEvaluation:
    """Compare the distances between corners of a board with its print (thesis 5.5).

    Parameters
    ----------
    boards
        With raw numbers that are already corrected.

    Raises
    ------
    CalibrationError
        If no board has depth at two corners.
    """
    distances: list[DistanceError] = []
    for board in boards:
        chosen = _spread(board.color)
        depth = sensor.disparity.depth_mm(board.raw)
        measured = points_at_color(sensor, depth, board.color.pixels[chosen])
        if np.isfinite(measured).all(1).sum() >= 2:
            names = [f"{board.color.name}:{corner}" for corner in chosen.tolist()]
            distances += evaluate_object(names, board.color.points_mm[chosen], measured).distances
    if not distances:
        raise CalibrationError(
            "No board has depth at its corners; hold it 600 to 1500 mm from the sensor."
        )
    return summarise(distances)


def board_correspondences(
    pairs: Sequence[tuple[BoardDetection, BoardDetection]], depth_camera: PinholeCamera
) -> list[Correspondence]:
    """Return the corners that both cameras detect (thesis 5.4).

    Parameters
    ----------
    pairs
        The same board position in the depth camera (`board.shifted` infrared) and in colour, with
        the same corners in the same order.

    Returns
    -------
    list of Correspondence
        Depths are those of the board's pose in the depth camera.
    """
    points = []
    for depth, color in pairs:
        space = transform(board_pose(depth, depth_camera), depth.points_mm)
        for in_depth, z, in_color in zip(depth.pixels, space[:, 2], color.pixels, strict=True):
            points.append(
                Correspondence(
                    (float(in_depth[0]), float(in_depth[1])),
                    float(z),
                    (float(in_color[0]), float(in_color[1])),
                )
            )
    return points


def _spread(detection: BoardDetection) -> IntArray:
    """Choose corners near the nodes of a coarse lattice over the visible part of the board."""
    points = detection.points_mm[:, :2]
    axes = [np.linspace(points[:, i].min(), points[:, i].max(), _SIDE) for i in (0, 1)]
    nodes = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)
    distance = np.linalg.norm(points[:, None] - nodes[None], axis=-1)
    return np.unique(distance.argmin(0))
