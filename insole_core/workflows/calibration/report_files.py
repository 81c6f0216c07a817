"""Write the reports of calibrations and evaluations, and keep the result of a step."""

from __future__ import annotations

import json
import shutil
from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

from insole_core.errors import UsageError
from insole_core.evaluation.report import Report, ReportSection
from insole_core.evaluation.report_files import WRITERS
from insole_core.files.temporary import is_unfinished
from insole_core.files.transaction import Transaction
from insole_core.messages import joined
from insole_core.recording.sensor_folder import REFERENCE_FILE
from insole_core.regular_file import read_regular
from insole_core.sensing.sensor import CalibrationRecord
from insole_core.strict_json import MOST_BYTES
from insole_core.workflows.calibration.infrared_steps import PATTERN
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_core.workflows.calibration.steps import StepResult


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


def keep_step(result: StepResult, store: SensorStore, further: Sequence[Path] = ()) -> Path:
    """Save the sensor and its reports, named after the step: all of them or none.

    Parameters
    ----------
    further
        Additional files for the report.

    Returns
    -------
    Path
        The folder of the sensor.

    Raises
    ------
    UsageError
        When the serial number is not one.
    OutputError
        When a place cannot be written.
    """
    doubt = (result.doubt,) if result.doubt else ()
    found = (*result.warnings, *result.sentences, *result.section.sentences)
    said = dict.fromkeys((*doubt, *found, *result.advice))
    section = replace(result.section, sentences=tuple(said))
    report = make_report(section.title, result.sensor.serial, [section])
    done = CalibrationRecord(section.key, report.made_at, *result.residual)

    with Transaction() as outputs:
        copies = [outputs.file(path) for path in further]

        def attach(folder: Path) -> None:
            write_reports(report, [*report_paths(folder, section.key), *copies])
            if result.reference is not None:
                result.reference.save(folder / REFERENCE_FILE)

        return store.save(result.sensor.calibrated(done), attach, outputs)


def step_date(store: SensorStore, serial: str, key: str) -> str:
    """Return the date (ISO 8601) a step was last done, from its report; empty when it never was.

    The pattern of dots, which is also kept without a report, tells its date itself.

    Parameters
    ----------
    key
        Of the step's section in the report.

    Raises
    ------
    UsageError
        When the serial number is not one.
    """
    if key == PATTERN:
        return store.reference_date(serial)[:10]
    path = store.folder_of(serial) / f"{key}.json"
    try:
        values = json.loads(read_regular(path, MOST_BYTES))
    except (OSError, ValueError, RecursionError):
        return ""
    made_at = values.get("made_at", "") if isinstance(values, dict) else ""
    return str(made_at)[:10]
