"""Parts common to all calibration steps: the pictures of a folder, and the form of a result.

Command line and window run the same steps. A step takes the sensor as calibrated so far and returns
it improved, with a section of the report and the result in plain words.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from insole_core.calibration.boards.board import Board, BoardDetection, picture_paths, shifted
from insole_core.calibration.boards.intrinsics import find_boards
from insole_core.calibration.boards.stereo import IR_TO_DEPTH_PX, common_corners
from insole_core.errors import CalibrationError, InputError
from insole_core.evaluation.report import ReportSection
from insole_core.progress import SILENT, Progress
from insole_core.sensing.infrared_reference import InfraredReference
from insole_core.sensing.sensor import COLOR_CAMERA, Sensor, Unit

COLOR, INFRARED, DEPTH = "color", "ir", "depth"
"""Prefixes of the names of the pictures in a folder."""
_WORDS = {
    COLOR: "colour pictures of the board",
    INFRARED: "infrared pictures of the board, taken with the emitter covered",
    DEPTH: "raw depth images",
}


@dataclass(frozen=True, eq=False)
class StepResult:
    """Result of one calibration step.

    Parameters
    ----------
    sensor
        With the new calibration.
    section
        Of the report.
    sentences
        The result in plain words; the first is the most important.
    warnings
        Sentences on what contradicts an earlier step.
    advice
        Sentences on what would improve it.
    doubt
        Why the result is implausible, a sentence; it is then saved only after confirmation.
    residual
        What the step left unexplained, with its unit; kept with the sensor, so that each session
        tells how well its sensors were calibrated.
    reference
        The pattern of dots, of the step that learns it.
    """

    sensor: Sensor
    section: ReportSection
    sentences: tuple[str, ...]
    residual: tuple[float, Unit]
    warnings: tuple[str, ...] = ()
    advice: tuple[str, ...] = ()
    doubt: str = ""
    reference: InfraredReference | None = None


def board_pictures(folder: Path, kind: str) -> list[Path]:
    """List the pictures of one kind; in a folder without kinds, all pictures.

    Parameters
    ----------
    kind
        Prefix of their names: `COLOR`, `INFRARED` or `DEPTH`.

    Raises
    ------
    InputError
        When there are none.
    """
    paths = picture_paths(folder)
    named = [path for path in paths if path.name.startswith(kind)]
    kinds = any(path.name.startswith((COLOR, INFRARED, DEPTH)) for path in paths)
    if kinds and not named:
        raise InputError(
            "{folder} holds no pictures named {kind}…; name the folder with the {words}.",
            folder=folder,
            kind=kind,
            words=_WORDS[kind],
        )
    return named or paths


def has_infrared(folder: Path) -> bool:
    """Return whether a folder holds infrared pictures, by their names."""
    return any(path.name.startswith(INFRARED) for path in picture_paths(folder))


def depth_images(folder: Path) -> list[Path]:
    """List the raw depth images of a folder: those named depth_…, or all PNG images.

    Raises
    ------
    InputError
        When there are none.
    """
    return [path for path in board_pictures(folder, DEPTH) if path.suffix.lower() == ".png"]


def find_infrared_pairs(
    folder: Path, board: Board, progress: Progress = SILENT
) -> list[tuple[BoardDetection, BoardDetection]]:
    """Find the board in ``ir_003`` and ``color_003`` …; keep the corners that both show.

    Returns
    -------
    list of (BoardDetection, BoardDetection)
        For each position the board in pixels of the depth image, and in the colour picture.

    Raises
    ------
    CalibrationError
        When no position is visible to both cameras.
    InputError
        When the folder or a picture cannot be read.
    Cancelled
    """
    depth, _ = find_boards(board_pictures(folder, INFRARED), board, progress.part(0, 0.5))
    color, _ = find_boards(board_pictures(folder, COLOR), board, progress.part(0.5, 1))
    in_depth = {_number(one, INFRARED): shifted(one, IR_TO_DEPTH_PX) for one in depth}
    pairs = [
        common_corners(in_depth[number], one)
        for one in color
        if (number := _number(one, COLOR)) in in_depth
    ]
    if not pairs:
        raise CalibrationError(
            "No board of {folder} is seen by both cameras; give ir_003 and color_003 the same "
            "number when they show the same position.",
            folder=folder,
        )
    return pairs


def check_color_camera(sensor: Sensor, color: Sequence[BoardDetection]) -> None:
    """Check that the colour camera is calibrated for these pictures.

    Parameters
    ----------
    color
        The board in the colour pictures; at least one.

    Raises
    ------
    CalibrationError
        When it is not calibrated, or at another image size.
    """
    camera = sensor.color_camera
    if camera == COLOR_CAMERA:
        raise CalibrationError(
            "The colour camera of this sensor was not calibrated yet; calibrate it first, the same "
            "pictures will do."
        )
    width, height = color[0].size
    if (width, height) != (camera.width, camera.height):
        raise CalibrationError(
            "The pictures are {width}×{height}, but the colour camera was calibrated at "
            "{known_width}×{known_height}; calibrate it with pictures of this size first.",
            width=width,
            height=height,
            known_width=camera.width,
            known_height=camera.height,
        )


def _number(detection: BoardDetection, kind: str) -> str:
    return Path(detection.name).stem.removeprefix(kind)
