"""``insole-studio evaluate repeat``: how far measures scatter when a foot is captured again."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from insole_core.errors import CalibrationError
from insole_core.progress import Progress
from insole_studio.cli.report_arguments import (
    add_limit_arguments,
    add_report_argument,
    check_reports,
    conclude,
)

NAME = "repeat"
HELP = "how far the measures of one foot scatter over captures of it, kept as the ± of this place"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "sessions", type=Path, nargs="+", metavar="SESSION",
        help="3 to 10 captures of the same foot or cast, taken off and put back before each",
    )  # fmt: skip
    add_limit_arguments(parser, judged_by_default=False)
    add_report_argument(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Compare the captures, report them, and keep the test for measures of these sensors."""
    from insole_core.evaluation.repeat_section import number_keys, repeat_section
    from insole_core.workflows.calibration.repeat_tests import RepeatTests
    from insole_core.workflows.calibration.repeated_captures import repeat_captures
    from insole_core.workflows.calibration.sensor_store import sensors_folder_of_user

    check_reports(arguments, number_keys())
    repeated = repeat_captures(arguments.sessions, progress.part(0.0, 0.9))
    for warning in repeated.warnings:
        print(f"Warning: {warning}", file=sys.stderr)
    progress.step(0.9, "Writing the report")
    try:
        conclude(repeat_section(repeated.evaluation), ", ".join(repeated.place.sensors), arguments)
    except CalibrationError:
        print("The test is not kept: the ± of measures stay as they were.", file=sys.stderr)
        raise
    path = RepeatTests(sensors_folder_of_user()).keep(repeated.test)
    print(f"From now on the ± of measures with these sensors: {path}.")
