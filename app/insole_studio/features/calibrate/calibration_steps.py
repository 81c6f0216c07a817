"""The steps of a calibration, in the order in which a technician does them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from insole_core.calibration.boards.board import Board
from insole_core.memo import Memo
from insole_core.progress import Progress
from insole_core.sensing.infrared_reference import InfraredReference
from insole_core.sensing.sensor import Sensor
from insole_core.workflows.calibration.board_steps import (
    Which,
    calibrate_camera_step,
    calibrate_stereo_step,
)
from insole_core.workflows.calibration.infrared_steps import (
    PATTERN,
    check_pattern,
    inspect_infrared_walls,
    learn_pattern_step,
)
from insole_core.workflows.calibration.picture_folders import LiveKind
from insole_core.workflows.calibration.picture_readiness import (
    Readiness,
    inspect_boards,
    inspect_pairs,
    inspect_walls,
)
from insole_core.workflows.calibration.steps import COLOR, INFRARED, StepResult
from insole_core.workflows.calibration.wall_steps import calibrate_distortion_step, read_walls
from insole_studio.texts import tr


@dataclass(frozen=True)
class CalibrationStep:
    """One calibration step.

    Parameters
    ----------
    key
        Section of the step's report; a sensor with that section has done the step.
    title, instruction
        Functions that return the translated texts.
    inspect, calibrate
        Functions of a folder, a board and the sensor as calibrated so far; detections in images are
        cached in the memo.
    uses_board
        Whether the step needs images of a board.
    optional
        Whether a calibration is complete without the step.
    live
        Kind of live inspection for this step.
    check
        Says of a folder and a sensor whether its kept pattern of dots still holds; None for steps
        without one.
    """

    key: str
    title: Callable[[], str]
    instruction: Callable[[], str]
    inspect: Callable[[Path, Board, Sensor, Memo, Progress], Readiness]
    calibrate: Callable[[Path, Board, Sensor, Progress], StepResult]
    uses_board: bool = True
    optional: bool = False
    live: LiveKind = "boards"
    check: Callable[[Path, Sensor, InfraredReference | None], tuple[str, ...]] | None = None


def _inspect_pictures(
    kind: str, folder: Path, board: Board, _sensor: Sensor, memo: Memo, progress: Progress
) -> Readiness:
    return inspect_boards(folder, kind, board, memo, progress)


def _camera(
    which: Which, folder: Path, board: Board, sensor: Sensor, progress: Progress
) -> StepResult:
    return calibrate_camera_step(which, folder, board, sensor, progress=progress)


def _distortion(folder: Path, _board: Board, sensor: Sensor, progress: Progress) -> StepResult:
    captures = read_walls(folder, progress=progress.part(0, 0.5))
    return calibrate_distortion_step(captures, sensor, progress.part(0.5, 1))


STEPS = (
    CalibrationStep(
        "camera",
        lambda: tr("Colour camera"),
        lambda: tr(
            "Print the chequerboard at 100 %, glue it to something stiff, and take 15 colour "
            "pictures of it: tilted by 20 to 40° to all sides, in all parts of the picture."
        ),
        partial(_inspect_pictures, COLOR),
        partial(_camera, "color"),
    ),
    CalibrationStep(
        "distortion",
        lambda: tr("Distortion of the depth"),
        lambda: tr(
            "Let the sensor warm up for 15 minutes, point it at an empty flat wall, and capture "
            "ten frames at each of six distances from 500 to 1000 mm (with a RealSense at four "
            "from 400 to 700 mm), a little askew each time."
        ),
        lambda folder, _board, sensor, _memo, progress: inspect_walls(folder, sensor, progress),
        _distortion,
        uses_board=False,
        live="walls",
    ),
    CalibrationStep(
        "depth_camera",
        lambda: tr("Depth camera (infrared)"),
        lambda: tr(
            "Cover the emitter, light the board well, and take 16 infrared pictures of it: turned "
            "by 20 to 40° to all sides, in all parts of the picture."
        ),
        partial(_inspect_pictures, INFRARED),
        partial(_camera, "depth"),
        optional=True,
        live="infrared",
    ),
    CalibrationStep(
        "stereo",
        lambda: tr("Depth to colour"),
        lambda: tr(
            "Turn the board strongly, by 40 to 55°, in turn to the left, to the right, upwards and "
            "downwards, 600 to 900 mm away and in all parts of the picture: 12 positions to each "
            "side in colour and depth, or 4 to each side in colour and infrared (emitter covered)."
        ),
        lambda folder, board, _sensor, memo, progress: inspect_pairs(folder, board, memo, progress),
        calibrate_stereo_step,
    ),
    CalibrationStep(
        PATTERN,
        lambda: tr("Pattern of dots (infrared)"),
        lambda: tr(
            "Let the sensor warm up for 15 minutes, point it at an empty flat wall that fills the "
            "picture, and take eight walls from 600 to 900 mm away, a little askew each time; "
            "depth and infrared are taken together. Later, one wall tells whether the pattern has "
            "drifted."
        ),
        lambda folder, _board, sensor, memo, progress: inspect_infrared_walls(
            folder, sensor, memo, progress
        ),
        lambda folder, _board, sensor, progress: learn_pattern_step(folder, sensor, progress),
        uses_board=False,
        optional=True,
        live="dots",
        check=check_pattern,
    ),
)
