"""A board in colour and in raw depth: its area in the depth image, and the depth measured there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from insole_core.calibration.boards.board import BoardDetection
from insole_core.calibration.walls.captures import capture_from_frames, read_depth, read_frames
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.disparity import NO_READING
from insole_core.sensing.pinhole_camera import PinholeCamera

_LEAST_PIXELS = 200
_NEAR_RAW = 30.0
_MARGIN_PX = 4
_BLOCK_PX = 8


@dataclass(frozen=True, eq=False)
class BoardInDepth:
    """One board position, in colour and in raw depth.

    Parameters
    ----------
    color
        The board in the colour picture.
    raw : (480, 640) float64, raw units, corrected for distortion, NaN = no reading
    """

    color: BoardDetection
    raw: FloatArray


def read_boards_in_depth(
    folder: Path,
    detections: Sequence[BoardDetection],
    correction: DisparityCorrection | None = None,
) -> list[BoardInDepth]:
    """Read the raw depth that belongs to each colour picture.

    For ``color_003.jpg`` that is ``depth_003.png``, or the average of the frames in the folder
    ``depth_003``.

    Parameters
    ----------
    detections
        In the colour pictures of `folder`, by their names.
    correction
        Of the distortion, where it is known.

    Raises
    ------
    InputError
        If a depth image is missing or cannot be read.
    """
    boards = []
    for detection in detections:
        raw = read_depth_beside(folder, detection.name)
        boards.append(BoardInDepth(detection, correction.corrected(raw) if correction else raw))
    return boards


def read_depth_beside(folder: Path, picture: str) -> FloatArray:
    """Read the raw depth (480, 640) that belongs to a colour picture, NaN = no reading.

    Raises
    ------
    InputError
        If the depth image is missing or cannot be read.
    """
    frames = folder / f"depth{Path(picture).stem.removeprefix('color')}"
    if frames.is_dir():
        return capture_from_frames(frames.name, read_frames(sorted(frames.glob("*.png")))).raw
    frame = read_depth(frames.with_suffix(".png"))
    return np.where(frame < NO_READING, frame, np.nan)


def board_planes(board2color: FloatArray, depth2color: FloatArray) -> FloatArray:
    """Return the planes (n, 3) 1/Z = plane · (x, y, 1) of boards in the depth camera frame, 1/mm.

    Parameters
    ----------
    board2color : (n, 4, 4) float64, mm
    depth2color : (4, 4) float64, mm
    """
    normals, points = board2color[:, :3, 2], board2color[:, :3, 3]
    distances = (normals * (points - depth2color[:3, 3])).sum(-1)
    return np.asarray(normals @ depth2color[:3, :3] / distances[:, None])


def board_patch(
    board: BoardInDepth,
    board2color: FloatArray,
    depth2color: FloatArray,
    depth_camera: PinholeCamera,
) -> tuple[FloatArray, FloatArray]:
    """Measure the board where the depth image certainly shows it.

    Parameters
    ----------
    board2color, depth2color : (4, 4) float64, mm

    Returns
    -------
    pixels, raw : (k, 2), (k,) float64, px, raw units
        Mean pixel and mean raw number of squares of 8 pixels; empty if it is hardly seen.
    """
    inside = _outline(board.color, inverse(depth2color) @ board2color, depth_camera)
    inside &= np.isfinite(board.raw)
    if inside.sum() < _LEAST_PIXELS:
        return np.empty((0, 2)), np.empty(0)
    v, u = np.nonzero(inside)
    raw, pixels = board.raw[inside], np.stack([u, v], axis=-1).astype(float)
    columns = np.column_stack([pixels, np.ones(len(pixels))])
    flat = columns @ np.linalg.lstsq(columns, raw, rcond=None)[0]
    near = np.abs(raw - flat - np.median(raw - flat)) < _NEAR_RAW
    return _block_means(pixels[near], raw[near])


def _block_means(pixels: FloatArray, raw: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Average squares of pixels: raw numbers of a plane are linear in the pixel, so no bias arises.

    Each mean has the same weight, so squares that are hardly filled are left out.
    """
    squares = (pixels // _BLOCK_PX).astype(int)
    which = squares[:, 0] + squares[:, 1] * (squares[:, 0].max(initial=0) + 1)
    counts = np.bincount(which)
    sums = np.stack([np.bincount(which, values) for values in (*pixels.T, raw)], axis=-1)
    filled = counts > _BLOCK_PX**2 / 2
    means = sums[filled] / counts[filled, None]
    return means[:, :2], means[:, 2]


def _outline(
    detection: BoardDetection, board2depth: FloatArray, depth_camera: PinholeCamera
) -> BoolArray:
    """Fill the area between the corners as seen by the depth camera, minus a margin."""
    corners = depth_camera.project(transform(board2depth, detection.points_mm))
    mask = np.zeros((depth_camera.height, depth_camera.width), np.uint8)
    cv2.fillConvexPoly(mask, cv2.convexHull(np.round(corners).astype(np.int32)), 1)
    width = 2 * _MARGIN_PX + 1
    return np.asarray(cv2.erode(mask, np.ones((width, width), np.uint8)) > 0)
