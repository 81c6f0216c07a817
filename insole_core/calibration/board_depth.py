"""The pose between the cameras from colour pictures and raw depth of a board; needs no infrared.

The colour camera knows the board's plane, the depth sensor measures it: with boards tilted to all
sides, one rigid transform makes the two agree. What limits it: planes tell the rotation well, but a
shift only as far as the boards are tilted; and a distortion that is left in the depth, or a wrong
focal length of the depth camera, goes into the pose, because a plane that is a little deeper on one
side cannot be told from a camera that is turned.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np

from insole_core.calibration.adjustment import Adjustment, Blocks, adjust, pose, pose_vector
from insole_core.calibration.board import Sighting
from insole_core.calibration.captures import read_depth
from insole_core.calibration.disparity_fit import linear_inverse_near
from insole_core.calibration.stereo import StereoCalibration, as_stereo, board_pose
from insole_core.calibration.wall_plane import expected_raw
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.transforms import inverse, rigid, transform
from insole_core.sensing.camera import Camera
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.disparity import NO_READING, DisparityModel, LinearInverseDisparity

_TYPICAL = rigid(np.eye(3), np.array([-25.0, 0.0, 0.0]))
_LEAST_BOARDS = 4
_LEAST_PIXELS = 200
_NEAR_RAW = 30.0
_SAMPLES = 100
_CORNER_PX = 0.2
_DEPTH_RAW = 1.5
"""The usual errors of a corner and of a corrected raw number (which errs together with its
neighbours, so that it counts for less than its noise)."""
_OUTLIER = 4.0
_ROUNDS = 2
_LEAST_TILT_DEG = 3.0
_MARGIN_PX = 4
_CHI2_MEDIAN = 0.455
"""Median of a squared normal variable: a root mean square that outliers do not reach."""


@dataclass(frozen=True, eq=False)
class BoardInDepth:
    """One board position, in colour and in raw depth.

    Parameters
    ----------
    color
        The board in the colour picture.
    raw : (480, 640) float64, raw units, corrected for distortion, NaN = no reading
    """

    color: Sighting
    raw: FloatArray


def read_boards_in_depth(
    folder: Path, sightings: Sequence[Sighting], correction: DisparityCorrection | None = None
) -> list[BoardInDepth]:
    """Read the raw depth beside each colour picture: ``depth_003.png`` beside ``color_003.jpg``.

    Raises
    ------
    InputError
        When a depth image is missing or cannot be read.
    """
    boards = []
    for sighting in sightings:
        number = Path(sighting.name).stem.removeprefix("color")
        frame = read_depth(folder / f"depth{number}.png")
        raw = np.where(frame < NO_READING, frame, np.nan)
        boards.append(BoardInDepth(sighting, correction.corrected(raw) if correction else raw))
    return boards


@dataclass(frozen=True)
class BoardDepthOptions:
    """What is fitted beside the pose.

    Parameters
    ----------
    fit_disparity
        The two numbers of the linear-inverse model: the board's true size gives the scale.
    fit_centre
        The principal point of the depth camera; its focal length is taken as it is.
    """

    fit_disparity: bool = True
    fit_centre: bool = True


@dataclass(frozen=True, eq=False)
class BoardDepthCalibration:
    """The depth sensor beside the colour camera.

    Parameters
    ----------
    stereo
    depth_camera, disparity
        As given, or as fitted.
    deviations
        Standard deviations of the fitted numbers: a, b, cx, cy.
    """

    stereo: StereoCalibration
    depth_camera: Camera
    disparity: DisparityModel
    deviations: dict[str, float]


def calibrate_board_depth(
    boards: Sequence[BoardInDepth],
    depth_camera: Camera,
    color_camera: Camera,
    disparity: DisparityModel,
    options: BoardDepthOptions | None = None,
) -> BoardDepthCalibration:
    """Fit the pose of the depth camera beside the colour camera.

    Raises
    ------
    CalibrationError
        With fewer than four boards, or boards that are all parallel.
    """
    options = options or BoardDepthOptions()
    board2color = [board_pose(board.color, color_camera) for board in boards]
    depth2color, seen = _TYPICAL, list(range(len(boards)))
    for _ in range(_ROUNDS):
        patches = [
            _patch(boards[i], board2color[i], depth2color, depth_camera) for i in range(len(boards))
        ]
        seen = [i for i, (_, values) in enumerate(patches) if len(values)]
        _check(len(seen), [board2color[i] for i in seen])
        problem = _Problem(
            [boards[i].color for i in seen],
            [patches[i] for i in seen],
            depth_camera,
            color_camera,
            disparity,
            options,
        )
        start = problem.start(depth2color, [board2color[i] for i in seen])
        found = adjust(problem.residuals, start, problem.blocks(), robust=_OUTLIER)
        depth2color = pose(found.values)
    camera, fitted = problem.read(found.values)
    return BoardDepthCalibration(
        as_stereo(found, problem.rms_raw(found), "raw", tuple(boards[i].color.name for i in seen)),
        camera,
        fitted,
        dict(zip(problem.names, found.deviations[6:].tolist(), strict=False)),
    )


@dataclass(frozen=True, eq=False)
class _Problem:
    """What the unknowns mean: pose of the cameras, the numbers of `names`, a pose per board.

    The boards' own poses are free, so that the colour camera's uncertainty about them counts.
    """

    sightings: Sequence[Sighting]
    patches: Sequence[tuple[FloatArray, FloatArray]]
    depth_camera: Camera
    color_camera: Camera
    disparity: DisparityModel
    options: BoardDepthOptions

    @property
    def names(self) -> tuple[str, ...]:
        disparity = ("a", "b") if self.options.fit_disparity else ()
        return disparity + (("cx", "cy") if self.options.fit_centre else ())

    @property
    def shared(self) -> int:
        return 6 + len(self.names)

    def start(self, depth2color: FloatArray, board2color: Sequence[FloatArray]) -> FloatArray:
        numbers: list[float] = []
        if self.options.fit_disparity:
            raw = np.concatenate([values for _, values in self.patches])
            model = linear_inverse_near(self.disparity, raw)
            numbers += [model.a, model.b]
        if self.options.fit_centre:
            numbers += [self.depth_camera.cx, self.depth_camera.cy]
        poses = [pose_vector(placed) for placed in board2color]
        return np.concatenate([pose_vector(depth2color), numbers, *poses])

    def read(self, unknowns: FloatArray) -> tuple[Camera, DisparityModel]:
        values = dict(zip(self.names, unknowns[6 : self.shared].tolist(), strict=True))
        centre = {key: values[key] for key in ("cx", "cy") if key in values}
        model = self.disparity
        if "a" in values:
            model = LinearInverseDisparity(values["a"], values["b"])
        return replace(self.depth_camera, **centre), model

    def residuals(self, unknowns: FloatArray) -> FloatArray:
        """Errors of all corners and raw numbers, each against its usual size."""
        camera, model = self.read(unknowns)
        placed = [pose(vector) for vector in unknowns[self.shared :].reshape(-1, 6)]
        planes = board_planes(placed, pose(unknowns))
        parts = []
        for sighting, board, (pixels, raw), plane in zip(
            self.sightings, placed, self.patches, planes, strict=True
        ):
            corners = self.color_camera.project(transform(board, sighting.points_mm))
            rays = camera.normalised(pixels)
            rows = np.concatenate([rays, np.ones((len(rays), 1))], axis=-1)
            parts.append((sighting.pixels - corners).ravel() / _CORNER_PX)
            parts.append((raw - expected_raw(plane, rows, model)) / _DEPTH_RAW)
        return np.concatenate(parts)

    def blocks(self) -> Blocks:
        lengths = tuple(
            2 * len(sighting.pixels) + len(raw)
            for sighting, (_, raw) in zip(self.sightings, self.patches, strict=True)
        )
        return Blocks(lengths, self.shared)

    def rms_raw(self, found: Adjustment) -> float:
        """Root mean square of the depth residuals, raw units, that outliers do not reach."""
        lengths = [
            length
            for sighting, (_, raw) in zip(self.sightings, self.patches, strict=True)
            for length in (2 * len(sighting.pixels), len(raw))
        ]
        parts = np.split(found.residuals, np.cumsum(lengths)[:-1])
        depth = np.concatenate(parts[1::2]) * _DEPTH_RAW
        return float(np.sqrt(np.median(depth**2) / _CHI2_MEDIAN))


def board_planes(board2color: Sequence[FloatArray], depth2color: FloatArray) -> list[FloatArray]:
    """Give the planes 1/Z = plane · (x, y, 1) of boards in the depth camera frame, 1/mm."""
    planes = []
    for placed in board2color:
        normal, point = placed[:3, 2], placed[:3, 3]
        distance = normal @ (point - depth2color[:3, 3])
        planes.append(depth2color[:3, :3].T @ normal / distance)
    return planes


def _patch(
    board: BoardInDepth,
    board2color: FloatArray,
    depth2color: FloatArray,
    depth_camera: Camera,
) -> tuple[FloatArray, FloatArray]:
    """Pick pixels that certainly show the board: pixels (k, 2) and raw numbers (k,)."""
    inside = _outline(board.color, inverse(depth2color) @ board2color, depth_camera)
    inside &= np.isfinite(board.raw)
    if inside.sum() < _LEAST_PIXELS:
        return np.empty((0, 2)), np.empty(0)
    v, u = np.nonzero(inside)
    raw, pixels = board.raw[inside], np.stack([u, v], axis=-1).astype(float)
    columns = np.column_stack([pixels, np.ones(len(pixels))])
    flat = columns @ np.linalg.lstsq(columns, raw, rcond=None)[0]
    near = np.abs(raw - flat - np.median(raw - flat)) < _NEAR_RAW
    step = max(1, int(near.sum()) // _SAMPLES)
    return pixels[near][::step], raw[near][::step]


def _outline(sighting: Sighting, board2depth: FloatArray, depth_camera: Camera) -> BoolArray:
    """Fill the area between the corners as the depth camera sees it, less a margin."""
    corners = depth_camera.project(transform(board2depth, sighting.points_mm))
    mask = np.zeros((depth_camera.height, depth_camera.width), np.uint8)
    cv2.fillConvexPoly(mask, cv2.convexHull(np.round(corners).astype(np.int32)), 1)
    width = 2 * _MARGIN_PX + 1
    return np.asarray(cv2.erode(mask, np.ones((width, width), np.uint8)) > 0)


def _check(count: int, board2color: Sequence[FloatArray]) -> None:
    if count < _LEAST_BOARDS:
        raise CalibrationError(
            f"The board is seen in colour and depth at {count} positions, but {_LEAST_BOARDS} are "
            "needed; hold it 600 to 1500 mm from the sensor and take more."
        )
    normals = np.array([placed[:3, 2] * np.sign(placed[2, 2] or 1) for placed in board2color])
    # The least eigenvalue: the tilt about the axis with the least tilts.
    if np.linalg.eigvalsh(np.cov(normals[:, :2].T))[0] < np.sin(np.radians(_LEAST_TILT_DEG)) ** 2:
        raise CalibrationError(
            "The boards are tilted too little to tell where the depth camera stands; tilt the "
            "board by 20 to 40 degrees about both of its sides and take more."
        )
