"""The calibration step that learns a sensor's pattern of dots from walls, and its check by one."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np

from insole_core.calibration.infrared.infrared_walls import (
    InfraredWall,
    infrared_wall_names,
    read_infrared_picture,
    read_infrared_wall,
)
from insole_core.calibration.infrared.learnt_reference import (
    LearntReference,
    find_drift,
    find_infrared_wall,
    learn_reference,
)
from insole_core.calibration.walls.wall_plane import WallFit
from insole_core.errors import CalibrationError, InputError, InsoleError
from insole_core.evaluation.calibration_sections import draw_map
from insole_core.evaluation.report import Number, Plot, ReportSection, Share
from insole_core.geometry.arrays import ByteArray
from insole_core.memo import Memo
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.sensing.infrared_reference import RAW_PER_PX, InfraredReference
from insole_core.sensing.sensor import Sensor
from insole_core.workflows.calibration.picture_readiness import (
    PictureInspection,
    Readiness,
    missing_walls,
    small,
    wall_cells,
    wall_distance_mm,
    wall_sentence,
    with_wall,
)
from insole_core.workflows.calibration.steps import StepResult

PATTERN = "infrared_pattern"
"""Key of the step."""
DOTS_DISTANCES_MM = (600, 700, 800, 900)
_GOOD_WALLS = 8
"""Twice the least; more gain little."""


def inspect_infrared_walls(
    folder: Path, sensor: Sensor, memo: Memo, progress: Progress = SILENT
) -> Readiness:
    """Find the wall in every infrared picture.

    Parameters
    ----------
    sensor
        That recorded them.
    memo
        Caches the inspections: the folder grows while walls are taken, and each is inspected once.

    Raises
    ------
    InputError, CalibrationError
        When the folder cannot be read, or is of another sensor.
    Cancelled
    """
    names = infrared_wall_names(folder, sensor.serial)
    found = []
    for done, name in enumerate(names):
        progress.step(done / len(names), "Finding the wall in {capture}", capture=name)
        path = folder / name
        key = path, path.stat().st_mtime_ns, sensor
        found.append(memo.get("dots", key, partial(_look_at_wall, folder, name, sensor)))
    walls = [wall for _, wall in found if wall is not None]
    few = _GOOD_WALLS - len(walls)
    missing = (
        (Message("Take {count} more walls at other distances.", count=few),) if few > 0 else ()
    )
    return Readiness(
        tuple(look for look, _ in found),
        (*missing, *missing_walls(walls, DOTS_DISTANCES_MM)),
        wall_cells(walls),
        tuple(map(wall_distance_mm, walls)),
    )


def _look_at_wall(
    folder: Path, name: str, sensor: Sensor
) -> tuple[PictureInspection, WallFit | None]:
    picture = np.zeros((480, 640), np.uint8)
    try:
        picture = _grey(folder / name)
        wall = find_infrared_wall(read_infrared_wall(folder, name), sensor)
    except InsoleError as error:
        return PictureInspection(name, False, str(error), small(with_wall(picture, None))), None
    shown = small(with_wall(picture, wall.wall))
    return PictureInspection(name, True, wall_sentence(wall), shown), wall


def _grey(path: Path) -> ByteArray:
    levels = read_infrared_picture(path)
    brightest = max(float(np.percentile(levels, 99)), 1.0)
    return np.clip(levels * (255 / brightest), 0, 255).astype(np.uint8)


def learn_pattern_step(folder: Path, sensor: Sensor, progress: Progress = SILENT) -> StepResult:
    """Learn a sensor's pattern of dots; walls that cannot be used are left out.

    Parameters
    ----------
    folder
        With ``infrared_00.png …`` and ``depth_00.png …``.
    sensor
        That recorded them.

    Raises
    ------
    CalibrationError
        When the walls do not suffice, or are of another sensor.
    InputError
        When the folder cannot be read.
    Cancelled
    """
    names = infrared_wall_names(folder, sensor.serial)
    walls: list[InfraredWall] = []
    left_out: dict[str, str] = {}
    for done, name in enumerate(names):
        progress.step(0.2 * done / len(names), "Reading {file}", file=name)
        try:
            walls.append(read_infrared_wall(folder, name))
        except (CalibrationError, InputError) as error:
            left_out[name] = error.message
    learnt = learn_reference(walls, sensor, progress.part(0.2, 1))
    reference, figures = learnt.reference, learnt.reference.record.figures
    left_out |= learnt.left_out
    return StepResult(
        sensor=sensor,
        section=_section(learnt, left_out),
        sentences=(
            Message(
                "{used} of {taken} walls were used, {nearest_mm:.0f} to {farthest_mm:.0f} mm; "
                "{share:.0%} of the pattern was seen often enough.",
                used=len(learnt.used),
                taken=len(names),
                nearest_mm=figures["nearest_mm"],
                farthest_mm=figures["farthest_mm"],
                share=figures["covered_share"],
            ),
            Message(
                "The distortion leaves {residual_px:.3f} px of the walls' shifts (rms).",
                residual_px=figures["residual_raw"] / RAW_PER_PX,
            ),
        ),
        residual=(figures["residual_raw"] / RAW_PER_PX, "px"),
        advice=_left_out(left_out),
        reference=reference,
    )


def _left_out(left_out: dict[str, str]) -> tuple[str, ...]:
    return tuple(
        Message("{what} was left out: {reason}", what=name, reason=reason)
        for name, reason in left_out.items()
    )


def _section(learnt: LearntReference, left_out: dict[str, str]) -> ReportSection:
    reference = learnt.reference
    figures = reference.record.figures
    distortion = reference.correction.offset.astype(float)
    return ReportSection(
        key=PATTERN,
        title="Pattern of dots",
        numbers=(
            Number("walls", "Walls used", len(learnt.used)),
            Share("covered_share", "Share of the pattern covered", figures["covered_share"]),
            Number("residual_px", "Left of the shifts (rms)", figures["residual_raw"] / 8, "px"),
        ),
        sentences=_left_out(left_out),
        plots=(
            Plot(
                "Distortion of the pattern, raw units",
                lambda figure: draw_map(figure, image=distortion),
            ),
        ),
    )


def check_pattern(
    folder: Path, sensor: Sensor, reference: InfraredReference | None
) -> tuple[str, ...]:
    """Say by the newest wall of a folder whether a sensor's pattern of dots still holds.

    Returns
    -------
    tuple of str
        Sentences.

    Raises
    ------
    CalibrationError
        When no pattern is kept, it has drifted, or the wall cannot be used.
    InputError
        When the folder or a picture cannot be read.
    """
    if reference is None:
        raise CalibrationError(
            "No pattern of dots of sensor {serial} is kept; learn it first.", serial=sensor.serial
        )
    name = infrared_wall_names(folder, sensor.serial)[-1]
    drift = find_drift(read_infrared_wall(folder, name), sensor, reference)
    if drift.doubt:
        raise CalibrationError("{what}: {reason}", what=name, reason=drift.doubt)
    return (
        Message(
            "By {wall} the pattern of {day} still holds: it has drifted by {drift_px:.3f} px, and "
            "the wall is like it ({likeness:.2f}).",
            wall=name,
            day=reference.record.made_at[:10],
            drift_px=drift.drift_px,
            likeness=drift.likeness,
        ),
        "A shift along the rows that is the same on all of the wall cannot be seen.",
    )
