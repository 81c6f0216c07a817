"""Application of a stored distortion correction to the sensor it belongs to."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import datetime

from insole_core.errors import CalibrationError
from insole_core.messages import Message
from insole_core.sensing.correction import DisparityCorrection
from insole_core.sensing.sensor import Sensor

MOST_DAYS = 180.0
"""Older corrections are used with a warning."""


@dataclass(frozen=True, eq=False)
class CorrectedSensor:
    """A sensor with its correction, and the warnings to show to the user."""

    sensor: Sensor
    warnings: tuple[str, ...]


def apply_correction(
    sensor: Sensor, correction: DisparityCorrection, now: datetime, insist: bool = False
) -> CorrectedSensor:
    """Apply a correction to the sensor with the same serial number.

    Parameters
    ----------
    now
        Time zone aware; determines the age of the correction.
    insist
        Apply a correction of another device all the same, with a warning.

    Raises
    ------
    CalibrationError
        If it is for another kind of sensor, or belongs to another device and the user does not
        insist.
    """
    if not _is_of_its_kind(correction, sensor):
        raise CalibrationError(
            "The correction is not for the depth of sensor {serial}, a {model}; use one that was "
            "measured on this kind of sensor.",
            serial=sensor.serial,
            model=sensor.model,
        )
    warnings: list[str] = []
    if not correction.record.is_of(sensor.serial):
        problem = Message(
            "The correction was measured on sensor {owner}, not on {serial}",
            owner=correction.record.serial,
            serial=sensor.serial,
        )
        if not insist:
            raise CalibrationError(
                "{problem}; calibrate this sensor, or insist on using it with a warning.",
                problem=problem,
            )
        warnings.append(
            Message("{problem}; the depth may be wrong by several millimetres.", problem=problem)
        )
    warnings += _age_warning(correction, now)
    return CorrectedSensor(replace(sensor, correction=correction), tuple(warnings))


def _is_of_its_kind(correction: DisparityCorrection, sensor: Sensor) -> bool:
    if sensor.depth_unit_mm is not None and sensor.baseline_mm is None:
        return False  # it has no disparities that could be corrected
    unit = "raw" if sensor.depth_unit_mm is None else "px"
    camera = sensor.depth_camera
    is_of_its_size = correction.offset.shape == (camera.height, camera.width)
    return correction.record.unit == unit and is_of_its_size


def _age_warning(correction: DisparityCorrection, now: datetime) -> list[str]:
    age = correction.record.age_days(now)
    if age <= MOST_DAYS:
        return []
    how_old = Message("{days:.0f} days old", days=age) if age < float("inf") else "of unknown age"
    return [Message("The correction is {age}; calibrate the sensor again soon.", age=how_old)]
