"""The steps that calibrate one camera from pictures of a board."""

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
from insole_core.errors import CalibrationError
from insole_core.evaluation.calibration_sections import camera_section
from insole_core.progress import SILENT, Progress
from insole_core.recording.sensor_json import COLOR_SIZES, DEPTH_SIZE
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

    Raises
    ------
    CalibrationError, InputError
    """
    paths = board_pictures(folder, _KINDS[which])
    sightings, without = find_boards(paths, board, progress.part(0, 0.7))
    found = calibrate_camera(sightings, options, progress.part(0.7, 1))
    found = replace(found, left_out=without | found.left_out)
    _check_size(found, which)
    if which == "color":
        better = replace(sensor, color_camera=found.camera)
        section = camera_section(found, "Colour camera")
    else:
        better = replace(sensor, depth_camera=with_shift(found.camera, IR_TO_DEPTH_PX))
        section = replace(camera_section(found, "Depth camera"), key="depth_camera")
    return StepResult(better, section, _sentences(found, _WORDS[which]), found.advice)


def _sentences(found: CameraCalibration, kind: str) -> tuple[str, ...]:
    count, out = len(found.pictures), len(found.left_out)
    camera, deviations = found.camera, found.deviations
    return (
        f"{count} of {count + out} {kind} pictures were used; a corner is met within "
        f"{found.rms_px:.2f} px.",
        f"The focal length is {camera.fx:.1f} / {camera.fy:.1f} px, known within "
        f"{max(deviations['fx'], deviations['fy']):.1f} px.",
        *(f"{name} was left out: {reason}" for name, reason in found.left_out.items()),
    )


def _check_size(found: CameraCalibration, which: Which) -> None:
    size, sizes = (found.camera.width, found.camera.height), _SIZES[which]
    if size not in sizes:
        allowed = " or ".join(f"{w}×{h}" for w, h in sizes)
        raise CalibrationError(
            f"The {_WORDS[which]} pictures are {size[0]}×{size[1]}, but the sensor gives "
            f"{allowed}; use its pictures as they are, neither cut nor scaled."
        )
