"""Arguments of evaluations and reports, and the limits that they are judged by."""

from __future__ import annotations

import argparse
import math
from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import CalibrationError, UsageError
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.sensor_arguments import add_evaluated_sensor

if TYPE_CHECKING:
    from insole_core.evaluation.report import Limits, ReportSection

BUNDLED = Path("limits of the product")
"""Stands for the bundled limits."""


def add_report_argument(parser: argparse.ArgumentParser) -> None:
    """Add the reports."""
    parser.add_argument(
        "--report", action=OutputPath, nargs="+", default=[], metavar="report.html",
        help="write a report, as .html, .pdf or .json by its name; several may be named",
    )  # fmt: skip


def add_limit_arguments(parser: argparse.ArgumentParser, judged_by_default: bool) -> None:
    """Add the limits.

    Parameters
    ----------
    judged_by_default
        Whether the bundled limits apply if none are named, as in an acceptance test.
    """
    parser.add_argument(
        "--limits", type=Path, nargs="?", const=BUNDLED, metavar="limits.json",
        default=BUNDLED if judged_by_default else None,
        help="judge by the limits of a file; without its name by those that come with the product",
    )  # fmt: skip
    parser.add_argument(
        "--limit", action="append", default=[], metavar="KEY=NUMBER",
        help="judge one number of the report by its key, for example mean_abs_mm_raw=2.5",
    )  # fmt: skip


def check_reports(arguments: argparse.Namespace, known: Collection[str] = ()) -> None:
    """Reject report names of an unknown format and limits that say nothing, before any work.

    Parameters
    ----------
    known
        Keys of the numbers that the report may have; empty where these are told by its data.

    Raises
    ------
    UsageError
    InputError
        When a file of limits cannot be read.
    """
    from insole_core.workflows.calibration.report_files import check_report_paths

    check_report_paths(arguments.report)
    if "limits" in arguments:
        _limits_of(arguments, "")
        if known:
            _check_keys(arguments, known)


def conclude(section: ReportSection, serial: str, arguments: argparse.Namespace) -> None:
    """Print an evaluation, write its reports, and check it against the limits.

    Parameters
    ----------
    serial
        Of the evaluated sensor.

    Raises
    ------
    CalibrationError
        When a limit is exceeded; the reports are written nevertheless.
    UsageError
        When --limit names no number of the evaluation.
    InsoleError
    """
    from insole_core.evaluation.report import judged, section_lines
    from insole_core.workflows.calibration.report_files import make_report, write_reports

    _check_keys(arguments, [number.key for number in section.numbers])
    section = judged(section, _limits_of(arguments, section.key))
    report = make_report(section.title, serial, [section])
    write_reports(report, arguments.report)
    print("\n".join(section_lines(section)))
    if not report.passed:
        failed = "; ".join(f"{n.label} {n.text}, limit {n.limit:g}" for n in report.failed)
        raise CalibrationError(
            f"The acceptance failed: {failed}; calibrate the sensor again, or have it checked."
        )


def _limits_of(arguments: argparse.Namespace, section: str) -> Limits:
    from insole_core.evaluation.report import bundled_limits_path, load_limits

    path: Path | None = arguments.limits
    limits = {} if path is None else load_limits(bundled_limits_path() if path == BUNDLED else path)
    named = dict(_limit(text) for text in arguments.limit)
    return {**limits, section: {**limits.get(section, {}), **named}}


def _check_keys(arguments: argparse.Namespace, known: Collection[str]) -> None:
    for key, _limit_of in map(_limit, arguments.limit):
        if key not in known:
            raise UsageError(
                f'--limit is of "{key}", and the report has no such number; use one of '
                f"{', '.join(known)}."
            )


def _limit(text: str) -> tuple[str, float]:
    key, _, number = text.partition("=")
    try:
        limit = float(number)
    except ValueError:
        limit = math.nan
    if not 0 <= limit < math.inf:
        raise UsageError(
            f'--limit is "{text}"; give the key of a number of the report and its limit, for '
            "example mean_abs_mm_raw=2.5, from 0 on."
        )
    return key, limit


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
