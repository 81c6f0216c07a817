"""``insole-studio evaluate resolution``: pixel spacing and depth step, against theory."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.evaluation.arguments import add_evaluation_arguments
from insole_studio.cli.report_arguments import check_reports, conclude
from insole_studio.cli.sensor_arguments import evaluated_sensor

NAME = "resolution"
HELP = "spatial and depth resolution over distance, against theory (thesis figures 13, 14)"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_evaluation_arguments(
        parser, "a sub-folder of raw depth images for each wall, or one image each"
    )


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the walls, measure them, and check the limits."""
    check_reports(arguments)
    from insole_core.evaluation.evaluation_sections import resolution_section
    from insole_core.evaluation.resolution import evaluate_resolution
    from insole_core.workflows.calibration.wall_steps import check_recorded_with, read_walls

    sensor = evaluated_sensor(arguments)
    captures = read_walls(arguments.folder, progress=progress.part(0, 0.8))
    check_recorded_with(sensor.serial, captures)
    progress.step(0.8, "Measuring the resolution")
    section = resolution_section(
        [evaluate_resolution(one, sensor.depth_camera, sensor.disparity) for one in captures]
    )
    conclude(section, sensor.serial, arguments)
