"""What is known about a recording or a scan, to be stored with it."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Final

from insole_core.recording.reader import is_session, read_session
from insole_core.records.capture import SIDE, CaptureFacts
from insole_core.sensing.sensor import CalibrationRecord, Sensor

_DISTORTION: Final = "distortion"
_LEFT: Final = "rms_after_raw"


def capture_facts(path: Path) -> CaptureFacts:
    """Return what a session tells of itself; nothing of a scan.

    Raises
    ------
    InputError
        When it is a session that cannot be read.
    """
    if not is_session(path):
        return CaptureFacts()
    session = read_session(path)
    sensors = {view.sensor.serial: view.sensor for view in session.views}
    steps = [(serial, step) for serial, sensor in sensors.items() for step in _calibration(sensor)]
    return CaptureFacts(
        recorded_at=session.manifest.recorded_at,
        sensor_serials=tuple(sensors),
        calibrated_on=min((step.made_at for _, step in steps), key=_moment, default=""),
        calibration_residuals={
            f"{serial}: {step.step.replace('_', ' ')}, {step.unit}": round(step.residual, 3)
            for serial, step in steps
        },
        report={} if session.edits.side is None else {SIDE: session.edits.side.value},
    )


def _calibration(sensor: Sensor) -> Iterator[CalibrationRecord]:
    """Yield what a session tells of a calibration; the correction has always told its own."""
    yield from sensor.calibration
    record = None if sensor.correction is None else sensor.correction.record
    is_told = any(step.step == _DISTORTION for step in sensor.calibration)
    if record is not None and not is_told and record.made_at and _LEFT in record.figures:
        yield CalibrationRecord(_DISTORTION, record.made_at, record.figures[_LEFT], "raw")


def _moment(made_at: str) -> datetime:
    moment = datetime.fromisoformat(made_at)
    return moment if moment.tzinfo else moment.replace(tzinfo=UTC)
