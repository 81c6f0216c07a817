"""What all evaluations share: the sensor, the limits and the reports."""

from __future__ import annotations

import argparse
from pathlib import Path

from insole_studio.cli.report_arguments import add_limit_arguments, add_report_argument
from insole_studio.cli.sensor_arguments import add_evaluated_sensor


def add_evaluation_arguments(
    parser: argparse.ArgumentParser, holds: str, judged_by_default: bool = False
) -> None:
    """Add the folder of images, the sensor, the limits and the reports.

    Parameters
    ----------
    holds
        Help text: what the folder contains.
    judged_by_default
        Whether limits apply even if none are named.
    """
    parser.add_argument("folder", type=Path, metavar="FOLDER", help=f"holds {holds}")
    add_evaluated_sensor(parser)
    add_limit_arguments(parser, judged_by_default)
    add_report_argument(parser)
