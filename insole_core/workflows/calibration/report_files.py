"""Write reports of calibrations and evaluations to files."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

from insole_core.errors import UsageError
from insole_core.evaluation.report import Report, ReportSection
from insole_core.evaluation.report_files import WRITERS
from insole_core.files.temporary import is_unfinished
from insole_core.files.transaction import Transaction
from insole_core.messages import joined


def make_report(title: str, serial: str, sections: Sequence[ReportSection]) -> Report:
    """Return a report with the current time (UTC).

    Parameters
    ----------
    serial
        Of the sensor.
    """
    return Report(title, serial, datetime.now(UTC).isoformat(timespec="seconds"), tuple(sections))


def check_report_paths(paths: Sequence[Path]) -> None:
    """Check that each suffix is one in which reports are written.

    Raises
    ------
    UsageError
        Names the first path that has another suffix.
    """
    for path in paths:
        if path.suffix.lower() not in WRITERS:
            raise UsageError(
                "{path} is no name of a report; let it end in {suffixes}.",
                path=path,
                suffixes=joined(WRITERS),
            )


def write_reports(report: Report, paths: Sequence[Path]) -> None:
    """Write a report in the form that the suffix of each path selects: all of them or none.

    Parameters
    ----------
    paths
        As `check_report_paths` accepts them; those that a `Transaction` of the caller has opened
        are only written.

    Raises
    ------
    OutputError
        When a place cannot be written; files that were there before are untouched.
    """
    written: dict[str, Path] = {}
    with Transaction() as outputs:
        for path in paths:
            beside = path if is_unfinished(path) else outputs.file(path)
            suffix = path.suffix.lower()
            if suffix in written:
                shutil.copyfile(written[suffix], beside)
            else:
                WRITERS[suffix](report, beside)
            written[suffix] = beside


def report_paths(folder: Path, stem: str) -> list[Path]:
    """Return the path of a report in every form, named `stem`."""
    return [folder / f"{stem}{suffix}" for suffix in WRITERS]
