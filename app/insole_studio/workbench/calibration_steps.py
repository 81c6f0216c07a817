"""The steps that turn a sensor from the box into a measuring device, each on a folder of images.

The command line and the window run the same steps. A step takes the sensor as it is known so far
and gives it back better, with a section of the report and the result in plain words.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from insole_core.calibration.board import Board, Sighting, picture_paths, shifted
from insole_core.calibration.board_depth import (
    BoardDepthOptions,
    add_tilt,
    calibrate_board_depth,
)
from insole_core.calibration.boards_in_depth import read_boards_in_depth
from insole_core.calibration.captures import WallCapture, read_captures
from insole_core.calibration.disparity_fit import centre_pairs, fit_linear_inverse, fit_tangent
from insole_core.calibration.distortion import calibrate_distortion
from insole_core.calibration.intrinsics import (
    CameraCalibration,
    IntrinsicsOptions,
    calibrate_camera,
    find_boards,
    with_shift,
)
from insole_core.calibration.stereo import (
    IR_TO_DEPTH_PX,
    StereoCalibration,
    calibrate_stereo,
    common_corners,
)
from insole_core.errors import CalibrationError, InputError, UsageError
from insole_core.evaluation.calibration_sections import (
    camera_section,
    disparity_section,
    distortion_section,
    stereo_section,
)
from insole_core.evaluation.report import Section
from insole_core.evaluation.wall import Correction, NoCorrection
from insole_core.evaluation.wall_pictures import wall_pictures
from insole_core.progress import SILENT, Progress
from insole_core.recording.sensor_json import COLOR_SIZES, DEPTH_SIZE
from insole_core.sensing.nominal import COLOR_CAMERA
from insole_core.sensing.sensor import Sensor

COLOR, INFRARED, DEPTH = "color", "ir", "depth"
"""How the names of the pictures of a folder begin."""


@dataclass(frozen=True, eq=False)
class StepResult:
    """What one step found.

    Parameters
    ----------
    sensor
        With what is known now.
    section
        Of the report.
    sentences
        The result in plain words; the first is the most important.
    advice
        What would improve it, in sentences.
    """

    sensor: Sensor
    section: Section
    sentences: tuple[str, ...]
    advice: tuple[str, ...] = ()


def board_pictures(folder: Path, kind: str) -> list[Path]:
    """List the pictures of a kind; a folder that names no kinds holds pictures of one camera.

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
            f"{folder} holds no pictures named {kind}…; name the folder with the pictures of the "
            "board."
        )
    return named or paths


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
) -> list[tuple[Sighting, Sighting]]:
    """Find the board in ``ir_003`` and ``color_003`` …: the corners that both show.

    Returns
    -------
    list
        Of each position the board in pixels of the depth image, and in the colour picture.

    Raises
    ------
    CalibrationError
        When no position is seen by both cameras.
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
            f"No board of {folder} is seen by both cameras; give ir_003 and color_003 the same "
            "number when they show the same position."
        )
    return pairs


def calibrate_color_step(
    folder: Path,
    board: Board,
    sensor: Sensor,
    options: IntrinsicsOptions | None = None,
    progress: Progress = SILENT,
) -> StepResult:
    """Calibrate the colour camera from colour pictures of a board (thesis 5.1).

    Raises
    ------
    CalibrationError, InputError
    """
    found = _calibrate_from(board_pictures(folder, COLOR), board, options, progress)
    _check_size(found, COLOR_SIZES, "colour")
    return StepResult(
        sensor=replace(sensor, color_camera=found.camera),
        section=camera_section(found, "Colour camera"),
        sentences=_camera_sentences(found, "colour"),
        advice=found.advice,
    )


def calibrate_depth_step(
    folder: Path,
    board: Board,
    sensor: Sensor,
    options: IntrinsicsOptions | None = None,
    progress: Progress = SILENT,
) -> StepResult:
    """Calibrate the depth camera from infrared pictures of a board, emitter covered (thesis 5.4).

    Raises
    ------
    CalibrationError, InputError
    """
    found = _calibrate_from(board_pictures(folder, INFRARED), board, options, progress)
    _check_size(found, (DEPTH_SIZE,), "infrared")
    return StepResult(
        sensor=replace(sensor, depth_camera=with_shift(found.camera, IR_TO_DEPTH_PX)),
        section=replace(camera_section(found, "Depth camera"), key="depth_camera"),
        sentences=_camera_sentences(found, "infrared"),
        advice=found.advice,
    )


def calibrate_stereo_step(
    folder: Path, board: Board, sensor: Sensor, progress: Progress = SILENT
) -> StepResult:
    """Find the colour camera beside the depth camera (thesis limitation 10.3).

    From infrared and colour pictures where the folder has infrared ones, else from colour pictures
    and the raw depth of each.

    Raises
    ------
    CalibrationError, InputError
        Also when the colour camera was not calibrated before.
    """
    if any(path.name.startswith(INFRARED) for path in picture_paths(folder)):
        pairs = find_infrared_pairs(folder, board, progress)
        check_color_camera(sensor, [in_color for _, in_color in pairs])
        stereo = calibrate_stereo(
            [in_depth for in_depth, _ in pairs],
            [in_color for _, in_color in pairs],
            sensor.depth_camera,
            sensor.color_camera,
        )
        return _stereo_result(sensor, stereo, "infrared and colour pictures")
    color, _ = find_boards(board_pictures(folder, COLOR), board, progress.part(0, 0.5))
    check_color_camera(sensor, color)
    progress.step(0.5, "Reading the depth of the boards")
    boards = read_boards_in_depth(folder, color, sensor.correction)
    progress.step(0.6, f"Fitting the depth camera to {len(boards)} boards")
    # Without a correction there is no map that a tilt of all raw numbers could be added to.
    found = calibrate_board_depth(
        boards,
        sensor.depth_camera,
        sensor.color_camera,
        sensor.disparity,
        BoardDepthOptions(tilt=sensor.correction is not None),
    )
    depth, correction = found.depth, sensor.correction
    better = replace(sensor, depth_camera=depth.camera, disparity=depth.disparity)
    if correction is not None:
        better = replace(
            better, correction=add_tilt(correction, sensor.depth_camera, depth.tilt_raw)
        )
    numbers = [(name, value, found.deviations[name]) for name, value in found.values.items()]
    result = _stereo_result(better, found.stereo, "colour pictures and depth", numbers)
    if correction is not None:
        return result
    advice = (
        "The distortion of the depth was not corrected yet, which turns the cameras by a degree or "
        "two; calibrate the distortion first.",
    )
    return replace(result, advice=advice)


def calibrate_distortion_step(
    captures: Sequence[WallCapture], sensor: Sensor, progress: Progress = SILENT
) -> StepResult:
    """Learn the distortion of the depth from walls (thesis 5.2, the default map).

    Raises
    ------
    CalibrationError
        Also when the captures were recorded with another sensor.
    """
    check_recorded_with(sensor.serial, captures)
    found = calibrate_distortion(
        captures,
        sensor.depth_camera,
        sensor.disparity,
        serial=sensor.serial,
        progress=progress.part(0, 0.9),
    )
    progress.step(0.9, "Drawing the walls before and after")
    names = {wall.name for wall in found.walls}
    used = [capture for capture in captures if capture.name in names]
    corrections: dict[str, Correction] = {"before": NoCorrection(), "after": found.correction}
    pictures = wall_pictures(used, corrections, sensor.depth_camera, sensor.disparity)
    section = distortion_section(found)
    figures = found.correction.record.figures
    return StepResult(
        sensor=replace(sensor, correction=found.correction),
        section=replace(section, plots=section.plots + pictures),
        sentences=(
            f"{len(found.walls)} of {len(captures)} walls were used; they cover "
            f"{found.covered_share:.0%} of the image.",
            f"The walls were off by {figures['rms_before_raw']:.1f} raw units and are now off by "
            f"{figures['rms_after_raw']:.1f} (noise included).",
        ),
        advice=found.advice,
    )


def calibrate_disparity_step(
    captures: Sequence[WallCapture], sensor: Sensor, model: str, progress: Progress = SILENT
) -> StepResult:
    """Fit raw number to mm to captures at known distances, thesis (12) or (17).

    Parameters
    ----------
    captures
        With their distances.
    sensor
    model
        ``linear-inverse`` or ``tangent``.

    Raises
    ------
    CalibrationError
    """
    check_recorded_with(sensor.serial, captures)
    progress.step(0.1, "Fitting the disparity model")
    raw, depth_mm = centre_pairs(captures, sensor.correction)
    fit = {"linear-inverse": fit_linear_inverse, "tangent": fit_tangent}[model]
    found = fit(raw, depth_mm)
    low, high = found.range_mm
    return StepResult(
        sensor=replace(sensor, disparity=found.model),
        section=disparity_section(found),
        sentences=(
            f"Between {low:.0f} and {high:.0f} mm the distances are met within "
            f"{found.rms_mm:.1f} mm.",
        ),
    )


def read_walls(
    folder: Path, distances_mm: Sequence[float] = (), progress: Progress = SILENT
) -> list[WallCapture]:
    """Read wall captures, and their measured distances in the same order where they are given.

    Raises
    ------
    InputError
        When the folder cannot be read.
    UsageError
        When there are more or fewer distances than captures.
    """
    captures = read_captures(folder, progress)
    if not distances_mm:
        return captures
    if len(distances_mm) != len(captures):
        raise UsageError(
            f"{len(distances_mm)} distances are given, but {folder} holds {len(captures)} "
            "captures; give one distance for each, in the order of their names."
        )
    return [
        replace(capture, distance_mm=distance)
        for capture, distance in zip(captures, distances_mm, strict=True)
    ]


def check_recorded_with(serial: str, captures: Sequence[WallCapture]) -> None:
    """Refuse captures whose own sensor.json names another device.

    Raises
    ------
    CalibrationError
    """
    other = next((c for c in captures if serial and c.serial not in ("", serial)), None)
    if other is not None:
        raise CalibrationError(
            f"{other.name} was recorded with sensor {other.serial}, not with {serial}; use the "
            "captures of one sensor."
        )


def check_color_camera(sensor: Sensor, color: Sequence[Sighting]) -> None:
    """Refuse pictures that the colour camera was not calibrated for.

    Raises
    ------
    CalibrationError
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
            f"The pictures are {width}×{height}, but the colour camera was calibrated at "
            f"{camera.width}×{camera.height}; calibrate it with pictures of this size first."
        )


