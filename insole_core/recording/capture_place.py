"""The place of a capture: its sensors, as calibrated, around its frame of markers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from insole_core.json_object import JsonObject


@dataclass(frozen=True)
class CapturePlace:
    """What has to be the same for captures to scatter alike.

    Parameters
    ----------
    sensors
        Serial numbers, sorted.
    frame
        Digest of the reference system.
    calibrated_at
        When one of the sensors was calibrated last, ISO 8601; empty where nobody has noted it.
    """

    sensors: tuple[str, ...]
    frame: str
    calibrated_at: str = ""


def place_to_json(place: CapturePlace) -> dict[str, Any]:
    """Return a place as plain values."""
    return {**vars(place), "sensors": list(place.sensors)}


def place_from_json(place: JsonObject) -> CapturePlace:
    """Read a place.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    return CapturePlace(
        tuple(place.texts("sensors")),
        place.text("frame"),
        place.text("calibrated_at", empty=True),
    )
