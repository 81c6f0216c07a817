"""Calibration step for one camera, from pictures of a board."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Literal

from insole_core.calibration.boards.board import Board
from insole_core.calibration.boards.intrinsics import (
    CameraCalibration,
    IntrinsicsOptions,
    calibrate_camera,
    find_boards,
    with_shift,
)
from insole_core.calibration.boards.stereo import IR_TO_DEPTH_PX
from insole_core.calibration.plausibility import find_camera_misfit
from insole_core.errors import CalibrationError
from insole_core.evaluation.calibration_sections import camera_section
from insole_core.messages import Message, joined
from insole_core.progress import SILENT, Progress
from insole_core.recording.sensor_folder import COLOR_SIZES, DEPTH_SIZE
from insole_core.sensing.sensor import Sensor
from insole_core.workflows.calibration.steps import COLOR, INFRARED, StepResult, board_pictures

Which = Literal["color", "depth"]

_KINDS: dict[Which, str] = {"color": COLOR, "depth": INFRARED}
_WORDS: dict[Which, str] = {"color": "colour", "depth": "infrared"}
_SIZES: dict[Which, tuple[tuple[int, int], ...]] = {
    "color": tuple(COLOR_SIZES),
    "depth": (DEPTH_SIZE,),
}


def calibrate_camera_step(
    which: Which,
    folder: Path,
    board: Board,
    sensor: Sensor,
    *,
    options: IntrinsicsOptions | None = None,
    progress: Progress = SILENT,
) -> StepResult:
    """Calibrate the colour camera (thesis 5.1), or the depth camera with covered emitter (5.4).

    Parameters
    ----------
    folder
        With pictures ``color_…`` for the colour camera, ``ir_…`` for the depth camera.
    sensor
        Its camera is replaced.

    Raises
    ------
    CalibrationError
        When the pictures do not suffice, or are of another size than the sensor's.
    InputError
        When the folder or a picture cannot be read.
    Cancelled
    """
    paths = board_pictures(folder, _KINDS[which])
    detections, without = find_boards(paths, board, progress.part(0, 0.7))
    calibration = calibrate_camera(detections, options, progress.part(0.7, 1))
    calibration = replace(calibration, left_out=without | calibration.left_out)
    _check_size(calibration, which)
    if which == "color":
        better = replace(sensor, color_camera=calibration.camera)
        section = camera_section(calibration, "Colour camera")
    else:
        better = replace(sensor, depth_camera=with_shift(calibration.camera, IR_TO_DEPTH_PX))
        section = replace(camera_section(calibration, "Depth camera"), key="depth_camera")
    return StepResult(
        better,
        section,
        _sentences(calibration, _WORDS[which]),
        (calibration.rms_px, "px"),
        calibration.advice,
        find_camera_misfit(calibration.camera, which),
    )


def _sentences(calibration: CameraCalibration, kind: str) -> tuple[str, ...]:
    count, out = len(calibration.pictures), len(calibration.left_out)
    camera, deviations = calibration.camera, calibration.deviations
    return (
        Message(
            "{count} of {taken} {kind} pictures were used; a corner is met within {rms_px:.2f} px.",
            count=count,
            taken=count + out,
            kind=kind,
            rms_px=calibration.rms_px,
        ),
        Message(
            "The focal length is {fx:.1f} / {fy:.1f} px, known within {error_px:.1f} px.",
            fx=camera.fx,
            fy=camera.fy,
            error_px=max(deviations["fx"], deviations["fy"]),
        ),
        *(
            Message("{picture} was left out: {reason}", picture=name, reason=reason)
            for name, reason in calibration.left_out.items()
        ),
    )


def _check_size(calibration: CameraCalibration, which: Which) -> None:
    size, sizes = (calibration.camera.width, calibration.camera.height), _SIZES[which]
    if size not in sizes:
        allowed = joined((f"{w}×{h}" for w, h in sizes), " or ")
        raise CalibrationError(
            "The {kind} pictures are {width}×{height}, but the sensor gives {allowed}; use its "
            "pictures as they are, neither cut nor scaled.",
            kind=_WORDS[which],
            width=size[0],
            height=size[1],
            allowed=allowed,
        )
