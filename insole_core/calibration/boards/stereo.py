"""The pose of the colour camera relative to the depth camera (thesis 4.3, 5.4, limitation 10.3).

From pictures of one board in infrared (emitter covered) and in colour. The depth image is cut out
of the infrared image with a shift of a few pixels, which is taken into account.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np

from insole_core.calibration.boards.board import BoardDetection
from insole_core.calibration.boards.intrinsics import LENS, parameters_of, with_parameters
from insole_core.calibration.least_squares import (
    Adjustment,
    Blocks,
    least_squares,
    pose,
    pose_vector,
)
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.transforms import inverse, rigid, rotation_angle_deg, transform
from insole_core.sensing.infrared_reference import USUAL_SHIFT_PX
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Unit

IR_TO_DEPTH_PX = (-USUAL_SHIFT_PX[0], -USUAL_SHIFT_PX[1])
"""Depth pixel minus infrared pixel of a Kinect v1."""
_CORNER_PX = 0.2
"""Standard error of a corner, which weights corners relative to the prior of the cameras."""
_SPREAD = np.tile([20.0, 20.0, 20.0, 20.0, 0.2, 0.5, 0.02, 0.02], 2)
"""Prior standard deviations of `LENS` of both cameras, for what the boards do not determine."""
_SHARED = 6 + 2 * len(LENS)
_LEAST_PAIRS = 3
_LEAST_COMMON = 8


@dataclass(frozen=True, eq=False)
class StereoCalibration:
    """The pose between the two cameras.

    Parameters
    ----------
    depth2color : (4, 4) float64, mm
    rotation_deviation_deg, translation_deviation_mm : (3,) float64
        Standard deviations about and along x, y, z.
    rms
        Of the residuals, in `unit`.
    unit
        ``px`` (boards in two pictures) or ``raw`` (boards in colour and disparity).
    pairs
        Names of the pictures used.
    """

    depth2color: FloatArray
    rotation_deviation_deg: FloatArray
    translation_deviation_mm: FloatArray
    rms: float
    unit: Unit
    pairs: tuple[str, ...]

    @property
    def baseline_mm(self) -> float:
        """Distance of the two cameras."""
        return float(np.linalg.norm(self.depth2color[:3, 3]))

    @property
    def rotation_deg(self) -> float:
        """Angle between the two cameras."""
        return rotation_angle_deg(self.depth2color[:3, :3])


@dataclass(frozen=True, eq=False)
class PairCalibration:
    """Both cameras and the pose between them.

    Parameters
    ----------
    values, deviations
        Both cameras' `LENS` and their standard deviations, as ``depth fx`` … ``color p2``.
    """

    stereo: StereoCalibration
    depth_camera: PinholeCamera
    color_camera: PinholeCamera
    values: dict[str, float]
    deviations: dict[str, float]


def calibrate_stereo(
    depth: Sequence[BoardDetection],
    color: Sequence[BoardDetection],
    depth_camera: PinholeCamera,
    color_camera: PinholeCamera,
) -> PairCalibration:
    """Fit the pose between the cameras to boards that both see, and refine both cameras with it.

    A camera fitted alone places the boards slightly too near or aside, where they look the same to
    it. As the cameras do not move relative to each other, refining both together resolves this.

    Parameters
    ----------
    depth, color
        Detections of the same board positions, in the same order; those of the depth camera in the
        pixels of `depth_camera` (see `board.shifted`).
    depth_camera, color_camera
        As calibrated alone: initial values and prior of the fit.

    Returns
    -------
    PairCalibration
        With the root mean square of a corner's distance in px.

    Raises
    ------
    CalibrationError
        If there are fewer than three pairs.
    """
    pairs = [common_corners(a, b) for a, b in zip(depth, color, strict=True)]
    pairs = [(a, b) for a, b in pairs if len(a.pixels) >= _LEAST_COMMON]
    if len(pairs) < _LEAST_PAIRS:
        raise CalibrationError(
            "The board is seen by both cameras in {count} pairs of pictures, but {least} are "
            "needed; take infrared and colour pictures of the same positions.",
            count=len(pairs),
            least=_LEAST_PAIRS,
        )
    problem = _Pairs(tuple(pairs), depth_camera, color_camera)
    solution = least_squares(problem.residuals, problem.start(), problem.blocks())
    fitted_depth, fitted_color = problem.cameras(solution.values)
    # Per corner, like the errors of the single cameras: two residuals each.
    residuals_px = solution.residuals[: -len(_SPREAD)] * _CORNER_PX
    rms = float(np.sqrt((residuals_px**2).mean() * 2))
    names = [f"{kind} {name}" for kind in ("depth", "color") for name in LENS]
    return PairCalibration(
        as_stereo(solution, rms, "px", tuple(a.name for a, _ in pairs)),
        fitted_depth,
        fitted_color,
        dict(zip(names, solution.values[6:_SHARED].tolist(), strict=True)),
        dict(zip(names, solution.std[6:_SHARED].tolist(), strict=True)),
    )


@dataclass(frozen=True, eq=False)
class _Pairs:
    """The least squares problem: the pose of the cameras, both lenses, and a pose per board."""

    pairs: tuple[tuple[BoardDetection, BoardDetection], ...]
    depth_camera: PinholeCamera
    color_camera: PinholeCamera

    @cached_property
    def usual(self) -> FloatArray:
        """Prior mean of both lenses."""
        given = [parameters_of(camera) for camera in (self.depth_camera, self.color_camera)]
        return np.array([known[name] for known in given for name in LENS])

    def start(self) -> FloatArray:
        boards = [board_pose(a, self.depth_camera) for a, _ in self.pairs]
        between = [
            board_pose(b, self.color_camera) @ inverse(placed)
            for (_, b), placed in zip(self.pairs, boards, strict=True)
        ]
        first = min(between, key=lambda one: sum(float(np.abs(one - o).sum()) for o in between))
        return np.concatenate([pose_vector(first), self.usual, *map(pose_vector, boards)])

    def cameras(self, unknowns: FloatArray) -> tuple[PinholeCamera, PinholeCamera]:
        of_depth, of_color = np.split(unknowns[6:_SHARED], 2)
        return (
            with_parameters(self.depth_camera, dict(zip(LENS, of_depth.tolist(), strict=True))),
            with_parameters(self.color_camera, dict(zip(LENS, of_color.tolist(), strict=True))),
        )

    def residuals(self, unknowns: FloatArray) -> FloatArray:
        """Return the errors of all corners, board by board, followed by those of the prior."""
        depth_camera, color_camera = self.cameras(unknowns)
        depth2color = pose(unknowns[:6])
        points = np.concatenate(
            [
                transform(pose(vector), a.points_mm)
                for (a, _), vector in zip(
                    self.pairs, unknowns[_SHARED:].reshape(-1, 6), strict=True
                )
            ]
        )
        seen = np.concatenate([np.hstack([a.pixels, b.pixels]) for a, b in self.pairs])
        expected = [
            depth_camera.project(points),
            color_camera.project(transform(depth2color, points)),
        ]
        corners = (seen - np.hstack(expected)).ravel() / _CORNER_PX
        return np.concatenate([corners, (unknowns[6:_SHARED] - self.usual) / _SPREAD])

    def blocks(self) -> Blocks:
        lengths = [4 * len(a.pixels) for a, _ in self.pairs]
        lengths[-1] += len(_SPREAD)  # the prior of the lenses depends on no board
        return Blocks(tuple(lengths), _SHARED)


def as_stereo(
    solution: Adjustment, rms: float, unit: Unit, pairs: tuple[str, ...]
) -> StereoCalibration:
    """Read the pose from the first six unknowns of a fit.

    Parameters
    ----------
    rms
        Of the residuals, in `unit`: ``px`` or ``raw``.
    pairs
        Names of the pictures used.
    """
    return StereoCalibration(
        depth2color=pose(solution.values[:6]),
        rotation_deviation_deg=np.degrees(solution.std[:3]),
        translation_deviation_mm=solution.std[3:6],
        rms=rms,
        unit=unit,
        pairs=pairs,
    )


def common_corners(a: BoardDetection, b: BoardDetection) -> tuple[BoardDetection, BoardDetection]:
    """Keep the corners detected in both pictures, in the same order."""
    same = (np.abs(a.points_mm[:, None] - b.points_mm[None]).max(-1) < 1e-6).nonzero()
    return _taking(a, same[0]), _taking(b, same[1])


def board_pose(detection: BoardDetection, camera: PinholeCamera) -> FloatArray:
    """Estimate the pose ``board2camera`` (4, 4), mm, of a board in one picture."""
    rays = camera.normalised(detection.pixels)
    _, turn, shift = cv2.solvePnP(detection.points_mm, rays, np.eye(3), None)
    return rigid(cv2.Rodrigues(turn)[0], shift.ravel())


def _taking(detection: BoardDetection, which: IntArray) -> BoardDetection:
    return BoardDetection(
        detection.name, detection.size, detection.points_mm[which], detection.pixels[which]
    )
