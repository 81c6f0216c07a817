"""``insole-studio evaluate wall``: how far a flat wall is measured from flat."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from typing import TYPE_CHECKING

from insole_core.progress import Progress
from insole_studio.cli.evaluation.arguments import add_evaluation_arguments
from insole_studio.cli.report_arguments import check_reports, conclude
from insole_studio.cli.sensor_arguments import evaluated_sensor

if TYPE_CHECKING:
    from insole_core.calibration.walls.captures import WallCapture
    from insole_core.evaluation.report import ReportSection
    from insole_core.evaluation.wall import Correction
    from insole_core.sensing.sensor import Sensor

NAME = "wall"
HELP = "error of a flat wall over distance, before and after correction (thesis figure 11)"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_evaluation_arguments(
        parser, "a sub-folder of raw depth images for each wall, or one image each"
    )
    parser.add_argument(
        "--leave-one-out", action="store_true",
        help="correct each wall by a map made from the other walls of the folder: raw, the two "
        "algorithms of the thesis, and the default",
    )  # fmt: skip


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the walls, measure them, and check the limits."""
    check_reports(arguments)
    from insole_core.workflows.calibration.wall_steps import check_recorded_with, read_walls

    sensor = evaluated_sensor(arguments)
    captures = read_walls(arguments.folder, progress=progress.part(0, 0.4))
    check_recorded_with(sensor.serial, captures)
    measure = _leave_one_out if arguments.leave_one_out else _before_and_after
    section = measure(captures, sensor, progress.part(0.4, 0.9))
    progress.step(0.9, "Writing the report")
    conclude(section, sensor.serial, arguments)


def _leave_one_out(
    captures: list[WallCapture], sensor: Sensor, progress: Progress
) -> ReportSection:
    from insole_core.evaluation.evaluation_sections import wall_section
    from insole_core.evaluation.leave_one_out import leave_one_out

    section = wall_section(leave_one_out(captures, sensor.depth_camera, sensor.disparity, progress))
    return replace(section, title="Error of a flat wall, each corrected from the others")


def _before_and_after(
    captures: list[WallCapture], sensor: Sensor, progress: Progress
) -> ReportSection:
    from insole_core.evaluation.evaluation_sections import wall_section
    from insole_core.evaluation.wall import NoCorrection, wall_errors
    from insole_core.evaluation.wall_pictures import wall_pictures

    progress.step(0.0, "Measuring the walls")
    corrections: dict[str, Correction] = {"raw": NoCorrection()}
    if sensor.correction is not None:
        corrections["corrected"] = sensor.correction
    else:
        print(
            "The distortion of this sensor was not calibrated yet; only the raw error is measured.",
            file=sys.stderr,
        )
    camera, disparity = sensor.depth_camera, sensor.disparity
    section = wall_section(wall_errors(captures, corrections, camera, disparity))
    pictures = wall_pictures(captures, corrections, camera, disparity)
    return replace(section, plots=section.plots + pictures)
