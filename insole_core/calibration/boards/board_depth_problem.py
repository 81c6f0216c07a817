"""Unknowns and residuals of the fit of boards in colour and depth."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from insole_core.calibration.boards.board import BoardDetection
from insole_core.calibration.boards.boards_in_depth import board_planes
from insole_core.calibration.boards.intrinsics import LENS, parameters_of, with_parameters
from insole_core.calibration.depth_sensor import DepthSensor
from insole_core.calibration.least_squares import Adjustment, Blocks, pose, pose_vector
from insole_core.calibration.walls.disparity_fit import linear_inverse_near
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.transforms import rigid
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera

USUAL_POSE = rigid(np.eye(3), np.array([-25.0, 0.0, 0.0]))
_LOOSE = np.inf
_SPREAD = {
    "pose": (_LOOSE, _LOOSE, _LOOSE, 5.0, 3.0, 3.0),
    "disparity": (_LOOSE, _LOOSE),
    "centre": (10.0, 10.0),
    "focal": (6.0, 6.0),
    "tilt": (2.0, 2.0),
}
"""Standard deviations of the devices from the usual one (mm, px, raw units): both cameras are on
one bar. This prior separates unknowns that a few boards cannot, such as focal length and
translation along the axis."""
CORNER, _DEPTH, _USUAL = 0, 1, 2
"""Kinds of residuals."""
_CHI2_MEDIAN = 0.455
"""Median of a squared normal variable, for a root mean square that is robust to outliers."""
NUMBERS = {
    "disparity": ("a", "b"),
    "centre": ("cx", "cy"),
    "focal": ("fx", "fy"),
    "tilt": ("tilt_x", "tilt_y"),
}
"""The unknowns of each option, by name."""


@dataclass(frozen=True)
class Errors:
    """Standard errors of a corner, and of a raw number averaged over 8 x 8 pixels.

    They are estimated from the residuals, but never below those of a Kinect: errors common to a
    whole board do not show in the residuals.
    """

    corner_px: float = 0.2
    depth_raw: float = 0.4


LEAST_ERRORS = Errors()


@dataclass(frozen=True, eq=False)
class Measured:
    """All corners (n) and all depth patches (k), concatenated, each with the index of its board."""

    boards: int
    corner_board: IntArray
    points_mm: FloatArray
    corners: FloatArray
    patch_board: IntArray
    pixels: FloatArray
    raw: FloatArray


def measured_of(
    detections: Sequence[BoardDetection], patches: Sequence[tuple[FloatArray, FloatArray]]
) -> Measured:
    """Concatenate the corners and the depth patches of all boards.

    Parameters
    ----------
    detections
        One for each board.
    patches
        For each board its pixels (k, 2) and raw numbers (k,), see `boards_in_depth.board_patch`.
    """
    numbers = np.arange(len(detections))
    return Measured(
        len(detections),
        np.repeat(numbers, [len(detection.pixels) for detection in detections]),
        np.concatenate([detection.points_mm for detection in detections]),
        np.concatenate([detection.pixels for detection in detections]),
        np.repeat(numbers, [len(raw) for _, raw in patches]),
        np.concatenate([pixels for pixels, _ in patches]),
        np.concatenate([raw for _, raw in patches]),
    )


@dataclass(frozen=True, eq=False)
class Problem:
    """The least squares problem: pose of the cameras, the numbers of `names`, a pose per board.

    The boards' own poses are free, so that the colour camera's uncertainty about them counts. The
    numbers of the colour camera follow those of `names` if it is free too.
    """

    measured: Measured
    color_camera: PinholeCamera
    guess: DepthSensor
    names: tuple[str, ...]
    errors: Errors
    color_free: bool = False

    @property
    def shared(self) -> int:
        """Number of unknowns that act on all boards."""
        return self.fitted + (len(LENS) if self.color_free else 0)

    @property
    def color_values(self) -> FloatArray:
        """The colour camera's parameters, in the order of `LENS`."""
        known = parameters_of(self.color_camera)
        return np.array([known[name] for name in LENS])

    @property
    def fitted(self) -> int:
        """Number of shared unknowns without those of the colour camera."""
        return 6 + len(self.names)

    @cached_property
    def usual(self) -> FloatArray:
        """Prior mean and initial values of the shared unknowns."""
        camera, model = (
            self.guess.camera,
            linear_inverse_near(self.guess.disparity, self.measured.raw),
        )
        known = {"a": model.a, "b": model.b, "cx": camera.cx, "cy": camera.cy}
        known |= {"fx": camera.fx, "fy": camera.fy, "tilt_x": 0.0, "tilt_y": 0.0}
        return np.array([*pose_vector(USUAL_POSE), *(known[name] for name in self.names)])

    @cached_property
    def spread(self) -> FloatArray:
        """Prior standard deviations of the shared unknowns."""
        named = {
            name: spread
            for option, names in NUMBERS.items()
            for name, spread in zip(names, _SPREAD[option], strict=True)
        }
        return np.array([*_SPREAD["pose"], *(named[name] for name in self.names)])

    def start(
        self, depth2color: FloatArray, numbers: FloatArray, board2color: Sequence[FloatArray]
    ) -> FloatArray:
        """Assemble the vector of unknowns.

        Parameters
        ----------
        depth2color : (4, 4) float64, mm
        numbers
            In the order of `names`, and of `LENS` if the colour camera is free.
        board2color : for each board (4, 4) float64, mm
        """
        poses = [pose_vector(placed) for placed in board2color]
        return np.concatenate([pose_vector(depth2color), numbers, *poses])

    def read(self, unknowns: FloatArray) -> DepthSensor:
        """Return the depth sensor that the unknowns describe."""
        values = dict(zip(self.names, unknowns[6 : self.fitted].tolist(), strict=True))
        camera = {key: values[key] for key in ("cx", "cy", "fx", "fy") if key in values}
        disparity = self.guess.disparity
        if "a" in values:
            disparity = LinearInverseDisparity(values["a"], values["b"])
        tilt_raw = values.get("tilt_x", 0.0), values.get("tilt_y", 0.0)
        return DepthSensor(replace(self.guess.camera, **camera), disparity, tilt_raw)

    def _color(self, unknowns: FloatArray) -> PinholeCamera:
        if not self.color_free:
            return self.color_camera
        values = unknowns[self.fitted : self.shared].tolist()
        return with_parameters(self.color_camera, dict(zip(LENS, values, strict=True)))

    def residuals(self, unknowns: FloatArray) -> FloatArray:
        """Return the errors of corners and raw numbers, relative to `errors`, board by board."""
        here, depth = self.measured, self.read(unknowns)
        placed = np.array([pose(vector) for vector in unknowns[self.shared :].reshape(-1, 6)])
        of_corner = placed[here.corner_board]
        points = (of_corner[:, :3, :3] @ here.points_mm[..., None])[..., 0] + of_corner[:, :3, 3]
        corners = here.corners - self._color(unknowns).project(points)
        planes = board_planes(placed, pose(unknowns))[here.patch_board]
        raw = here.raw - depth.raw(planes, here.pixels)
        both = (corners.ravel() / self.errors.corner_px, raw / self.errors.depth_raw)
        unusual = (unknowns[: self.fitted] - self.usual) / self.spread
        return np.concatenate([np.concatenate(both)[self._order], unusual])

    def blocks(self) -> Blocks:
        """Return which residuals depend on which unknowns."""
        lengths = np.bincount(self._boards, minlength=self.measured.boards)
        lengths[-1] += self.fitted  # the prior depends on no board: it closes the last block
        return Blocks(tuple(lengths.tolist()), self.shared)

    def found_errors(self, solution: Adjustment) -> Errors:
        """Return the robust root mean squares of the residuals, at least `LEAST_ERRORS`."""
        kinds, residuals = self.kinds, solution.residuals
        return Errors(
            max(
                _typical(residuals[kinds == CORNER]) * self.errors.corner_px, LEAST_ERRORS.corner_px
            ),
            max(
                _typical(residuals[kinds == _DEPTH]) * self.errors.depth_raw, LEAST_ERRORS.depth_raw
            ),
        )

    def noise(self, residuals: FloatArray) -> FloatArray:
        """Return the standard deviation (m,) of every residual, from all residuals of its kind."""
        kinds = self.kinds
        of_kind = [_typical(residuals[kinds == CORNER]), _typical(residuals[kinds == _DEPTH]), 1.0]
        return np.asarray(of_kind)[kinds]

    @cached_property
    def kinds(self) -> IntArray:
        """(m,) whether a residual belongs to a corner, to the depth, or to the prior."""
        here = self.measured
        seen = np.repeat([CORNER, _DEPTH], [2 * len(here.corners), len(here.raw)])[self._order]
        return np.concatenate([seen, np.full(self.fitted, _USUAL)])

    @property
    def _boards(self) -> IntArray:
        """The board of every residual: first two of each corner, then those of the patches."""
        return np.concatenate([np.repeat(self.measured.corner_board, 2), self.measured.patch_board])

    @cached_property
    def _order(self) -> IntArray:
        return np.argsort(self._boards, kind="stable")


def _typical(residuals: FloatArray) -> float:
    return float(np.sqrt(np.median(residuals**2) / _CHI2_MEDIAN))
