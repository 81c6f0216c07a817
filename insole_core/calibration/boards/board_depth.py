"""The pose between the cameras from colour pictures and raw depth of a board; needs no infrared.

The colour camera gives the board's plane, the depth sensor measures it. A plane in front of the
colour camera is a plane over the pixels of the raw image, by one projective map of space; its
parameters are the pose, the depth camera, the disparity model, and the plane that walls cannot
determine. The accuracy is limited by the errors of the corners, since a translation is only
determined by the tilt of the boards, and by distortion that remains in the depth.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from insole_core.calibration.boards.board_depth_problem import (
    CORNER,
    LEAST_ERRORS,
    NUMBERS,
    USUAL_POSE,
    Problem,
    measured_of,
)
from insole_core.calibration.boards.boards_in_depth import BoardInDepth, board_patch
from insole_core.calibration.boards.intrinsics import LENS
from insole_core.calibration.boards.stereo import StereoCalibration, as_stereo, board_pose
from insole_core.calibration.depth_sensor import DepthSensor
from insole_core.calibration.least_squares import Adjustment, huber_weight, least_squares, pose
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import FloatArray
from insole_core.sensing.disparity import DisparityModel
from insole_core.sensing.pinhole_camera import PinholeCamera

_LEAST_BOARDS = 4
_OUTLIER = 4.0
_ROUNDS = 3
_LEAST_TILT_DEG = 3.0


@dataclass(frozen=True)
class BoardDepthOptions:
    """Parameters that are fitted besides the pose.

    Parameters
    ----------
    disparity
        The two numbers of the linear-inverse model: the board's true size gives the scale.
    centre, focal
        Principal point and focal lengths of the depth camera.
    tilt
        The plane over the image that is added to all raw numbers, which walls cannot determine.
    """

    disparity: bool = True
    centre: bool = True
    focal: bool = True
    tilt: bool = True


@dataclass(frozen=True, eq=False)
class BoardDepthCalibration:
    """The depth sensor beside the colour camera.

    Parameters
    ----------
    depth
        As given, with the fitted numbers replaced.
    values, deviations
        The fitted numbers and their standard deviations, by name: a, b, cx, cy, fx, fy, tilt_x,
        tilt_y. Like those of the pose, they assume that the colour camera is known no better than
        from the corners of these boards.
    """

    stereo: StereoCalibration
    depth: DepthSensor
    values: dict[str, float]
    deviations: dict[str, float]


def calibrate_board_depth(
    boards: Sequence[BoardInDepth],
    depth_camera: PinholeCamera,
    color_camera: PinholeCamera,
    disparity: DisparityModel,
    options: BoardDepthOptions | None = None,
) -> BoardDepthCalibration:
    """Fit the pose of the depth camera relative to the colour camera.

    Parameters
    ----------
    boards
        At least four, tilted in different directions.
    depth_camera, disparity
        Initial values; kept where `options` does not fit them.
    color_camera
        Calibrated.

    Returns
    -------
    BoardDepthCalibration
        With the root mean square of the depth residuals in raw units.

    Raises
    ------
    CalibrationError
        If there are fewer than four boards, or all are parallel.
    """
    names, errors = _names(options or BoardDepthOptions()), LEAST_ERRORS
    guess = depth = DepthSensor(depth_camera, disparity)
    depth2color = USUAL_POSE
    board2color = [board_pose(board.color, color_camera) for board in boards]
    numbers: FloatArray | None = None
    for _ in range(_ROUNDS):
        patches = [
            board_patch(board, placed, depth2color, depth.camera)
            for board, placed in zip(boards, board2color, strict=True)
        ]
        seen = [i for i, (_, raw) in enumerate(patches) if len(raw)]
        _check(len(seen), [board2color[i] for i in seen])
        measured = measured_of([boards[i].color for i in seen], [patches[i] for i in seen])
        problem = Problem(measured, color_camera, guess, names, errors)
        if numbers is None:
            numbers = problem.usual[6:]
        start = problem.start(depth2color, numbers, [board2color[i] for i in seen])
        solution = least_squares(problem.residuals, start, problem.blocks(), robust=_OUTLIER)
        depth2color, depth = pose(solution.values), problem.read(solution.values)
        numbers = solution.values[6 : problem.shared]
        errors = problem.found_errors(solution)
    solution = _judged(problem, solution)
    return BoardDepthCalibration(
        as_stereo(solution, errors.depth_raw, "raw", tuple(boards[i].color.name for i in seen)),
        depth,
        dict(zip(names, solution.values[6:].tolist(), strict=False)),
        dict(zip(names, solution.std[6:].tolist(), strict=False)),
    )


def _judged(problem: Problem, solution: Adjustment) -> Adjustment:
    """Return the solution with the colour camera's own errors in its standard deviations.

    The colour camera came from a fit to corners like these. Its errors are independent of those of
    a fit in which it is held, since they are orthogonal to all poses of the boards; so the two
    covariances add up. Corners and depth each have the noise that their residuals show, whatever
    their weights.
    """
    count, colors = problem.shared, len(LENS)
    open_color = replace(problem, color_free=True)
    values = np.concatenate(
        [solution.values[:count], problem.color_values, solution.values[count:]]
    )
    residuals = open_color.residuals(values)
    jacobian = open_color.blocks().jacobian(open_color.residuals, values)
    color = jacobian[:, count : count + colors]
    held = np.delete(jacobian, np.arange(count, count + colors), axis=1)
    weight, noise = huber_weight(residuals, _OUTLIER), open_color.noise(residuals)
    solve = _solver(held, weight)
    spread = solve(held.T * (weight * noise))[:count]
    corner = open_color.kinds == CORNER
    own_poses = held[corner][:, count:]
    across = color[corner] - own_poses @ np.linalg.lstsq(own_poses, color[corner], rcond=None)[0]
    color_spread = _solver(across, np.ones(len(across)))(across.T * noise[corner])
    follows = solve(held.T @ (weight[:, None] * color))[:count] @ color_spread
    shared = np.sqrt((spread**2).sum(1) + (follows**2).sum(1))
    return replace(solution, std=np.concatenate([shared, solution.std[count:]]))


def _solver(jacobian: FloatArray, weight: FloatArray) -> Callable[[FloatArray], FloatArray]:
    """Return a solver of the normal equations, scaled so that rad, mm and px are comparable."""
    scale = np.sqrt((weight[:, None] * jacobian**2).sum(0)) + 1e-12
    scaled = jacobian / scale
    inverse = np.linalg.pinv(scaled.T @ (weight[:, None] * scaled), rcond=1e-13, hermitian=True)
    return lambda right: (inverse @ (right.T / scale).T) / scale[:, None]


def _names(options: BoardDepthOptions) -> tuple[str, ...]:
    chosen = (field.name for field in fields(options) if getattr(options, field.name))
    return tuple(name for option in chosen for name in NUMBERS[option])


def _check(count: int, board2color: Sequence[FloatArray]) -> None:
    if count < _LEAST_BOARDS:
        raise CalibrationError(
            "The board is seen in colour and depth at {count} positions, but {least} are needed; "
            "hold it 600 to 1500 mm from the sensor and take more.",
            count=count,
            least=_LEAST_BOARDS,
        )
    normals = np.array([placed[:3, 2] * np.sign(placed[2, 2] or 1) for placed in board2color])
    # The least eigenvalue measures the tilt about the axis with the least tilts.
    if np.linalg.eigvalsh(np.cov(normals[:, :2].T))[0] < np.sin(np.radians(_LEAST_TILT_DEG)) ** 2:
        raise CalibrationError(
            "The boards are tilted too little to tell where the depth camera stands; tilt the "
            "board by 20 to 40 degrees about both of its sides and take more."
        )
