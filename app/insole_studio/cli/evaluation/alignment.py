"""``insole-studio evaluate alignment``: how well colour is aligned with depth."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.board_arguments import add_board_arguments
from insole_studio.cli.correspondences import read_correspondences
from insole_studio.cli.evaluation.arguments import add_evaluation_arguments
from insole_studio.cli.report_arguments import check_reports, conclude
from insole_studio.cli.sensor_arguments import evaluated_sensor

NAME = "alignment"
HELP = "misalignment of colour and depth at several distances (thesis table 2)"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_evaluation_arguments(
        parser, "color_000 … and ir_000 … of a board in the same positions, or is such a file of "
        "marked points as the manual describes",
    )  # fmt: skip
    add_board_arguments(parser, required=False)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Detect or read the points, measure, and check the limits."""
    check_reports(arguments)
    from insole_core.evaluation.alignment import evaluate_alignment
    from insole_core.evaluation.evaluation_sections import alignment_section

    sensor = evaluated_sensor(arguments)
    points = read_correspondences(arguments, sensor, progress.part(0, 0.9))
    progress.step(0.9, "Measuring the misalignment")
    section = alignment_section(evaluate_alignment(sensor, points))
    conclude(section, sensor.serial, arguments)
