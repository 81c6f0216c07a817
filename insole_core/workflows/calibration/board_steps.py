"""Calibration steps from pictures of a board: each camera, and the pose between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np

from insole_core.calibration.boards.board import Board, BoardDetection
from insole_core.calibration.boards.board_depth import BoardDepthOptions, calibrate_board_depth
from insole_core.calibration.boards.board_plan import (
    EACH_WITH_DEPTH,
    EACH_WITH_INFRARED,
    missing_turns,
    turns_text,
)
from insole_core.calibration.boards.boards_in_depth import read_boards_in_depth
from insole_core.calibration.boards.intrinsics import (
    CameraCalibration,
    IntrinsicsOptions,
    calibrate_camera,
    find_boards,
    with_shift,
)
from insole_core.calibration.boards.stereo import (
    IR_TO_DEPTH_PX,
    StereoCalibration,
    calibrate_stereo,
)
from insole_core.calibration.depth_sensor import add_tilt
from insole_core.calibration.plausibility import (
    find_camera_misfit,
    find_misfit,
    find_other_scale,
    find_shift_misfit,
)
from insole_core.errors import CalibrationError
from insole_core.evaluation.alignment import Correspondence, evaluate_alignment, shift_color
from insole_core.evaluation.calibration_sections import camera_section, stereo_section
from insole_core.evaluation.evaluation_sections import alignment_section
from insole_core.messages import Message, joined
from insole_core.progress import SILENT, Progress
from insole_core.recording.sensor_folder import COLOR_SIZES, DEPTH_SIZE
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.sensor import Sensor
from insole_core.workflows.calibration.steps import (
    COLOR,
    INFRARED,
    StepResult,
    board_pictures,
    check_color_camera,
    find_infrared_pairs,
    has_infrared,
)

_GOOD_MM = 0.5
"""Wanted standard deviation of the position of the depth camera."""
Which = Literal["color", "depth"]
_KINDS: dict[Which, str] = {"color": COLOR, "depth": INFRARED}
_WORDS: dict[Which, str] = {"color": "colour", "depth": "infrared"}
_SIZES: dict[Which, tuple[tuple[int, int], ...]] = {
    "color": tuple(COLOR_SIZES),
    "depth": (DEPTH_SIZE,),
}


def calibrate_stereo_step(
    folder: Path, board: Board, sensor: Sensor, progress: Progress = SILENT
) -> StepResult:
    """Calibrate the pose of the colour camera against the depth camera (thesis limitation 10.3).

    From infrared and colour pictures where the folder has infrared ones, otherwise from colour
    pictures and the raw depth of each.

    Parameters
    ----------
    folder
        With pictures ``color_…``, and ``ir_…`` or ``depth_…`` of the same numbers.
    sensor
        With a calibrated colour camera.

    Raises
    ------
    CalibrationError
        When the pictures do not suffice, or the colour camera is not calibrated.
    InputError
        When the folder or a picture cannot be read.
    Cancelled
    """
    if has_infrared(folder):
        return _from_infrared(folder, board, sensor, progress)
    return _from_depth(folder, board, sensor, progress)


def _from_infrared(folder: Path, board: Board, sensor: Sensor, progress: Progress) -> StepResult:
    pairs = find_infrared_pairs(folder, board, progress.part(0, 0.8))
    check_color_camera(sensor, [in_color for _, in_color in pairs])
    progress.step(0.8, "Fitting both cameras to {count} boards", count=len(pairs))
    calibration = calibrate_stereo(
        [in_depth for in_depth, _ in pairs],
        [in_color for _, in_color in pairs],
        sensor.depth_camera,
        sensor.color_camera,
    )
    depth_camera, color_camera = calibration.depth_camera, calibration.color_camera
    better = replace(sensor, depth_camera=depth_camera, color_camera=color_camera)
    numbers = [
        (name, value, calibration.deviations[name]) for name, value in calibration.values.items()
    ]
    result = _stereo_result(better, calibration.stereo, "infrared and colour pictures", numbers)
    color = [in_color for _, in_color in pairs]
    return replace(
        result,
        advice=_advice(calibration.stereo, color, EACH_WITH_INFRARED),
        doubt=find_misfit(result.sensor, board.square_mm, None),
    )


def _from_depth(folder: Path, board: Board, sensor: Sensor, progress: Progress) -> StepResult:
    color, _ = find_boards(board_pictures(folder, COLOR), board, progress.part(0, 0.5))
    check_color_camera(sensor, color)
    progress.step(0.5, "Reading the depth of the boards")
    boards = read_boards_in_depth(folder, color, sensor.correction)
    progress.step(0.6, "Fitting the depth camera to {count} boards", count=len(boards))
    # Without a correction there is no map to which a tilt of all raw numbers could be added.
    calibration = calibrate_board_depth(
        boards,
        sensor.depth_camera,
        sensor.color_camera,
        sensor.disparity,
        BoardDepthOptions(tilt=sensor.correction is not None),
    )
    depth, correction = calibration.depth, sensor.correction
    better = replace(sensor, depth_camera=depth.camera, disparity=depth.disparity)
    if correction is not None:
        better = replace(
            better, correction=add_tilt(correction, sensor.depth_camera, depth.tilt_raw)
        )
    numbers = [
        (name, value, calibration.deviations[name]) for name, value in calibration.values.items()
    ]
    result = _stereo_result(better, calibration.stereo, "colour pictures and depth", numbers)
    advice = _advice(calibration.stereo, color, EACH_WITH_DEPTH)
    if correction is None:
        advice += (
            "The distortion of the depth was not corrected yet, which turns the cameras by a "
            "degree or two; calibrate the distortion first.",
        )
    scale = LinearInverseDisparity(calibration.values["a"], calibration.values["b"])
    doubt = find_misfit(result.sensor, board.square_mm, scale)
    warnings = find_other_scale(sensor, depth.disparity)
    return replace(result, warnings=warnings, advice=advice, doubt=doubt)


def _advice(
    stereo: StereoCalibration, color: Sequence[BoardDetection], each: int
) -> tuple[str, ...]:
    """Return advice on further positions while the position is not known well enough."""
    known_mm = float(np.linalg.norm(stereo.translation_deviation_mm))
    missing = missing_turns(color, each)
    if known_mm <= _GOOD_MM or not missing:
        return ()
    sides = turns_text(missing)
    return (
        Message(
            "The place of the depth camera is known within {known_mm:.1f} mm only; for "
            "{good_mm} mm take more positions with the board turned by 40 to 55° ({sides}).",
            known_mm=known_mm,
            good_mm=_GOOD_MM,
            sides=sides,
        ),
    )


def shift_color_step(points: Sequence[Correspondence], sensor: Sensor) -> StepResult:
    """Align colour with depth by a constant pixel shift, as the thesis did (5.4).

    Parameters
    ----------
    points
        The same points in depth and colour.
    sensor
        The principal point of its colour camera is shifted.

    Raises
    ------
    InputError
        Without points.
    """
    better = shift_color(sensor, points)
    x = better.color_camera.cx - sensor.color_camera.cx
    y = better.color_camera.cy - sensor.color_camera.cy
    residuals = evaluate_alignment(better, points)
    worst = max(max(abs(row.x_px), abs(row.y_px)) for row in residuals)
    section = alignment_section(residuals)
    return StepResult(
        sensor=better,
        section=replace(section, key="shift", title="Colour on depth, after a constant shift"),
        sentences=(
            Message(
                "Colour was shifted by {x:+.1f} px in x and {y:+.1f} px in y; up to "
                "{worst:.1f} px are left.",
                x=x,
                y=y,
                worst=worst,
            ),
        ),
        residual=(worst, "px"),
        advice=("A shift fits one distance; calibrate depth to colour to be right at all.",),
        doubt=find_shift_misfit(better.color_camera, worst),
    )


def _stereo_result(
    sensor: Sensor,
    stereo: StereoCalibration,
    source: str,
    fitted: Sequence[tuple[str, float, float]] = (),
) -> StepResult:
    x, y, z = stereo.depth2color[:3, 3]
    return StepResult(
        sensor=replace(sensor, depth2color=stereo.depth2color),
        section=stereo_section(stereo, fitted),
        sentences=(
            Message(
                "The cameras are {baseline_mm:.1f} mm apart ({x:.1f}, {y:.1f}, {z:.1f}) and "
                "turned by {turn_deg:.2f}°, from {count} {source}.",
                baseline_mm=stereo.baseline_mm,
                x=x,
                y=y,
                z=z,
                turn_deg=stereo.rotation_deg,
                count=len(stereo.pairs),
                source=source,
            ),
            Message(
                "The distance is known within {error_mm:.1f} mm.",
                error_mm=max(stereo.translation_deviation_mm),
            ),
        ),
        residual=(stereo.rms, stereo.unit),
    )


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
        advice=calibration.advice,
        doubt=find_camera_misfit(calibration.camera, which),
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
