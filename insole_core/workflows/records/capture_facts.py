"""What is known about a recording or a scan, to be stored with it."""

from __future__ import annotations

from pathlib import Path

from insole_core.recording.reader import is_session, read_session
from insole_core.records.capture import CaptureFacts


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
    sensors = [view.sensor for view in session.views]
    return CaptureFacts(
        recorded_at=session.manifest.recorded_at,
        sensor_serials=tuple(dict.fromkeys(sensor.serial for sensor in sensors)),
    )
