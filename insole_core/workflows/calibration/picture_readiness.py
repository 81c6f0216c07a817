"""Inspection of a folder of calibration images, and what is still to be captured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import cv2
import numpy as np

from insole_core.calibration.boards.board import (
    Board,
    BoardDetection,
    count_corners,
    missing_regions,
    read_grey,
)
from insole_core.calibration.boards.board_plan import (
    EACH_WITH_DEPTH,
    EACH_WITH_INFRARED,
    SIDE_WORDS,
    missing_turns,
    turn_of,
    turns_text,
)
from insole_core.calibration.walls.captures import WallCapture, read_captures
from insole_core.calibration.walls.wall_plane import WallFit, fit_wall, plane_rows
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray, IntArray
from insole_core.memo import Memo
from insole_core.messages import Message, joined
from insole_core.progress import SILENT, Progress
from insole_core.sensing.family import SensorFamily
from insole_core.sensing.readings import Readings
from insole_core.sensing.sensor import Sensor
from insole_core.workflows.calibration.steps import COLOR, board_pictures, has_infrared
from insole_core.workflows.calibration.wall_steps import check_lattice

GOOD_PICTURES = 10
_WALL_STEP_MM = 100
_NEAR_MM = 60.0
_FRONT_DEG = 8.0
CELLS = (6, 8)
_WIDTH_PX = 640
_GREEN = (60, 200, 60)


@dataclass(frozen=True, eq=False)
class PictureInspection:
    """Inspection of one picture or wall.

    Parameters
    ----------
    sentence
        What it shows, or why it cannot be used.
    picture : (height, width, 3) uint8, RGB
        Reduced, with the detected corners or wall.
    """

    name: str
    usable: bool
    sentence: str
    picture: ByteArray


@dataclass(frozen=True, eq=False)
class Readiness:
    """Whether the images of a folder suffice.

    Parameters
    ----------
    looks
        Of every image.
    missing
        Sentences on what is still to be captured; empty when the images suffice.
    cells : (6, 8) int64
        Number of times each part of the picture was covered.
    distances_mm
        Of the walls.
    """

    looks: tuple[PictureInspection, ...]
    missing: tuple[str, ...]
    cells: IntArray = field(default_factory=lambda: np.zeros(CELLS, dtype=np.int64))
    distances_mm: tuple[float, ...] = ()

    @property
    def usable(self) -> int:
        """Number of usable images."""
        return sum(look.usable for look in self.looks)


def inspect_boards(
    folder: Path, kind: str, board: Board, memo: Memo, progress: Progress = SILENT
) -> Readiness:
    """Find the board in every picture of a kind.

    Parameters
    ----------
    kind
        Prefix of their names: `COLOR` or `INFRARED`.
    memo
        Caches the inspections: the folder grows while pictures are taken, and each is inspected
        once.

    Raises
    ------
    InputError
        When the folder or a picture cannot be read.
    Cancelled
    """
    looks, detections = _look_at_boards(folder, kind, board, memo, progress)
    return Readiness(looks, _missing_boards(detections), count_corners(detections))


def inspect_pairs(folder: Path, board: Board, memo: Memo, progress: Progress = SILENT) -> Readiness:
    """Find the board in every colour picture of a folder that holds depth or infrared as well.

    Parameters
    ----------
    memo
        As for `inspect_boards`.

    Raises
    ------
    InputError
        When the folder or a picture cannot be read.
    Cancelled
    """
    looks, detections = _look_at_boards(folder, COLOR, board, memo, progress)
    each = EACH_WITH_INFRARED if has_infrared(folder) else EACH_WITH_DEPTH
    return Readiness(looks, _missing_pairs(detections, each), count_corners(detections))


def _look_at_boards(
    folder: Path, kind: str, board: Board, memo: Memo, progress: Progress
) -> tuple[tuple[PictureInspection, ...], list[BoardDetection]]:
    paths = board_pictures(folder, kind)
    inspections: list[tuple[PictureInspection, BoardDetection | None]] = []
    for done, path in enumerate(paths):
        progress.step(done / len(paths), "Looking at {picture}", picture=path.name)
        key = path, path.stat().st_mtime_ns, board
        inspections.append(memo.get("board", key, partial(_look_at_file, path, board)))
    detections = [detection for _, detection in inspections if detection is not None]
    return tuple(look for look, _ in inspections), detections


def _look_at_file(path: Path, board: Board) -> tuple[PictureInspection, BoardDetection | None]:
    return look_at_board(path.name, read_grey(path), board)


def look_at_board(
    name: str, grey: ByteArray, board: Board, picture: ByteArray | None = None
) -> tuple[PictureInspection, BoardDetection | None]:
    """Find the board in one picture.

    Parameters
    ----------
    name
        Of the picture, for messages.
    grey : (height, width) uint8
    picture : (height, width, 3) uint8, RGB, optional
        Shown in place of the grey one.

    Returns
    -------
    inspection : PictureInspection
    detection : BoardDetection
        None when the picture cannot be used.
    """
    shown = rgb(grey) if picture is None else picture
    try:
        detection = board.find(name, grey)
    except CalibrationError as error:
        return PictureInspection(name, False, str(error), small(shown)), None
    return PictureInspection(
        name, True, _description(detection), _with_corners(shown, detection)
    ), detection


def _description(detection: BoardDetection) -> str:
    count, (turn_deg, side) = len(detection.pixels), turn_of(detection)
    if turn_deg < _FRONT_DEG:
        return Message("{count} corners, seen from the front", count=count)
    return Message(
        "{count} corners, turned {turn_deg:.0f}° {side}",
        count=count,
        turn_deg=turn_deg,
        side=SIDE_WORDS[side],
    )


def inspect_walls(folder: Path, sensor: Sensor, progress: Progress = SILENT) -> Readiness:
    """Find the wall in every capture.

    Parameters
    ----------
    sensor
        That recorded them.

    Raises
    ------
    InputError
        When the folder or an image cannot be read.
    Cancelled
    """
    captures = read_captures(folder, progress.part(0, 0.5))
    inspections: list[tuple[PictureInspection, WallFit | None]] = []
    for done, capture in enumerate(captures):
        progress.step(
            0.5 + 0.5 * done / len(captures), "Finding the wall in {capture}", capture=capture.name
        )
        inspections.append(look_at_wall(capture, sensor))
    walls = [wall for _, wall in inspections if wall is not None]
    distances = tuple(wall_distance_mm(wall) for wall in walls)
    looks = tuple(look for look, _ in inspections)
    missing = missing_walls(walls, wall_distances_mm(sensor.family))
    return Readiness(looks, missing, wall_cells(walls), distances)


def look_at_wall(capture: WallCapture, sensor: Sensor) -> tuple[PictureInspection, WallFit | None]:
    """Find the wall in one capture.

    Parameters
    ----------
    sensor
        That recorded it.

    Returns
    -------
    inspection : PictureInspection
    wall : WallFit
        None when the capture cannot be used.
    """
    try:
        lattice = Readings.of(sensor).sensor
        check_lattice([capture], lattice)
        wall = fit_wall(capture, plane_rows(lattice.depth_camera), sensor.disparity)
    except CalibrationError as error:
        return PictureInspection(capture.name, False, str(error), _depth_picture(capture)), None
    return PictureInspection(
        capture.name, True, wall_sentence(wall), _depth_picture(capture, wall.wall)
    ), wall


def wall_sentence(wall: WallFit) -> Message:
    """Return where a wall is, and how much of the picture it fills."""
    return Message(
        "a wall at {distance_mm:.0f} mm that fills {share:.0%}",
        distance_mm=wall_distance_mm(wall),
        share=float(wall.wall.mean()),
    )


def wall_distance_mm(wall: WallFit) -> float:
    """Return the distance of a wall along the optical axis."""
    return float(1 / wall.plane[2])


def is_near(distance_mm: float, distances_mm: Sequence[float]) -> bool:
    """Return whether a wall was captured at roughly a distance (within 60 mm)."""
    return any(abs(distance_mm - one) < _NEAR_MM for one in distances_mm)


def _missing_boards(detections: Sequence[BoardDetection]) -> tuple[str, ...]:
    missing = []
    if len(detections) < GOOD_PICTURES:
        missing.append(
            Message(
                "Take {count} more pictures, the board tilted by 20 to 40° to another side each "
                "time.",
                count=GOOD_PICTURES - len(detections),
            )
        )
    return (*missing, *_missing_parts(detections))


def _missing_pairs(detections: Sequence[BoardDetection], each: int) -> tuple[str, ...]:
    missing = []
    if turns := missing_turns(detections, each):
        missing.append(
            Message("Turn the board strongly, by 40 to 55°: {sides}.", sides=turns_text(turns))
        )
    return (*missing, *_missing_parts(detections))


def _missing_parts(detections: Sequence[BoardDetection]) -> tuple[str, ...]:
    regions = missing_regions(count_corners(detections))
    if not regions:
        return ()
    return (
        Message(
            "Hold the board in these parts of the picture: {regions}.", regions=joined(regions)
        ),
    )


def wall_distances_mm(family: SensorFamily) -> tuple[int, ...]:
    """Return the distances of the walls that the distortion of a family is calibrated with."""
    nearest, farthest = map(int, family.wall_mm)
    return tuple(range(nearest, farthest + 1, _WALL_STEP_MM))


def missing_walls(walls: Sequence[WallFit], wanted_mm: Sequence[int]) -> tuple[str, ...]:
    """Return what walls at some distances still lack, one sentence each."""
    distances = [wall_distance_mm(wall) for wall in walls]
    far = [str(mm) for mm in wanted_mm if not is_near(mm, distances)]
    missing = []
    if far:
        missing.append(
            Message(
                "Capture the wall at about these distances: {distances} mm.",
                distances=", ".join(far),
            )
        )
    if regions := missing_regions(wall_cells(walls)):
        missing.append(
            Message(
                "Fill these parts of the picture with the wall: {regions}.", regions=joined(regions)
            )
        )
    return tuple(missing)


def wall_cells(walls: Sequence[WallFit]) -> IntArray:
    """Count the walls (6, 8) that fill more than half of each cell of the image."""
    counts = np.zeros(CELLS, dtype=np.int64)
    for wall in walls:
        height, width = (size // cells for size, cells in zip(wall.wall.shape, CELLS, strict=True))
        filled = wall.wall.reshape(CELLS[0], height, CELLS[1], width).mean(axis=(1, 3))
        counts += filled > 0.5
    return counts


def _with_corners(shown: ByteArray, detection: BoardDetection) -> ByteArray:
    picture = small(shown)
    scale = picture.shape[1] / shown.shape[1]
    for u, v in np.round(detection.pixels * scale).astype(int).tolist():
        cv2.circle(picture, (u, v), 3, _GREEN, 1, cv2.LINE_AA)
    return picture


def _depth_picture(capture: WallCapture, wall: BoolArray | None = None) -> ByteArray:
    """Draw a capture in grey by distance, with the wall in green."""
    known: FloatArray = np.nan_to_num(capture.raw, nan=np.nanmax(capture.raw))
    low, high = np.nanpercentile(capture.raw, [2, 98])
    grey = 220 - 160 * np.clip((known - low) / max(high - low, 1), 0, 1)
    return small(with_wall(np.where(np.isfinite(capture.raw), grey, 20).astype(np.uint8), wall))


def with_wall(grey: ByteArray, wall: BoolArray | None) -> ByteArray:
    """Return a grey picture (height, width) as RGB, with the wall in green."""
    picture = rgb(grey)
    if wall is not None:
        picture[wall] = (0.7 * picture[wall] + 0.3 * np.array(_GREEN)).astype(np.uint8)
    return picture


def rgb(grey: ByteArray) -> ByteArray:
    """Return a grey picture (height, width) as (height, width, 3)."""
    return np.repeat(grey[..., None], 3, axis=-1)


def small(picture: ByteArray) -> ByteArray:
    """Resize a picture (height, width, 3) to the width at which it is shown."""
    height, width = picture.shape[:2]
    size = (_WIDTH_PX, round(height * _WIDTH_PX / width))
    return np.ascontiguousarray(cv2.resize(picture, size, interpolation=cv2.INTER_AREA))
