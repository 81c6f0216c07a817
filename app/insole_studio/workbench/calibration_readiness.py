"""What a folder of calibration images shows, and what is still missing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from insole_core.calibration.board import Board, Sighting, read_grey
from insole_core.calibration.captures import WallCapture, read_captures
from insole_core.calibration.coverage import count_corners, missing_regions
from insole_core.calibration.wall_plane import WallFit, fit_wall, plane_rows
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray, IntArray
from insole_core.progress import SILENT, Progress
from insole_core.sensing.sensor import Sensor
from insole_studio.workbench.calibration_steps import board_pictures

GOOD_PICTURES = 10
WALL_DISTANCES_MM = (600, 700, 800, 900, 1000)
_NEAR_MM = 60.0
_CELLS = (6, 8)
_WIDTH_PX = 480
_GREEN = (60, 200, 60)


@dataclass(frozen=True, eq=False)
class Look:
    """One picture or wall as it was looked at.

    Parameters
    ----------
    name
    usable
    sentence
        What it shows, or why it cannot be used.
    picture : (height, width, 3) uint8, RGB
        Small, with what was found.
    """

    name: str
    usable: bool
    sentence: str
    picture: ByteArray


@dataclass(frozen=True, eq=False)
class Readiness:
    """Whether a folder will do.

    Parameters
    ----------
    looks
    missing
        What is still to be captured, in sentences; empty when all is there.
    """

    looks: tuple[Look, ...]
    missing: tuple[str, ...]

    @property
    def usable(self) -> int:
        """How many can be used."""
        return sum(look.usable for look in self.looks)


def inspect_boards(folder: Path, kind: str, board: Board, progress: Progress = SILENT) -> Readiness:
    """Look for the board in every picture of a kind.

    Raises
    ------
    InputError
        When the folder or a picture cannot be read.
    """
    paths = board_pictures(folder, kind)
    looks: list[Look] = []
    sightings: list[Sighting] = []
    for done, path in enumerate(paths):
        progress.step(done / len(paths), f"Looking at {path.name}")
        grey = read_grey(path)
        try:
            sighting = board.find(path.name, grey)
        except CalibrationError as error:
            looks.append(Look(path.name, False, str(error), _small(_rgb(grey))))
            continue
        sightings.append(sighting)
        sentence = f"{len(sighting.pixels)} corners"
        looks.append(Look(path.name, True, sentence, _with_corners(grey, sighting)))
    return Readiness(tuple(looks), _missing_boards(sightings))


def inspect_walls(folder: Path, sensor: Sensor, progress: Progress = SILENT) -> Readiness:
    """Look for the wall in every capture.

    Raises
    ------
    InputError
        When the folder or an image cannot be read.
    """
    captures = read_captures(folder, progress.part(0, 0.5))
    rows = plane_rows(sensor.depth_camera)
    looks: list[Look] = []
    walls: list[WallFit] = []
    for done, capture in enumerate(captures):
        progress.step(0.5 + 0.5 * done / len(captures), f"Finding the wall in {capture.name}")
        try:
            wall = fit_wall(capture, rows, sensor.disparity)
        except CalibrationError as error:
            looks.append(Look(capture.name, False, str(error), _depth_picture(capture)))
            continue
        walls.append(wall)
        sentence = f"a wall at {1 / wall.plane[2]:.0f} mm that fills {wall.wall.mean():.0%}"
        looks.append(Look(capture.name, True, sentence, _depth_picture(capture, wall.wall)))
    return Readiness(tuple(looks), _missing_walls(walls))


def _missing_boards(sightings: Sequence[Sighting]) -> tuple[str, ...]:
    missing = []
    if len(sightings) < GOOD_PICTURES:
        missing.append(
            f"Take {GOOD_PICTURES - len(sightings)} more pictures, the board tilted by 20 to 40° "
            "to another side each time."
        )
    if regions := missing_regions(count_corners(sightings)):
        missing.append(f"Hold the board in these parts of the picture: {', '.join(regions)}.")
    return tuple(missing)


def _missing_walls(walls: Sequence[WallFit]) -> tuple[str, ...]:
    distances = np.array([1 / wall.plane[2] for wall in walls])
    far = [mm for mm in WALL_DISTANCES_MM if not (np.abs(distances - mm) < _NEAR_MM).any()]
    missing = []
    if far:
        listed = ", ".join(str(mm) for mm in far)
        missing.append(f"Capture the wall at about these distances: {listed} mm.")
    if regions := missing_regions(_wall_cells(walls)):
        missing.append(f"Fill these parts of the picture with the wall: {', '.join(regions)}.")
    return tuple(missing)


def _wall_cells(walls: Sequence[WallFit]) -> IntArray:
    """Count the walls that fill each of 6 x 8 cells of the image."""
    counts = np.zeros(_CELLS, dtype=np.int64)
    for wall in walls:
        height, width = (size // cells for size, cells in zip(wall.wall.shape, _CELLS, strict=True))
        filled = wall.wall.reshape(_CELLS[0], height, _CELLS[1], width).mean(axis=(1, 3))
        counts += filled > 0.5
    return counts


def _with_corners(grey: ByteArray, sighting: Sighting) -> ByteArray:
    picture = _small(_rgb(grey))
    scale = picture.shape[1] / grey.shape[1]
    for u, v in np.round(sighting.pixels * scale).astype(int).tolist():
        cv2.circle(picture, (u, v), 3, _GREEN, 1, cv2.LINE_AA)
    return picture


def _depth_picture(capture: WallCapture, wall: BoolArray | None = None) -> ByteArray:
    """Grey by distance; the wall is tinted green."""
    known: FloatArray = np.nan_to_num(capture.raw, nan=np.nanmax(capture.raw))
    low, high = np.nanpercentile(capture.raw, [2, 98])
    grey = 220 - 160 * np.clip((known - low) / max(high - low, 1), 0, 1)
    picture = _rgb(np.where(np.isfinite(capture.raw), grey, 20).astype(np.uint8))
    if wall is not None:
        picture[wall] = (0.7 * picture[wall] + 0.3 * np.array(_GREEN)).astype(np.uint8)
    return _small(picture)


def _rgb(grey: ByteArray) -> ByteArray:
    return np.repeat(grey[..., None], 3, axis=-1)


def _small(picture: ByteArray) -> ByteArray:
    height, width = picture.shape[:2]
    size = (_WIDTH_PX, round(height * _WIDTH_PX / width))
    return np.ascontiguousarray(cv2.resize(picture, size, interpolation=cv2.INTER_AREA))
