"""What all calibration steps share: the sensor, the report, and saving both."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.progress import Progress
from insole_studio.cli.report_arguments import add_report_argument, check_reports
from insole_studio.cli.sensor_arguments import add_store_argument, store_of

if TYPE_CHECKING:
    from insole_core.sensing.sensor import Sensor
    from insole_core.workflows.calibration.steps import StepResult


def add_step_arguments(parser: argparse.ArgumentParser, holds: str) -> None:
    """Add the folder of images, the sensor and the reports.

    Parameters
    ----------
    holds
        Help text: what the folder contains.
    """
    parser.add_argument("folder", type=Path, metavar="FOLDER", help=f"holds {holds}")
    parser.add_argument("--serial", required=True, help="of the sensor, from its label")
    parser.add_argument(
        "--insist", action="store_true",
        help="save a result that does not fit a Kinect all the same; calibrate undo takes it back",
    )  # fmt: skip
    add_store_argument(parser)
    add_report_argument(parser)


def run_step(
    arguments: argparse.Namespace,
    progress: Progress,
    work: Callable[[Sensor, Progress], StepResult],
) -> None:
    """Load the sensor, improve its calibration, and save it with its reports.

    Parameters
    ----------
    work
        Fits the step's part of the calibration of the sensor as known so far.

    Raises
    ------
    InsoleError
    """
    from insole_core.errors import CalibrationError
    from insole_core.sensing.nominal_kinect import nominal_kinect
    from insole_core.workflows.calibration.calibration_storage import keep_step

    check_reports(arguments)
    store = store_of(arguments)
    known = store.load(arguments.serial) or nominal_kinect(arguments.serial)
    result = work(known, progress.part(0, 0.9))
    if result.doubt and not arguments.insist:
        raise CalibrationError(
            f"Nothing was saved: {_clause(result.doubt)}, or add --insist to save it all the same."
        )
    progress.step(0.9, "Writing the calibration and its reports")
    folder = keep_step(result, store, arguments.report)
    for sentence in result.sentences:
        print(sentence)
    if result.doubt:
        print(f"Warning: {result.doubt}", file=sys.stderr)
    for sentence in result.advice:
        print(f"Advice: {sentence}", file=sys.stderr)
    progress.step(1.0, f"Done: {folder}")


def _clause(sentence: str) -> str:
    return sentence[:1].lower() + sentence[1:].removesuffix(".")
