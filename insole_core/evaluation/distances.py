"""A known object: all distances between its points, marked, or corners of a board (thesis 5.5)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from insole_core.calibration.boards.board import BoardDetection
from insole_core.calibration.boards.boards_in_depth import BoardInDepth
from insole_core.calibration.boards.stereo import board_pose
from insole_core.errors import CalibrationError, InputError
from insole_core.evaluation.alignment import Correspondence
from insole_core.evaluation.color_points import points_at_color
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.transforms import transform
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

AXES = ("x", "y", "z", "space")
_ALONG = 0.999
"""Least cosine of a distance that counts as along an axis of the object."""
_SIDE = 3
"""Corners used along each side of a board, so that short distances do not outnumber long ones."""


@dataclass(frozen=True)
class DistanceError:
    """One distance: its two points, its axis, true and measured length."""

    first: str
    second: str
    axis: str
    true_mm: float
    measured_mm: float

    @property
    def error_mm(self) -> float:
        """Measured minus true."""
        return self.measured_mm - self.true_mm

    @property
    def relative(self) -> float:
        """Thesis (23)."""
        return abs(self.error_mm) / self.true_mm


@dataclass(frozen=True)
class ObjectEvaluation:
    """All distances of an object, and their summary in mm."""

    distances: tuple[DistanceError, ...]
    mean_abs_mm: float
    sd_abs_mm: float
    max_abs_mm: float
    mean_relative: float
    mean_abs_by_axis_mm: dict[str, float]


def evaluate_object(
    names: list[str], true_mm: FloatArray, measured_mm: FloatArray
) -> ObjectEvaluation:
    """Compare all distances between the marked points of an object with the true ones.

    Parameters
    ----------
    names
        Of the n points.
    true_mm : (n, 3) float64, mm, the object's own axes
    measured_mm : (n, 3) float64, mm, any frame; NaN for a point that was not seen

    Raises
    ------
    InputError
        If fewer than two points were seen, or the lists differ in length.
    """
    if true_mm.shape != (len(names), 3) or measured_mm.shape != true_mm.shape:
        raise InputError(
            "{names} points are named, but {true_points} true and {measured_points} measured "
            "positions are given; give each point's both positions.",
            names=len(names),
            true_points=len(true_mm),
            measured_points=len(measured_mm),
        )
    seen = np.flatnonzero(np.isfinite(measured_mm).all(axis=1))
    if len(seen) < 2:
        raise InputError("Fewer than two points of the object were measured; mark them again.")
    return summarise(
        DistanceError(
            names[i],
            names[j],
            _axis(true_mm[j] - true_mm[i]),
            float(np.linalg.norm(true_mm[j] - true_mm[i])),
            float(np.linalg.norm(measured_mm[j] - measured_mm[i])),
        )
        for i, j in combinations(seen.tolist(), 2)
    )


def summarise(distances: Iterable[DistanceError]) -> ObjectEvaluation:
    """Summarise distances of one object, or of several positions of it.

    Raises
    ------
    InputError
        If there are none.
    """
    listed = tuple(distances)
    if not listed:
        raise InputError("No distance of the object was measured; mark its points again.")
    size = np.array([abs(d.error_mm) for d in listed])
    return ObjectEvaluation(
        distances=listed,
        mean_abs_mm=float(size.mean()),
        sd_abs_mm=float(size.std()),
        max_abs_mm=float(size.max()),
        mean_relative=float(np.mean([d.relative for d in listed])),
        mean_abs_by_axis_mm={
            axis: float(np.mean([abs(d.error_mm) for d in listed if d.axis == axis]))
            for axis in AXES
            if any(d.axis == axis for d in listed)
        },
    )


def _axis(direction: FloatArray) -> str:
    length = np.linalg.norm(direction)
    if not length > 0:
        raise InputError("Two points of the object have the same true position; correct the list.")
    share = np.abs(direction) / length
    return AXES[int(np.argmax(share))] if share.max() > _ALONG else "space"


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
