"""The plane of a wall: detected in a depth image, or known from a board that the colour sees."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np

from insole_core.calibration.boards.board import Board, picture_paths, read_grey
from insole_core.calibration.boards.boards_in_depth import board_planes
from insole_core.calibration.boards.stereo import board_pose
from insole_core.calibration.walls.captures import WallCapture
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.sensing.disparity import DisparityModel
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

_TRIALS = 200
_SEARCH_STEP, _FIT_STEP = 16, 8
"""Pixels: of the search, and of the fit from which the map's solution starts."""
_NEAR_RAW = 8.0
"""Distance in raw units within which a pixel supports a trial plane."""
_WALL_RAW = 25.0
"""The strongest distortion in the corners of a sensor; pixels further off are not on the wall."""
_LEAST_SHARE = 0.04
"""Least share of the image; a smaller wall carries too little information."""
_ROUNDS = 8


class NoWallError(CalibrationError):
    """A capture shows no flat wall.

    Parameters
    ----------
    capture
        Its name.
    reason
        A sentence that does not name it.
    """

    def __init__(self, capture: str, reason: Message) -> None:
        super().__init__("{what}: {reason}", what=capture, reason=reason)
        self.reason = reason


@dataclass(frozen=True, eq=False)
class WallFit:
    """The wall of one capture.

    Parameters
    ----------
    plane : (3,) float64, 1/mm
        1/Z = plane · (x, y, 1), depth camera frame, normalised coordinates.
    expected_raw : (480, 640) float64, raw units
        The raw numbers of a sensor without distortion.
    wall : (480, 640) bool
        The pixels that show the wall.
    """

    capture: WallCapture
    plane: FloatArray
    expected_raw: FloatArray
    wall: BoolArray

    @property
    def residual_raw(self) -> FloatArray:
        """(480, 640) measured minus expected raw number; NaN off the wall (thesis 16)."""
        return np.where(self.wall, self.capture.raw - self.expected_raw, np.nan)


def plane_rows(camera: PinholeCamera) -> FloatArray:
    """Return the row (x, y, 1) of every pixel, (height, width, 3), so that 1/Z = row · plane."""
    rays = camera.pixel_rays()
    return np.concatenate([rays, np.ones((*rays.shape[:2], 1))], axis=-1)


def fit_wall(capture: WallCapture, rows: FloatArray, disparity: DisparityModel) -> WallFit:
    """Find the largest plane of a capture; walls need not be perpendicular nor fill the view.

    Parameters
    ----------
    capture
        If its plane is known, it is used as it is.
    rows : (480, 640, 3) from `plane_rows`
    disparity
        Converts raw numbers to depth.

    Raises
    ------
    NoWallError
        If no plane fills at least 4 % of the image.
    """
    plane = capture.plane
    if plane is None:
        plane = _refine(_search(capture.raw, rows, disparity), capture.raw, rows, disparity)
    expected = expected_raw(plane, rows, disparity)
    wall = _largest_region(np.abs(capture.raw - expected) < _WALL_RAW)
    if wall.mean() < _LEAST_SHARE:
        reason = Message(
            "it shows no flat wall that fills at least {share:.0%} of the view; point the sensor "
            "at an empty flat wall and capture it again.",
            share=_LEAST_SHARE,
        )
        raise NoWallError(capture.name, reason)
    return WallFit(capture, plane, expected, wall)


def expected_raw(plane: FloatArray, rows: FloatArray, disparity: DisparityModel) -> FloatArray:
    """Compute the raw numbers of a plane.

    Parameters
    ----------
    plane : (3,) float64, 1/mm
        1/Z = plane · (x, y, 1), depth camera frame.
    rows : (height, width, 3) from `plane_rows`

    Returns
    -------
    (height, width) float64, raw units
        NaN where the plane lies behind the camera.
    """
    inverse = rows @ plane
    depth = np.divide(1, inverse, out=np.full(inverse.shape, np.nan), where=inverse > 0)
    return disparity.raw(depth)


def _search(raw: FloatArray, rows: FloatArray, disparity: DisparityModel) -> FloatArray:
    """Return the plane through three pixels that most pixels support, of many trials (RANSAC)."""
    coarse = 1 / disparity.depth_mm(raw[::_SEARCH_STEP, ::_SEARCH_STEP]).ravel()
    known = np.isfinite(coarse)
    values, places = coarse[known], rows[::_SEARCH_STEP, ::_SEARCH_STEP].reshape(-1, 3)[known]
    if len(values) < 3:
        return np.zeros(3)
    generator = np.random.default_rng(0)
    chosen = generator.integers(len(values), size=(_TRIALS, 3))
    corners = places[chosen]
    sound = np.abs(np.linalg.det(corners)) > 1e-4
    planes = np.linalg.solve(corners[sound], values[chosen][sound][..., None])[..., 0]
    tolerance = _NEAR_RAW * np.abs(_inverse_per_raw(values, disparity))
    support = (np.abs(places @ planes.T - values[:, None]) < tolerance[:, None]).sum(0)
    return np.asarray(planes[np.argmax(support)]) if len(planes) else np.zeros(3)


def _refine(
    plane: FloatArray, raw: FloatArray, rows: FloatArray, disparity: DisparityModel
) -> FloatArray:
    """Fit the supporting pixels by least squares in raw units, with decreasing weights (Tukey)."""
    raw, places = raw[::_FIT_STEP, ::_FIT_STEP], rows[::_FIT_STEP, ::_FIT_STEP]
    measured = 1 / disparity.depth_mm(raw)
    plane = plane.copy()
    for _ in range(_ROUNDS):
        off = raw - expected_raw(plane, places, disparity)
        weight = np.where(np.isfinite(off), np.clip(1 - (off / _WALL_RAW) ** 2, 0, None), 0)
        used = weight > 0
        if used.sum() < 3:
            break
        scaled = weight[used] / np.abs(_inverse_per_raw(measured[used], disparity))
        plane[:] = np.linalg.lstsq(
            places[used] * scaled[:, None], measured[used] * scaled, rcond=None
        )[0]
    return plane


def _inverse_per_raw(inverse: FloatArray, disparity: DisparityModel) -> FloatArray:
    """Return the change of 1/Z per raw unit, from the models' own inverse."""
    step = 1e-6
    return np.asarray(step / (disparity.raw(1 / (inverse + step)) - disparity.raw(1 / inverse)))


def _largest_region(near: BoolArray) -> BoolArray:
    """Keep the largest connected component, without its holes."""
    count, labels, stats, _ = cv2.connectedComponentsWithStats(
        near.astype(np.uint8), connectivity=4
    )
    if count < 2:
        return near
    largest = 1 + int(np.argmax(stats[1:, cv2.CC_STAT_AREA]))
    return np.asarray(labels == largest)


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
