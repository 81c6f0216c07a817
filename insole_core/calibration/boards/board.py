"""Calibration boards, their detection in pictures, and how much of the image they cover."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, Protocol

import cv2
import numpy as np

from insole_core.errors import CalibrationError, InputError, UsageError
from insole_core.geometry.arrays import ByteArray, FloatArray, IntArray
from insole_core.messages import Message
from insole_core.recording.images import read_picture

_PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff")
_LEAST_CORNERS = 8
_BLURRED_EDGE_PX = 4.5
"""Rise of a chequerboard edge from dark to bright; a sharp picture has 2 to 3 px."""
_EDGE_UNKNOWN_PX = 9999.0
"""Result of OpenCV where the squares are too small to judge."""
_SQUARE_MM = (5.0, 200.0)
_CELLS = (6, 8)
_VERTICAL = ("upper", "middle", "lower")
_HORIZONTAL = ("left", "centre", "right")


@dataclass(frozen=True, eq=False)
class BoardDetection:
    """A board as detected in one picture.

    Parameters
    ----------
    name
        Of the picture.
    size
        Width and height of the picture, px.
    points_mm : (n, 3) float64, mm, board frame (z = 0)
    pixels : (n, 2) float64, px
    """

    name: str
    size: tuple[int, int]
    points_mm: FloatArray
    pixels: FloatArray


class Board(Protocol):
    """A kind of board that can be detected in a picture; an immutable value."""

    def __hash__(self) -> int: ...

    @property
    def square_mm(self) -> float:
        """Side of a square."""
        ...

    @property
    def points_mm(self) -> FloatArray:
        """(n, 3) float64, mm, board frame: every corner, row by row."""
        ...

    def find(self, name: str, grey: ByteArray) -> BoardDetection:
        """Find the corners in a grey picture.

        Parameters
        ----------
        name
            Of the picture, for the detection and for messages.
        grey : (height, width) uint8

        Raises
        ------
        CalibrationError
            If the picture does not show the board.
        """
        ...


@dataclass(frozen=True)
class Chequerboard:
    """A chequerboard of `columns` x `rows` inner corners.

    Raises
    ------
    UsageError
        If the size of the square cannot be in mm.
    """

    columns: int
    rows: int
    square_mm: float

    def __post_init__(self) -> None:
        _check_grid(self.columns, self.rows, self.square_mm, least=3)

    @cached_property
    def points_mm(self) -> FloatArray:
        """(n, 3) float64, mm, board frame: every inner corner, row by row."""
        return _grid(self.columns, self.rows, self.square_mm)

    def find(self, name: str, grey: ByteArray) -> BoardDetection:
        """Find all corners; part of a chequerboard is not enough, as its position is ambiguous.

        Parameters
        ----------
        name
            Of the picture, for the detection and for messages.
        grey : (height, width) uint8

        Raises
        ------
        CalibrationError
            If the picture does not show the whole board, or is blurred.
        """
        corners = _chequerboard_corners(grey, self.columns, self.rows)
        if corners is None:
            raise self._not_found(name, grey)
        edge = cv2.estimateChessboardSharpness(grey, (self.columns, self.rows), corners)[0][0]
        if _BLURRED_EDGE_PX < edge < _EDGE_UNKNOWN_PX:
            raise CalibrationError(
                "{picture} is blurred (an edge takes {edge_px:.1f} px); hold the board still and "
                "take the picture again.",
                picture=name,
                edge_px=edge,
            )
        return BoardDetection(
            name, grey.shape[::-1], self.points_mm, corners.reshape(-1, 2).astype(float)
        )

    def _not_found(self, name: str, grey: ByteArray) -> CalibrationError:
        wanted = Message("{columns}×{rows} inner corners", columns=self.columns, rows=self.rows)
        if cv2.findChessboardCornersSB(grey, (3, 3), flags=cv2.CALIB_CB_LARGER)[0]:
            return CalibrationError(
                "{picture}: a chequerboard is seen, but not one of {board}; show all of it, or "
                "count its inner corners (a row has one less than squares).",
                picture=name,
                board=wanted,
            )
        return CalibrationError(
            "{picture}: no chequerboard of {board} is seen; show the whole board, flat and well "
            "lit.",
            picture=name,
            board=wanted,
        )


@dataclass(frozen=True)
class Charuco:
    """A chequerboard of `columns` x `rows` squares with markers in its white squares.

    It may be seen in part, because every corner has its own number.

    Raises
    ------
    UsageError
        If squares or markers have impossible sizes.
    """

    columns: int
    rows: int
    square_mm: float
    marker_mm: float
    dictionary: str = "DICT_5X5_250"

    def __post_init__(self) -> None:
        _check_grid(self.columns, self.rows, self.square_mm, least=3)
        if not 0 < self.marker_mm < self.square_mm:
            raise UsageError(
                "A ChArUco marker of {marker_mm:g} mm does not fit a square of {square_mm:g} mm; "
                "give the marker's own size in mm.",
                marker_mm=self.marker_mm,
                square_mm=self.square_mm,
            )
        if not hasattr(cv2.aruco, self.dictionary):
            raise UsageError(
                "There is no marker dictionary {dictionary}; the printed board of this program "
                "uses DICT_5X5_250.",
                dictionary=self.dictionary,
            )

    @cached_property
    def points_mm(self) -> FloatArray:
        """(n, 3) float64, mm, board frame: every inner corner, row by row."""
        first = np.array([self.square_mm, self.square_mm, 0])
        return np.asarray(_grid(self.columns - 1, self.rows - 1, self.square_mm) + first)

    def find(self, name: str, grey: ByteArray) -> BoardDetection:
        """Find the corners that are in view.

        Parameters
        ----------
        name
            Of the picture, for the detection and for messages.
        grey : (height, width) uint8

        Raises
        ------
        CalibrationError
            If too few corners are in view.
        """
        corners, ids, _, _ = cv2.aruco.CharucoDetector(self.pattern()).detectBoard(grey)
        count = 0 if ids is None else len(ids)
        if count < _LEAST_CORNERS:
            raise CalibrationError(
                "{picture}: {corners} corners of the ChArUco board of {columns}×{rows} squares are "
                "seen, but {least} are needed; show more of the board, and check its size and "
                "dictionary.",
                picture=name,
                corners=count,
                columns=self.columns,
                rows=self.rows,
                least=_LEAST_CORNERS,
            )
        points = self.points_mm[np.asarray(ids).ravel()]
        return BoardDetection(name, grey.shape[::-1], points, corners.reshape(-1, 2).astype(float))

    def pattern(self) -> Any:
        """Return the board of OpenCV."""
        dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, self.dictionary))
        return cv2.aruco.CharucoBoard(
            (self.columns, self.rows), self.square_mm, self.marker_mm, dictionary
        )


def picture_paths(folder: Path, prefix: str = "") -> list[Path]:
    """List the pictures of a folder whose names start with `prefix`, in order.

    Raises
    ------
    InputError
        If there are none.
    """
    if not folder.is_dir():
        raise InputError(
            "There is no folder {folder}; name the folder with the pictures.", folder=folder
        )
    paths = sorted(
        path
        for path in folder.iterdir()
        if path.suffix.lower() in _PICTURES and path.name.startswith(prefix)
    )
    if not paths:
        what = Message("pictures named {prefix}…", prefix=prefix) if prefix else "pictures"
        raise InputError(
            "{folder} holds no {what}; name the folder with the pictures of the board.",
            folder=folder,
            what=what,
        )
    return paths


def read_grey(path: Path) -> ByteArray:
    """Read a picture as (height, width) uint8.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    return _read(path, cv2.IMREAD_GRAYSCALE)