def _calibrate_from(
    paths: Sequence[Path], board: Board, options: IntrinsicsOptions | None, progress: Progress
) -> CameraCalibration:
    sightings, without = find_boards(paths, board, progress.part(0, 0.7))
    found = calibrate_camera(sightings, options, progress.part(0.7, 1))
    return replace(found, left_out=without | found.left_out)


def _camera_sentences(found: CameraCalibration, kind: str) -> tuple[str, ...]:
    count, out = len(found.pictures), len(found.left_out)
    camera, deviations = found.camera, found.deviations
    return (
        f"{count} of {count + out} {kind} pictures were used; a corner is met within "
        f"{found.rms_px:.2f} px.",
        f"The focal length is {camera.fx:.1f} / {camera.fy:.1f} px, known within "
        f"{max(deviations['fx'], deviations['fy']):.1f} px.",
        *(f"{name} was left out: {reason}" for name, reason in found.left_out.items()),
    )


def _check_size(found: CameraCalibration, sizes: Sequence[tuple[int, int]], kind: str) -> None:
    size = found.camera.width, found.camera.height
    if size not in sizes:
        allowed = " or ".join(f"{w}×{h}" for w, h in sizes)
        raise CalibrationError(
            f"The {kind} pictures are {size[0]}×{size[1]}, but the sensor gives {allowed}; use "
            "its pictures as they are, neither cut nor scaled."
        )


def _number(sighting: Sighting, kind: str) -> str:
    return Path(sighting.name).stem.removeprefix(kind)


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
            f"The cameras are {stereo.baseline_mm:.1f} mm apart ({x:.1f}, {y:.1f}, {z:.1f}) and "
            f"turned by {stereo.rotation_deg:.2f}°, from {len(stereo.pairs)} {source}.",
            f"The distance is known within {max(stereo.translation_deviation_mm):.1f} mm.",
        ),
    )
