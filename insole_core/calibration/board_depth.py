"""The pose between the cameras from colour pictures and raw depth of a board; needs no infrared.

The colour camera knows the board's plane, the depth sensor measures it. A plane before the colour
camera is a plane over the pixels of the raw image, by one projective map of space; its numbers are
the pose, the depth camera, the disparity model, and the plane that walls cannot tell. What limits
it: the errors of the corners, since a shift is told only as far as the boards are tilted, and a
distortion that is left in the depth.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from insole_core.calibration.adjustment import (
    Adjustment,
    Blocks,
    adjust,
    huber_weight,
    pose,
    pose_vector,
)
from insole_core.calibration.board import Sighting
from insole_core.calibration.boards_in_depth import BoardInDepth, board_patch, board_planes
from insole_core.calibration.disparity_fit import linear_inverse_near
from insole_core.calibration.intrinsics import parameters_of
from insole_core.calibration.stereo import StereoCalibration, as_stereo, board_pose
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.transforms import rigid
from insole_core.sensing.camera import Camera
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.disparity import DisparityModel, LinearInverseDisparity

_TYPICAL = rigid(np.eye(3), np.array([-25.0, 0.0, 0.0]))
_LOOSE = np.inf
_SPREAD = {
    "pose": (_LOOSE, _LOOSE, _LOOSE, 5.0, 3.0, 3.0),
    "disparity": (_LOOSE, _LOOSE),
    "centre": (10.0, 10.0),
    "focal": (6.0, 6.0),
    "tilt": (2.0, 2.0),
}
"""How far the sensors of a kind lie from the usual one (mm, px, raw units): both cameras sit on one
bar. It keeps apart what a few boards cannot tell from each other, such as focal length and shift
along the axis."""
_CORNER, _DEPTH, _USUAL = 0, 1, 2
_LEAST_BOARDS = 4
_OUTLIER = 4.0
_ROUNDS = 3
_LEAST_TILT_DEG = 3.0
_CHI2_MEDIAN = 0.455
"""Median of a squared normal variable: a root mean square that outliers do not reach."""


@dataclass(frozen=True)
class _Errors:
    """The usual errors of a corner, and of a raw number averaged over 8 x 8 pixels.

    They are taken from what the fit leaves, but never below those of a Kinect: what errs together
    over a whole board does not show in what is left.
    """

    corner_px: float = 0.2
    depth_raw: float = 0.4


_LEAST_ERRORS = _Errors()


@dataclass(frozen=True)
class BoardDepthOptions:
    """What is fitted beside the pose.

    Parameters
    ----------
    disparity
        The two numbers of the linear-inverse model: the board's true size gives the scale.
    centre, focal
        Principal point and focal lengths of the depth camera.
    tilt
        The plane over the image that is added to all raw numbers, which walls cannot tell.
    """

    disparity: bool = True
    centre: bool = True
    focal: bool = True
    tilt: bool = True


_NUMBERS = {
    "disparity": ("a", "b"),
    "centre": ("cx", "cy"),
    "focal": ("fx", "fy"),
    "tilt": ("tilt_x", "tilt_y"),
}
"""The unknowns of each option, by name."""
_COLOR = ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2")
"""What is uncertain of the colour camera, which is not fitted here."""


@dataclass(frozen=True, eq=False)
class DepthSensor:
    """What turns a plane in space into raw numbers.

    Parameters
    ----------
    camera
    disparity
    tilt_raw
        What is added to the raw numbers at the right edge, and at the lower edge, of the image.
    """

    camera: Camera
    disparity: DisparityModel
    tilt_raw: tuple[float, float] = (0.0, 0.0)

    def raw(self, planes: FloatArray, pixels: FloatArray) -> FloatArray:
        """Give the raw numbers (k,) of planes (k, 3), 1/Z = plane · (x, y, 1), at pixels (k, 2)."""
        rays = self.camera.normalised(pixels)
        inverse_depth = (planes[:, :2] * rays).sum(-1) + planes[:, 2]
        tilted = _tilt_columns(pixels, self.camera) @ np.asarray(self.tilt_raw)
        return np.asarray(self.disparity.raw(1 / inverse_depth) + tilted)


@dataclass(frozen=True, eq=False)
class BoardDepthCalibration:
    """The depth sensor beside the colour camera.

    Parameters
    ----------
    stereo
    depth
        As given, and as far as it was fitted.
    values, deviations
        The fitted numbers and their standard deviations, by name: a, b, cx, cy, fx, fy, tilt_x,
        tilt_y. Like those of the pose, they count the colour camera as known no better than the
        corners of these boards tell it.
    """

    stereo: StereoCalibration
    depth: DepthSensor
    values: dict[str, float]
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
    names, errors = _names(options or BoardDepthOptions()), _LEAST_ERRORS
    guess = depth = DepthSensor(depth_camera, disparity)
    depth2color = _TYPICAL
    board2color = [board_pose(board.color, color_camera) for board in boards]
    numbers: FloatArray | None = None
    for _ in range(_ROUNDS):
        patches = [
            board_patch(board, placed, depth2color, depth.camera)
            for board, placed in zip(boards, board2color, strict=True)
        ]
        seen = [i for i, (_, raw) in enumerate(patches) if len(raw)]
        _check(len(seen), [board2color[i] for i in seen])
        measured = _measured([boards[i].color for i in seen], [patches[i] for i in seen])
        problem = _Problem(measured, color_camera, guess, names, errors)
        if numbers is None:
            numbers = problem.usual[6:]
        start = problem.start(depth2color, numbers, [board2color[i] for i in seen])
        found = adjust(problem.residuals, start, problem.blocks(), robust=_OUTLIER)
        depth2color, depth = pose(found.values), problem.read(found.values)
        numbers = found.values[6 : problem.shared]
        errors = problem.found_errors(found)
    found = _judged(problem, found)
    return BoardDepthCalibration(
        as_stereo(found, errors.depth_raw, "raw", tuple(boards[i].color.name for i in seen)),
        depth,
        dict(zip(names, found.values[6:].tolist(), strict=False)),
        dict(zip(names, found.deviations[6:].tolist(), strict=False)),
    )


def _judged(problem: _Problem, found: Adjustment) -> Adjustment:
    """Give the standard deviations that the colour camera's own errors add to.

    The colour camera came from a fit to corners like these. Its errors are independent of those of
    a fit in which it is held, since they are across to all poses of the boards; so the two
    covariances add up. Corners and depth each have the noise that their residuals show, whatever
    weight they were given.
    """
    count, colors = problem.shared, len(_COLOR)
    open_color = replace(problem, color_free=True)
    values = np.concatenate([found.values[:count], problem.color_values, found.values[count:]])
    left = open_color.residuals(values)
    jacobian = open_color.blocks().jacobian(open_color.residuals, values)
    color = jacobian[:, count : count + colors]
    held = np.delete(jacobian, np.arange(count, count + colors), axis=1)
    weight, noise = huber_weight(left, _OUTLIER), open_color.noise(left)
    solve = _solver(held, weight)
    spread = solve(held.T * (weight * noise))[:count]
    corner = open_color.kinds == _CORNER
    own_poses = held[corner][:, count:]
    across = color[corner] - own_poses @ np.linalg.lstsq(own_poses, color[corner], rcond=None)[0]
    color_spread = _solver(across, np.ones(len(across)))(across.T * noise[corner])
    follows = solve(held.T @ (weight[:, None] * color))[:count] @ color_spread
    shared = np.sqrt((spread**2).sum(1) + (follows**2).sum(1))
    return replace(found, deviations=np.concatenate([shared, found.deviations[count:]]))


def _solver(jacobian: FloatArray, weight: FloatArray) -> Callable[[FloatArray], FloatArray]:
    """Solve the normal equations, scaled so that rad, mm and px go together."""
    scale = np.sqrt((weight[:, None] * jacobian**2).sum(0)) + 1e-12
    scaled = jacobian / scale
    inverse = np.linalg.pinv(scaled.T @ (weight[:, None] * scaled), rcond=1e-13, hermitian=True)
    return lambda right: (inverse @ (right.T / scale).T) / scale[:, None]


def add_tilt(
    correction: DisparityCorrection, camera: Camera, tilt_raw: tuple[float, float]
) -> DisparityCorrection:
    """Give a correction that takes the tilt of all raw numbers out as well."""
    v, u = np.indices(correction.offset.shape)
    columns = _tilt_columns(np.stack([u, v], axis=-1).reshape(-1, 2).astype(float), camera)
    tilted = (columns @ np.asarray(tilt_raw)).reshape(u.shape)
    return replace(correction, offset=(correction.offset + tilted).astype(np.float32))


def _tilt_columns(pixels: FloatArray, camera: Camera) -> FloatArray:
    """(k, 2) -1 to 1 from left to right, and from top to bottom, of the image."""
    half = np.array([camera.width, camera.height]) / 2
    return np.asarray((pixels + 0.5) / half - 1)


def _names(options: BoardDepthOptions) -> tuple[str, ...]:
    chosen = (field.name for field in fields(options) if getattr(options, field.name))
    return tuple(name for option in chosen for name in _NUMBERS[option])


@dataclass(frozen=True, eq=False)
class _Measured:
    """All corners (n) and all depth patches (k), one after the other, each with its board."""

    boards: int
    corner_board: IntArray
    points_mm: FloatArray
    corners: FloatArray
    patch_board: IntArray
    pixels: FloatArray
    raw: FloatArray


def _measured(
    sightings: Sequence[Sighting], patches: Sequence[tuple[FloatArray, FloatArray]]
) -> _Measured:
    numbers = np.arange(len(sightings))
    return _Measured(
        len(sightings),
        np.repeat(numbers, [len(sighting.pixels) for sighting in sightings]),
        np.concatenate([sighting.points_mm for sighting in sightings]),
        np.concatenate([sighting.pixels for sighting in sightings]),
        np.repeat(numbers, [len(raw) for _, raw in patches]),
        np.concatenate([pixels for pixels, _ in patches]),
        np.concatenate([raw for _, raw in patches]),
    )


@dataclass(frozen=True, eq=False)
class _Problem:
    """What the unknowns mean: pose of the cameras, the numbers of `names`, a pose per board.

    The boards' own poses are free, so that the colour camera's uncertainty about them counts. The
    numbers of the colour camera stand after those of `names` where it is free too.
    """

    measured: _Measured
    color_camera: Camera
    guess: DepthSensor
    names: tuple[str, ...]
    errors: _Errors
    color_free: bool = False

    @property
    def shared(self) -> int:
        return self._fitted + (len(_COLOR) if self.color_free else 0)

    @property
    def color_values(self) -> FloatArray:
        """Give the colour camera's own numbers, as `_COLOR` names them."""
        known = parameters_of(self.color_camera)
        return np.array([known[name] for name in _COLOR])

    @property
    def _fitted(self) -> int:
        return 6 + len(self.names)

    @cached_property
    def usual(self) -> FloatArray:
        """Where the shared unknowns begin and, as far as the spread says, stay."""
        camera, model = (
            self.guess.camera,
            linear_inverse_near(self.guess.disparity, self.measured.raw),
        )
        known = {"a": model.a, "b": model.b, "cx": camera.cx, "cy": camera.cy}
        known |= {"fx": camera.fx, "fy": camera.fy, "tilt_x": 0.0, "tilt_y": 0.0}
        return np.array([*pose_vector(_TYPICAL), *(known[name] for name in self.names)])

    @cached_property
    def spread(self) -> FloatArray:
        named = {
            name: spread
            for option, names in _NUMBERS.items()
            for name, spread in zip(names, _SPREAD[option], strict=True)
        }
        return np.array([*_SPREAD["pose"], *(named[name] for name in self.names)])

    def start(
        self, depth2color: FloatArray, numbers: FloatArray, board2color: Sequence[FloatArray]
    ) -> FloatArray:
        poses = [pose_vector(placed) for placed in board2color]
        return np.concatenate([pose_vector(depth2color), numbers, *poses])

    def read(self, unknowns: FloatArray) -> DepthSensor:
        values = dict(zip(self.names, unknowns[6 : self._fitted].tolist(), strict=True))
        camera = {key: values[key] for key in ("cx", "cy", "fx", "fy") if key in values}
        disparity = self.guess.disparity
        if "a" in values:
            disparity = LinearInverseDisparity(values["a"], values["b"])
        tilt_raw = values.get("tilt_x", 0.0), values.get("tilt_y", 0.0)
        return DepthSensor(replace(self.guess.camera, **camera), disparity, tilt_raw)

    def _color(self, unknowns: FloatArray) -> Camera:
        if not self.color_free:
            return self.color_camera
        fx, fy, cx, cy, *lens = unknowns[self._fitted : self.shared].tolist()
        k1, k2, p1, p2 = lens
        distortion = (k1, k2, p1, p2, self.color_camera.distortion[4])
        return replace(self.color_camera, fx=fx, fy=fy, cx=cx, cy=cy, distortion=distortion)

    def residuals(self, unknowns: FloatArray) -> FloatArray:
        """Errors of all corners and raw numbers, each against its usual size, board by board."""
        here, depth = self.measured, self.read(unknowns)
        placed = np.array([pose(vector) for vector in unknowns[self.shared :].reshape(-1, 6)])
        of_corner = placed[here.corner_board]
        points = (of_corner[:, :3, :3] @ here.points_mm[..., None])[..., 0] + of_corner[:, :3, 3]
        corners = here.corners - self._color(unknowns).project(points)
        planes = board_planes(placed, pose(unknowns))[here.patch_board]
        raw = here.raw - depth.raw(planes, here.pixels)
        both = (corners.ravel() / self.errors.corner_px, raw / self.errors.depth_raw)
        unusual = (unknowns[: self._fitted] - self.usual) / self.spread
        return np.concatenate([np.concatenate(both)[self._order], unusual])

    def blocks(self) -> Blocks:
        lengths = np.bincount(self._boards, minlength=self.measured.boards)
        lengths[-1] += self._fitted  # what is unusual depends on no board: it closes the last block
        return Blocks(tuple(lengths.tolist()), self.shared)

    def found_errors(self, found: Adjustment) -> _Errors:
        """Root mean squares of the residuals, that outliers do not reach."""
        kinds, left = self.kinds, found.residuals
        return _Errors(
            max(_typical(left[kinds == _CORNER]) * self.errors.corner_px, _LEAST_ERRORS.corner_px),
            max(_typical(left[kinds == _DEPTH]) * self.errors.depth_raw, _LEAST_ERRORS.depth_raw),
        )

    def noise(self, left: FloatArray) -> FloatArray:
        """Standard deviation (m,) of every residual, by what is left of its kind."""
        kinds = self.kinds
        of_kind = [_typical(left[kinds == _CORNER]), _typical(left[kinds == _DEPTH]), 1.0]
        return np.asarray(of_kind)[kinds]

    @cached_property
    def kinds(self) -> IntArray:
        """(m,) whether a residual is of a corner, of depth, or of what is usual."""
        here = self.measured
        seen = np.repeat([_CORNER, _DEPTH], [2 * len(here.corners), len(here.raw)])[self._order]
        return np.concatenate([seen, np.full(self._fitted, _USUAL)])

    @property
    def _boards(self) -> IntArray:
        """The board of every residual: first two of each corner, then those of the patches."""
        return np.concatenate([np.repeat(self.measured.corner_board, 2), self.measured.patch_board])

    @cached_property
    def _order(self) -> IntArray:
        return np.argsort(self._boards, kind="stable")


def _typical(left: FloatArray) -> float:
    return float(np.sqrt(np.median(left**2) / _CHI2_MEDIAN))


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
