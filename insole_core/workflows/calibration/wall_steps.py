"""Calibration steps that use captures of walls: distortion of the depth, and its scale in mm."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from insole_core.calibration.boards.board import Board
from insole_core.calibration.plausibility import (
    Distances,
    find_depth_misfit,
    find_other_scale,
    unusual_distances,
)
from insole_core.calibration.walls.captures import WallCapture, check_same_device, read_captures
from insole_core.calibration.walls.disparity_fit import (
    centre_pairs,
    fit_linear_inverse,
    fit_tangent,
)
from insole_core.calibration.walls.distortion import DistortionOptions, calibrate_distortion
from insole_core.calibration.walls.wall_plane import with_board_planes
from insole_core.errors import CalibrationError, UsageError
from insole_core.evaluation.calibration_sections import disparity_section, distortion_section
from insole_core.evaluation.wall import Correction, NoCorrection, wall_pictures
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.readings import Readings
from insole_core.sensing.sensor import COLOR_CAMERA, Sensor, nominal_kinect
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_core.workflows.calibration.steps import StepResult


def calibrate_distortion_step(
    captures: Sequence[WallCapture], sensor: Sensor, progress: Progress = SILENT
) -> StepResult:
    """Estimate the distortion of the depth from walls (thesis 5.2, the default map).

    Parameters
    ----------
    captures
        Recorded with this sensor.
    sensor
        Its correction is replaced.

    Raises
    ------
    CalibrationError
        When the captures do not suffice, or were recorded with another sensor.
    Cancelled
    """
    check_recorded_with(sensor.serial, captures)
    readings = Readings.of(sensor)
    check_lattice(captures, readings.sensor)
    camera, disparity = readings.sensor.depth_camera, sensor.disparity
    calibration = calibrate_distortion(
        captures,
        camera,
        disparity,
        DistortionOptions(reach_mm=sensor.family.wall_mm),
        serial=sensor.serial,
        progress=progress,
    )
    names = {wall.name for wall in calibration.walls}
    used = [capture for capture in captures if capture.name in names]
    corrections: dict[str, Correction] = {"before": NoCorrection(), "after": calibration.correction}
    pictures = wall_pictures(used, corrections, camera, disparity)
    section = distortion_section(calibration)
    figures = calibration.correction.record.figures
    return StepResult(
        sensor=replace(sensor, correction=_stored(calibration.correction, readings)),
        section=replace(section, plots=section.plots + pictures),
        sentences=(
            Message(
                "{used} of {taken} walls were used; they cover {share:.0%} of the image.",
                used=len(calibration.walls),
                taken=len(captures),
                share=calibration.covered_share,
            ),
            Message(
                "The walls were off by {before_raw:.1f} raw units and are now off by "
                "{after_raw:.1f} (noise included).",
                before_raw=figures["rms_before_raw"],
                after_raw=figures["rms_after_raw"],
            ),
            "A bulge that all walls share is taken for distortion; if they were one wall, check it "
            "with a straightedge.",
        ),
        residual=(figures["rms_after_raw"], "raw"),
        advice=calibration.advice,
        doubt=calibration.doubt,
    )


def _stored(correction: DisparityCorrection, readings: Readings) -> DisparityCorrection:
    """Return a correction of readings as that of the frames that are stored."""
    if readings.stored.depth_unit_mm is None:
        return correction
    camera = readings.stored.depth_camera
    spread = correction.spread(readings.bin_px, camera.height, camera.width)
    return replace(spread, record=replace(spread.record, unit="px"))


def check_lattice(captures: Sequence[WallCapture], sensor: Sensor) -> None:
    """Check that captures have the readings of a sensor.

    Raises
    ------
    CalibrationError
        When they come from a sensor of another kind.
    """
    camera = sensor.depth_camera
    other = next((c for c in captures if c.raw.shape != (camera.height, camera.width)), None)
    if other is not None:
        raise CalibrationError(
            "{capture} was recorded by another kind of sensor than {serial}, a {model}; use "
            "captures of this sensor, each in a folder with its sensor.json.",
            capture=other.name,
            serial=sensor.serial,
            model=sensor.model,
        )


def starting_sensor(store: SensorStore, serial: str, captures: Sequence[WallCapture]) -> Sensor:
    """Return a sensor as calibrated so far: as stored, as its captures say, or a nominal Kinect.

    Raises
    ------
    InputError
        When the stored sensor cannot be read.
    """
    told = (c.sensor for c in captures if c.sensor is not None and c.sensor.serial == serial)
    return store.load(serial) or next(told, None) or nominal_kinect(serial)


def calibrate_disparity_step(
    captures: Sequence[WallCapture], sensor: Sensor, model: str, progress: Progress = SILENT
) -> StepResult:
    """Fit the conversion of raw numbers to mm to walls at known distances, thesis (12) or (17).

    Parameters
    ----------
    captures
        With their distances.
    sensor
        Its disparity model is replaced.
    model
        ``linear-inverse`` or ``tangent``.

    Raises
    ------
    CalibrationError
        When the captures do not suffice, or were recorded with another sensor.
    Cancelled
    """
    check_recorded_with(sensor.serial, captures)
    progress.step(0.1, "Fitting the disparity model")
    raw, depth_mm = centre_pairs(captures, sensor.correction)
    fit = {"linear-inverse": fit_linear_inverse, "tangent": fit_tangent}[model]
    calibration = fit(raw, depth_mm)
    low, high = calibration.range_mm
    measured = Distances([capture.name for capture in captures], raw, depth_mm)
    return StepResult(
        sensor=replace(sensor, disparity=calibration.model),
        section=disparity_section(calibration),
        sentences=(
            Message(
                "Between {low_mm:.0f} and {high_mm:.0f} mm the distances are met within "
                "{error_mm:.1f} mm.",
                low_mm=low,
                high_mm=high,
                error_mm=calibration.rms_mm,
            ),
        ),
        residual=(calibration.rms_mm, "mm"),
        warnings=find_other_scale(sensor, calibration.model),
        advice=unusual_distances(measured),
        doubt=find_depth_misfit(calibration.model, measured),
    )


def read_walls(
    folder: Path, distances_mm: Sequence[float] = (), progress: Progress = SILENT
) -> list[WallCapture]:
    """Read wall captures, with their measured distances where these are given.

    Parameters
    ----------
    distances_mm
        One for each capture, in the order of their names; empty to keep what is stored.

    Raises
    ------
    InputError
        When the folder cannot be read.
    UsageError
        When the number of distances is not that of the captures.
    Cancelled
    """
    captures = read_captures(folder, progress)
    if not distances_mm:
        return captures
    if len(distances_mm) != len(captures):
        raise UsageError(
            "{given} distances are given, but {folder} holds {count} captures; give one "
            "distance for each, in the order of their names.",
            given=len(distances_mm),
            folder=folder,
            count=len(captures),
        )
    return [
        replace(capture, distance_mm=distance)
        for capture, distance in zip(captures, distances_mm, strict=True)
    ]


def place_walls(
    captures: Sequence[WallCapture],
    folder: Path,
    board: Board,
    sensor: Sensor,
    progress: Progress = SILENT,
) -> list[WallCapture]:
    """Add the plane of each wall, from a board on it in the picture of the colour camera.

    Parameters
    ----------
    captures
        Read from `folder`.
    folder
        Holds the colour picture of each capture too.
    sensor
        With a calibrated colour camera and ``depth2color``.

    Returns
    -------
    list of WallCapture
        With their planes.

    Raises
    ------
    CalibrationError
        When the colour camera is not calibrated, or a board cannot be used.
    InputError
        When a picture cannot be read.
    Cancelled
    """
    if sensor.color_camera == COLOR_CAMERA:
        raise CalibrationError(
            "The colour camera of this sensor was not calibrated yet, so the board on the walls "
            "cannot tell where they are; calibrate it, and depth to colour, first."
        )
    return with_board_planes(captures, folder, board, sensor, progress)


def check_recorded_with(serial: str, captures: Sequence[WallCapture]) -> None:
    """Check that captures come from one device, and from the one with this serial number.

    Parameters
    ----------
    serial
        Empty when unknown.

    Raises
    ------
    CalibrationError
        When their own sensor.json names another device, or they come from several.
    """
    other = next((c for c in captures if serial and c.serial not in ("", serial)), None)
    if other is not None:
        raise CalibrationError(
            "{capture} was recorded with sensor {owner}, not with {serial}; use the captures of "
            "one sensor.",
            capture=other.name,
            owner=other.serial,
            serial=serial,
        )
    check_same_device(captures)
