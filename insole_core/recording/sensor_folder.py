"""A sensor stored as a folder: sensor.json, and correction.npz where it has a correction."""

from __future__ import annotations

import json
from pathlib import Path

from insole_core.errors import InputError
from insole_core.files.atomic import write_private
from insole_core.given_file import read_given
from insole_core.json_object import JsonObject
from insole_core.recording.sensor_json import correction_name, parse_sensor, sensor_json
from insole_core.sensing.correction import load_correction
from insole_core.sensing.sensor import Sensor
from insole_core.strict_json import MOST_BYTES

SENSOR_FILE = "sensor.json"
CORRECTION_FILE = "correction.npz"


def read_sensor(folder: Path) -> Sensor:
    """Read the sensor of a folder, for example of one view of a session.

    Raises
    ------
    InputError
        When a file is missing, or violates the format.
    """
    path = folder / SENSOR_FILE
    if not path.exists():
        raise InputError(
            "{path} does not exist; name a folder that holds a sensor.json.", path=path
        )
    return _sensor_of(JsonObject.read(path), folder)


def check_readable(folder: Path) -> None:
    """Check that a sensor that was just written to a folder can be read again.

    Raises
    ------
    InputError
        Names the value that the format does not allow, without the folder.
    """
    text = read_given(folder / SENSOR_FILE, MOST_BYTES)
    _sensor_of(JsonObject.parse(SENSOR_FILE, text), folder)


def write_sensor(sensor: Sensor, folder: Path) -> None:
    """Write a sensor into an existing folder.

    Raises
    ------
    OutputError
        When the correction cannot be written.
    OSError
        When sensor.json cannot be written; the caller, who made the folder, reports it.
    """
    name = None
    if sensor.correction is not None:
        name = CORRECTION_FILE
        sensor.correction.save(folder / name)
    text = json.dumps(sensor_json(sensor, name), indent=1, ensure_ascii=False)
    write_private(folder / SENSOR_FILE, f"{text}\n".encode())


def _sensor_of(root: JsonObject, folder: Path) -> Sensor:
    named = correction_name(root)
    return parse_sensor(root, None if named is None else load_correction(folder / named))
