"""A capture of a visit, as a value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class CaptureFacts:
    """What is known about a recording or a scan.

    Parameters
    ----------
    recorded_at
        ISO 8601, UTC; empty where unknown.
    calibrated_on
        ISO 8601, of the oldest calibration of its sensors; empty where unknown.
    calibration_residuals
        By serial number of the sensor, mm.
    report
        Of the reconstruction, as `insole-studio reconstruct --report` writes it.
    """

    recorded_at: str = ""
    sensor_serials: tuple[str, ...] = ()
    calibrated_on: str = ""
    calibration_residuals: Mapping[str, float] = field(default_factory=dict)
    report: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Capture:
    """A recording or a scan of a visit, stored with it.

    Parameters
    ----------
    kind
        ``session`` or ``mesh``.
    file_name
        The name that it had, for display; never part of a path.
    source_sha256
        As a case names its scan: of the manifest of a session's folder, or of the file.
    """

    id: str
    visit_id: str
    kind: str
    file_name: str
    content_sha256: str
    source_sha256: str
    facts: CaptureFacts
    program_version: str
    created_at: str
    author: str
