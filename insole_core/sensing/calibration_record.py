"""When a sensor was calibrated, and how well: told by its sensor.json, step by step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

Unit = Literal["px", "raw", "mm"]
UNITS: tuple[Unit, ...] = get_args(Unit)


@dataclass(frozen=True)
class CalibrationRecord:
    """One step of a calibration, as it was done last.

    Parameters
    ----------
    step
        Key of its section in the report, such as ``camera`` or ``distortion``.
    made_at
        ISO 8601, UTC.
    residual
        What the step left unexplained (rms; of a shift the largest), in `unit`.
    """

    step: str
    made_at: str
    residual: float
    unit: Unit
