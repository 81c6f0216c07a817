"""The default distortion correction: from wall captures to the file stored beside sensor.json."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime

import numpy as np

from insole_core.calibration.walls.captures import WallCapture, check_same_device
from insole_core.calibration.walls.smooth_map import (
    BLOCK_PX,
    SPAN_RAW,
    BlockMap,
    MapBlocks,
    Smoothing,
    blocks_of,
    solve_map,
    to_pixels,
)
from insole_core.calibration.walls.wall_plane import NoWallError, WallFit, fit_wall, plane_rows
from insole_core.errors import CalibrationError
from insole_core.geometry.arrays import FloatArray
from insole_core.messages import Message, joined
from insole_core.progress import SILENT, Progress
from insole_core.sensing.correction import CorrectionRecord, DisparityCorrection
from insole_core.sensing.disparity import DisparityModel
from insole_core.sensing.pinhole_camera import PinholeCamera


@dataclass(frozen=True)
class DistortionOptions:
    """Options of the distortion calibration.

    Parameters
    ----------
    extrapolate_raw
        How far beyond the walls' raw numbers the dependence on disparity is extrapolated.
    uneven_raw, uneven_share
        A wall counts as not flat if more than this share of it differs by more than this many
        raw units from the map of all walls.
    reach_mm
        Distances that walls are best captured at.
    """

    smoothing: Smoothing = field(default_factory=Smoothing)
    extrapolate_raw: float = 100.0
    uneven_raw: float = 1.5
    uneven_share: float = 0.1
    reach_mm: tuple[float, float] = (500.0, 1000.0)


_DEFAULTS = DistortionOptions()
_GOOD_RAW = 1.2
"""Twice the noise of a single frame."""


@dataclass(frozen=True)
class WallFigures:
    """Errors of one wall, in raw units over its pixels, before and after the correction."""

    name: str
    distance_mm: float
    tilt_deg: float
    filled_share: float
    rms_before_raw: float
    rms_after_raw: float


@dataclass(frozen=True, eq=False)
class DistortionCalibration:
    """A distortion correction and its accuracy.

    Parameters
    ----------
    walls
        One per wall used.
    left_out : name to reason
    covered_share
        Share of the image that the walls reached.
    deviation_raw
        Median standard deviation of the map where it is covered.
    advice
        Possible improvements, in sentences; may be empty.
    doubt
        Why these were probably no walls, a sentence; empty when nothing speaks against it.
    """

    correction: DisparityCorrection
    walls: tuple[WallFigures, ...]
    left_out: dict[str, str]
    covered_share: float
    deviation_raw: float
    advice: tuple[str, ...]
    doubt: str = ""


def calibrate_distortion(
    captures: Sequence[WallCapture],
    camera: PinholeCamera,
    disparity: DisparityModel,
    options: DistortionOptions = _DEFAULTS,
    *,
    serial: str = "",
    progress: Progress = SILENT,
) -> DistortionCalibration:
    """Fit the smooth map that varies with disparity to captures of flat walls.

    The walls need not be perpendicular, nor fill the view. If no wall's plane is known, one plane
    (a tilt and a shift of everything) cannot be separated from the distortion and is left out.

    Parameters
    ----------
    camera
        The depth camera.
    disparity
        Converts raw numbers to depth.
    serial
        Of the device; if empty, that of the captures.

    Raises
    ------
    CalibrationError
        If the captures are of several devices, or show no wall, or none that is flat.
    """
    check_same_device(captures)
    rows = plane_rows(camera)
    walls, left_out = _find_walls(captures, camera, disparity, progress.part(0, 0.5))
    walls, blocks, solved = _solve_even(walls, left_out, rows, options, progress.part(0.5, 0.9))
    progress.step(0.9, "Judging the map")
    correction = _correction(blocks, solved, options, serial or walls[0].capture.serial)
    deviation = np.maximum(to_pixels(solved.deviation, blocks.shape), 0).astype(np.float32)
    return _judged(replace(correction, deviation=deviation), walls, left_out, disparity, options)


def correction_of_walls(walls: Sequence[WallFit], camera: PinholeCamera) -> DisparityCorrection:
    """Fit the map to walls of one device that are found already, and say nothing of its deviation.

    Parameters
    ----------
    camera
        The depth camera.

    Raises
    ------
    CalibrationError
        If the walls contradict each other.
    """
    even, blocks, solved = _solve_even(list(walls), {}, plane_rows(camera), _DEFAULTS, SILENT)
    return _correction(blocks, solved, _DEFAULTS, even[0].capture.serial)


def _find_walls(
    captures: Sequence[WallCapture],
    camera: PinholeCamera,
    disparity: DisparityModel,
    progress: Progress,
) -> tuple[list[WallFit], dict[str, str]]:
    rows = plane_rows(camera)
    walls: list[WallFit] = []
    left_out: dict[str, str] = {}
    for done, capture in enumerate(captures):
        progress.step(done / len(captures), "Finding the wall in {capture}", capture=capture.name)
        try:
            walls.append(fit_wall(capture, rows, disparity))
        except NoWallError as error:
            left_out[capture.name] = error.reason
    if not captures:
        raise CalibrationError("There are no captures; capture a flat wall.")
    if not walls:
        name, reason = next(iter(left_out.items()))
        raise CalibrationError("{what}: {reason}", what=name, reason=reason)
    return walls, left_out


def _solve_even(
    walls: list[WallFit],
    left_out: dict[str, str],
    rows: FloatArray,
    options: DistortionOptions,
    progress: Progress,
) -> tuple[list[WallFit], MapBlocks, BlockMap]:
    """Solve for the map, without the walls that are not flat: these are added to `left_out`."""
    progress.step(0.0, "Solving the distortion map")
    blocks, solved = _solve(walls, rows, options)
    uneven = _uneven(blocks, solved, options)
    if not uneven.any():
        return walls, blocks, solved
    left_out |= {
        wall.capture.name: "it is not flat, or something stood before it."
        for wall, bad in zip(walls, uneven, strict=True)
        if bad
    }
    even = [wall for wall, bad in zip(walls, uneven, strict=True) if not bad]
    if len(even) < 2:
        raise CalibrationError(
            "The walls contradict each other ({walls}); capture a flat, empty wall at several "
            "distances.",
            walls=joined(left_out),
        )
    progress.step(0.5, "Solving again without uneven walls")
    return even, *_solve(even, rows, options)


def _solve(
    walls: Sequence[WallFit], rows: np.ndarray, options: DistortionOptions
) -> tuple[MapBlocks, BlockMap]:
    blocks = blocks_of(walls, rows)
    return blocks, solve_map(blocks, options.smoothing)


def _uneven(blocks: MapBlocks, solved: BlockMap, options: DistortionOptions) -> np.ndarray:
    """Return which walls deviate from the map of all walls."""
    seen = blocks.weight > 0.5
    limit = max(options.uneven_raw, 4 * solved.noise_raw)
    off = (np.abs(solved.remaining) > limit) & seen
    return np.asarray(off.sum(1) > options.uneven_share * np.maximum(seen.sum(1), 1))


def _correction(
    blocks: MapBlocks, solved: BlockMap, options: DistortionOptions, serial: str
) -> DisparityCorrection:
    used = blocks.weight > 0.5
    coverage = used.sum(0).reshape(blocks.shape).astype(np.uint8)
    low, high = blocks.level[used].min(), blocks.level[used].max()
    return DisparityCorrection(
        offset=to_pixels(solved.offset, blocks.shape).astype(np.float32),
        slope=(to_pixels(solved.slope, blocks.shape) / SPAN_RAW).astype(np.float32),
        reference_raw=solved.reference_raw,
        decay=solved.decay / SPAN_RAW,
        raw_range=(float(low - options.extrapolate_raw), float(high + options.extrapolate_raw)),
        coverage=np.kron(coverage, np.ones((BLOCK_PX, BLOCK_PX), np.uint8)),
        record=CorrectionRecord(
            serial=serial,
            made_at=datetime.now(UTC).isoformat(timespec="seconds"),
            method="smooth map that varies with disparity",
        ),
    )


def _judged(
    correction: DisparityCorrection,
    walls: Sequence[WallFit],
    left_out: dict[str, str],
    disparity: DisparityModel,
    options: DistortionOptions,
) -> DistortionCalibration:
    figures = tuple(_figures(wall, correction, disparity) for wall in walls)
    covered = float(correction.covered.mean())
    std = (
        float(np.median(correction.deviation[correction.covered]))
        if correction.deviation is not None and covered > 0
        else float("inf")
    )
    numbers = {
        "walls": float(len(walls)),
        "covered_share": covered,
        "deviation_raw": std,
        "nearest_mm": min(figure.distance_mm for figure in figures),
        "farthest_mm": max(figure.distance_mm for figure in figures),
        "rms_before_raw": float(np.sqrt(np.mean([f.rms_before_raw**2 for f in figures]))),
        "rms_after_raw": float(np.sqrt(np.mean([f.rms_after_raw**2 for f in figures]))),
    }
    return DistortionCalibration(
        correction=replace(correction, record=replace(correction.record, figures=numbers)),
        walls=figures,
        left_out=left_out,
        covered_share=covered,
        deviation_raw=std,
        advice=_advice(figures, covered, options.reach_mm),
        doubt=_doubt(numbers["rms_after_raw"]),
    )


def _figures(
    wall: WallFit, correction: DisparityCorrection, disparity: DisparityModel
) -> WallFigures:
    after = correction.corrected(wall.capture.raw) - wall.expected_raw
    normal = wall.plane / np.linalg.norm(wall.plane)
    return WallFigures(
        name=wall.capture.name,
        distance_mm=float(1 / wall.plane[2]),
        tilt_deg=float(np.degrees(np.arccos(np.clip(normal[2], -1, 1)))),
        filled_share=float(wall.wall.mean()),
        rms_before_raw=float(np.sqrt(np.nanmean(wall.residual_raw**2))),
        rms_after_raw=float(np.sqrt(np.nanmean(after[wall.wall] ** 2))),
    )


def _doubt(left_raw: float) -> str:
    if left_raw <= _GOOD_RAW:
        return ""
    return Message(
        "The walls are still off by {rms_raw:.1f} raw units, which is more than noise, as with "
        "boards held before a wall; capture flat, empty walls, with the sensor standing still.",
        rms_raw=left_raw,
    )


def _advice(
    figures: Sequence[WallFigures], covered: float, reach_mm: tuple[float, float]
) -> tuple[str, ...]:
    distances = [figure.distance_mm for figure in figures]
    advice: list[str] = []
    if len(figures) < 4:
        advice.append(
            Message(
                "Only {count} walls were used; six distances or more are better.",
                count=len(figures),
            )
        )
    if max(distances) < 1.2 * min(distances):
        advice.append(
            Message(
                "All walls lie at almost the same distance; capture {near:.0f} to {far:.0f} mm to "
                "learn how the distortion changes.",
                near=reach_mm[0],
                far=reach_mm[1],
            )
        )
    if covered < 0.95:
        advice.append(
            Message(
                "{share:.0%} of the image was never filled by a wall; move the board there.",
                share=1 - covered,
            )
        )
    return tuple(advice)