def read_color(path: Path) -> ByteArray:
    """Read a picture as (height, width, 3) uint8, RGB.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    return _read(path, cv2.IMREAD_COLOR_RGB)


def _read(path: Path, flags: int) -> ByteArray:
    picture = read_picture(path, flags)
    if picture is None:
        raise InputError(
            "{path} is no readable picture; restore it or take it out of the folder.", path=path
        )
    return picture


def shifted(detection: BoardDetection, shift_px: tuple[float, float]) -> BoardDetection:
    """Return the same detection in an image whose pixel coordinates are shifted by (u, v)."""
    return replace(detection, pixels=detection.pixels + np.asarray(shift_px))


def _chequerboard_corners(grey: ByteArray, columns: int, rows: int) -> FloatArray | None:
    # Without normalisation first: on real Kinect pictures it detects more and is more accurate.
    careful = cv2.CALIB_CB_EXHAUSTIVE | cv2.CALIB_CB_ACCURACY
    for flags in (careful, careful | cv2.CALIB_CB_NORMALIZE_IMAGE):
        found, corners = cv2.findChessboardCornersSB(grey, (columns, rows), flags=flags)
        if found:
            return np.asarray(corners)
    return None


def _grid(columns: int, rows: int, square_mm: float) -> FloatArray:
    row, column = np.mgrid[:rows, :columns]
    flat = np.stack([column.ravel(), row.ravel(), np.zeros(row.size)], axis=-1)
    return np.asarray(flat * square_mm)


def _check_grid(columns: int, rows: int, square_mm: float, least: int) -> None:
    if columns < least or rows < least:
        raise UsageError(
            "A board of {columns}×{rows} is too small; it must have at least {least}×{least}.",
            columns=columns,
            rows=rows,
            least=least,
        )
    low, high = _SQUARE_MM
    if not low <= square_mm <= high:
        raise UsageError(
            "A square of {square_mm:g} mm cannot be; measure its side and give it in millimetres "
            "({low_mm:g} to {high_mm:g}).",
            square_mm=square_mm,
            low_mm=low,
            high_mm=high,
        )


def count_corners(detections: Sequence[BoardDetection]) -> IntArray:
    """Count the corners in each of 6 x 8 cells of the image."""
    counts = np.zeros(_CELLS, dtype=np.int64)
    for detection in detections:
        width, height = detection.size
        column = np.clip(detection.pixels[:, 0] * _CELLS[1] / width, 0, _CELLS[1] - 1).astype(int)
        row = np.clip(detection.pixels[:, 1] * _CELLS[0] / height, 0, _CELLS[0] - 1).astype(int)
        np.add.at(counts, (row, column), 1)
    return counts


def missing_regions(counts: IntArray) -> tuple[str, ...]:
    """Name the ninths of the image of which more than half was not reached."""
    rows = np.array_split(np.arange(counts.shape[0]), 3)
    columns = np.array_split(np.arange(counts.shape[1]), 3)
    return tuple(
        f"{vertical} {horizontal}"
        for vertical, i in zip(_VERTICAL, rows, strict=True)
        for horizontal, j in zip(_HORIZONTAL, columns, strict=True)
        if (counts[np.ix_(i, j)] == 0).mean() > 0.5
    )
