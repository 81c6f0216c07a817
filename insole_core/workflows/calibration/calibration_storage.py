"""Save the result of a calibration step: the sensor, and the report of the step."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from insole_core.files.transaction import Transaction
from insole_core.regular_file import read_regular
from insole_core.sensing.sensor import CalibrationRecord
from insole_core.strict_json import MOST_BYTES
from insole_core.workflows.calibration.report_files import make_report, report_paths, write_reports
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_core.workflows.calibration.steps import StepResult


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
    said = dict.fromkeys((*doubt, *result.sentences, *result.section.sentences, *result.advice))
    section = replace(result.section, sentences=tuple(said))
    report = make_report(section.title, result.sensor.serial, [section])
    done = CalibrationRecord(section.key, report.made_at, *result.residual)

    with Transaction() as outputs:
        copies = [outputs.file(path) for path in further]

        def attach(folder: Path) -> None:
            write_reports(report, [*report_paths(folder, section.key), *copies])

        return store.save(result.sensor.calibrated(done), attach, outputs)


def step_date(store: SensorStore, serial: str, key: str) -> str:
    """Return the date (ISO 8601) a step was last done, from its report; empty when it never was.

    Parameters
    ----------
    key
        Of the step's section in the report.

    Raises
    ------
    UsageError
        When the serial number is not one.
    """
    path = store.folder_of(serial) / f"{key}.json"
    try:
        values = json.loads(read_regular(path, MOST_BYTES))
    except (OSError, ValueError, RecursionError):
        return ""
    made_at = values.get("made_at", "") if isinstance(values, dict) else ""
    return str(made_at)[:10]
