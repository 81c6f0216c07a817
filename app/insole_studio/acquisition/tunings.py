"""What somebody has set of each sensor, kept for the next time that it is opened."""

from __future__ import annotations

import json
import logging
from pathlib import Path
from typing import Any

from insole_core.errors import InputError, OutputError
from insole_core.files.atomic import make_output_folder, write_text
from insole_core.json_object import JsonObject
from insole_studio.acquisition.messages import UNTUNED, Preset, Tuning

log = logging.getLogger(__name__)

TUNING_FILE = "sensor_settings.json"
"""Beside the calibrated sensors."""
_MOST_MW = 10_000.0
_PRESETS = tuple(preset.value for preset in Preset)


def as_json(tuning: Tuning) -> dict[str, Any]:
    """Return what is set of a sensor for a file; what it has not is left out."""
    preset = None if tuning.preset is None else tuning.preset.value
    entries = {"preset": preset, "laser_mw": tuning.laser_mw, "infrared_pair": tuning.pair}
    return {key: value for key, value in entries.items() if value is not None}


class Tunings:
    """Keeps in a file what was set of every sensor.

    Parameters
    ----------
    path
        A JSON file; None keeps nothing.
    asked
        What a command asks of every sensor; it goes before what is kept.
    """

    def __init__(self, path: Path | None = None, asked: Tuning = UNTUNED) -> None:
        self._path = path
        self.asked = asked

    def kept(self, serial: str) -> Tuning:
        """Return what was set of a sensor the last time."""
        return self._read().get(serial, UNTUNED)

    def keep(self, serial: str, tuning: Tuning) -> None:
        """Note what is set of a sensor."""
        if self._path is None:
            return
        known = {key: as_json(value) for key, value in (self._read() | {serial: tuning}).items()}
        try:
            make_output_folder(self._path.parent)
            write_text(json.dumps({"sensors": known}, indent=1) + "\n", self._path)
        except OutputError as error:
            log.warning("what was set of a sensor is not kept: %s", error)

    def _read(self) -> dict[str, Tuning]:
        if self._path is None or not self._path.exists():
            return {}
        try:
            sensors = JsonObject.read(self._path).object("sensors")
            return {serial: _tuning(sensors.object(serial)) for serial in sensors.values}
        except InputError as error:
            log.warning("sensors start as they are: %s", error)
            return {}


def _tuning(item: JsonObject) -> Tuning:
    return Tuning(
        Preset(item.choice("preset", _PRESETS)) if item.has("preset") else None,
        item.number("laser_mw", 0, _MOST_MW) if item.has("laser_mw") else None,
        item.flag("infrared_pair") if item.has("infrared_pair") else None,
    )
