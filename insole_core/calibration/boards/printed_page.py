"""What is printed at true size for a calibration: boards, and templates of the marker faces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.calibration.boards.board import Charuco, Chequerboard
from insole_core.calibration.markers.reference_file import positions
from insole_core.errors import UsageError
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.messages import Message
from insole_core.recording.session import Marker, ReferenceSystem

RULER_MM = 100.0
MARKER_MM = 15.8
"""Side of a marker: a block of two studs."""

_MARGIN_MM = 5.0
_BLACK, BLUE = "#000000", "#0057b8"
_OVERLAP_PX = 4
_PX_PER_SQUARE = 540
"""Of the picture that a ChArUco board is taken from: 0.05 mm a pixel."""


@dataclass(frozen=True, eq=False)
class PrintedPage:
    """A page at true size, in mm from its upper left corner, x to the right and y downwards.

    Parameters
    ----------
    size_mm
        Width and height.
    boxes_mm : (n, 4) float64
        x, y, width and height of what is printed in `color`; the rest is white.
    note
        What it is, to be printed beside the ruler at the lower edge.
    labels
        Text and the place of its left end, halfway up.
    """

    size_mm: tuple[float, float]
    boxes_mm: FloatArray
    note: str
    color: str = _BLACK
    labels: tuple[tuple[str, float, float], ...] = ()


def chequerboard_page(board: Chequerboard, page_mm: tuple[float, float]) -> PrintedPage:
    """Lay out a chequerboard in the middle of a page.

    Raises
    ------
    UsageError
        When it does not fit the page.
    """
    columns, rows, side = board.columns + 1, board.rows + 1, board.square_mm
    left, top = _corner(page_mm, (columns * side, rows * side))
    boxes = [
        (left + column * side, top + row * side, side, side)
        for row in range(rows)
        for column in range(row % 2, columns, 2)
    ]
    note = Message(
        "{columns}×{rows} inner corners, square {square_mm:g} mm",
        columns=board.columns,
        rows=board.rows,
        square_mm=side,
    )
    return PrintedPage(page_mm, np.array(boxes), note)


def charuco_page(board: Charuco, page_mm: tuple[float, float]) -> PrintedPage:
    """Lay out a ChArUco board in the middle of a page.

    Raises
    ------
    UsageError
        When it does not fit the page.
    """
    columns, rows, side = board.columns, board.rows, board.square_mm
    corner = _corner(page_mm, (columns * side, rows * side))
    size_px = (columns * _PX_PER_SQUARE, rows * _PX_PER_SQUARE)
    picture = np.asarray(board.pattern().generateImage(size_px, marginSize=0))
    boxes = _black_boxes(picture < 128) * (side / _PX_PER_SQUARE)
    note = Message(
        "ChArUco {columns}×{rows}, square {square_mm:g} mm, marker {marker_mm:g} mm, {dictionary}",
        columns=columns,
        rows=rows,
        square_mm=side,
        marker_mm=board.marker_mm,
        dictionary=board.dictionary,
    )
    return PrintedPage(page_mm, boxes + np.array([*corner, 0.0, 0.0]), note)


def marker_pages(system: ReferenceSystem, page_mm: tuple[float, float]) -> list[PrintedPage]:
    """Lay out a template of each face of a reference system, with its markers in their places.

    Parameters
    ----------
    page_mm
        Width and height of the paper, which is turned where that suits the face.

    Raises
    ------
    UsageError
        When a face does not fit the page.
    """
    faces = dict.fromkeys(marker.face for marker in system.markers)
    return [_template(face, system.facing((face,)), page_mm) for face in faces]


def axes_of_face(points: FloatArray) -> tuple[int, int, int]:
    """Return the axis across a face (n, 3), the one along it, and the one out of it.

    Across is x; along is y or z, whichever the face extends over.
    """
    return (0, 2, 1) if np.ptp(points[:, 2]) > np.ptp(points[:, 1]) else (0, 1, 2)


def _template(face: str, markers: tuple[Marker, ...], page_mm: tuple[float, float]) -> PrintedPage:
    across, along, _ = axes_of_face(positions(markers))
    places = positions(markers)[:, [across, along]]
    low, high = places.min(0) - MARKER_MM, places.max(0) + MARKER_MM
    width, height = (high - low).tolist()
    page = (max(page_mm), min(page_mm)) if width > height else (min(page_mm), max(page_mm))
    centers = places - low + _corner(page, (width, height))
    sides = np.full_like(centers, MARKER_MM)
    note = Message(
        "Face {face}: {across} to the right, {along} downwards",
        face=face,
        across="xyz"[across],
        along="xyz"[along],
    )
    labels = tuple(
        (marker.id, float(x) + 10, float(y))
        for marker, (x, y) in zip(markers, centers, strict=True)
    )
    return PrintedPage(page, np.hstack([centers - sides / 2, sides]), note, BLUE, labels)


def _black_boxes(black: BoolArray) -> FloatArray:
    """Cover what is black in a picture by boxes (n, 4), px.

    Each band of rows that are alike is one row of boxes. Where bands touch, a thin box lies across
    both, because viewers let a hairline of white shine through between two boxes.
    """
    starts = np.flatnonzero(np.r_[True, (black[1:] != black[:-1]).any(1)])
    heights = np.diff(np.r_[starts, len(black)])
    boxes = [
        (x, y, width, height)
        for y, height in zip(starts, heights, strict=True)
        for x, width in _runs(black[y])
    ]
    boxes += [
        (x, y - _OVERLAP_PX, width, 2 * _OVERLAP_PX)
        for y in starts[1:]
        for x, width in _runs(black[y - 1] & black[y])
    ]
    return np.array(boxes, dtype=np.float64)


def _runs(row: BoolArray) -> IntArray:
    """Return where the true values of a row (n,) begin, and how many follow: (runs, 2)."""
    begins, ends = np.flatnonzero(np.diff(np.r_[0, row.astype(np.int8), 0])).reshape(-1, 2).T
    return np.column_stack([begins, ends - begins])


def _corner(page_mm: tuple[float, float], size_mm: tuple[float, float]) -> tuple[float, float]:
    """Return the upper left corner of a drawing in the middle of a page."""
    if any(size > page - 2 * _MARGIN_MM for size, page in zip(size_mm, page_mm, strict=True)):
        raise UsageError(
            "A drawing of {width_mm:.0f}×{height_mm:.0f} mm does not fit a page of "
            "{page_width_mm:.0f}×{page_height_mm:.0f} mm; choose a larger page, or make the "
            "drawing smaller.",
            width_mm=size_mm[0],
            height_mm=size_mm[1],
            page_width_mm=page_mm[0],
            page_height_mm=page_mm[1],
        )
    return (page_mm[0] - size_mm[0]) / 2, (page_mm[1] - size_mm[1]) / 2
