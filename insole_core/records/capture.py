"""A capture of a visit, as a value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, Final

from insole_core.geometry.side import Side
from insole_core.messages import Message
from insole_core.records.marks import MEASURED_BY, SCANNED_HOW, SCANNED_WHEN
from insole_core.records.record_field import Made

NOT_RECORDED: Final = "not recorded"
"""Of the calibration of sensors, in sessions of before it was stored."""
SIDE: Final = "side"
"""In the report of a session: which foot it was taken as by hand."""


@dataclass(frozen=True)
class CaptureFacts:
    """What is known about a recording or a scan.

    Parameters
    ----------
    recorded_at
        ISO 8601, UTC; empty where unknown.
    calibrated_on
        ISO 8601, of the oldest step of the calibration of its sensors; empty where not recorded.
    calibration_residuals
        By serial number of the sensor, step and unit: ``A00362A00127049A: camera, px``.
    report
        Of the reconstruction, as `insole-studio reconstruct --report` writes it; and ``side``,
        where the session was taken as another foot than it was recorded as.
    """

    recorded_at: Annotated[str, Made("recording day", SCANNED_WHEN)] = ""
    sensor_serials: Annotated[tuple[str, ...], Made("sensors", MEASURED_BY, stored="[]")] = ()
    calibrated_on: Annotated[str, Made("calibration day", MEASURED_BY)] = ""
    calibration_residuals: Annotated[
        Mapping[str, float], Made("calibration residuals", MEASURED_BY, stored="{}")
    ] = field(default_factory=dict)
    report: Annotated[Mapping[str, Any], Made("report", SCANNED_HOW, stored="{}")] = field(
        default_factory=dict
    )

    @property
    def taken_as(self) -> Side | None:
        """Which foot somebody said by hand that the session shows; None where nobody did."""
        told = self.report.get(SIDE)
        return next((side for side in Side if side == told), None)

    @property
    def residual_lines(self) -> list[Message]:
        """What each step of the calibration left: "A00362A00127049A: camera 0.31 px"."""
        lines = []
        for name, value in self.calibration_residuals.items():
            what, _, unit = name.rpartition(", ")
            serial, _, step = what.rpartition(": ")
            lines.append(
                Message(
                    "{serial}: {step} {value:.2f} {unit}",
                    serial=serial,
                    step=step,
                    value=value,
                    unit=unit,
                )
            )
        return lines


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
