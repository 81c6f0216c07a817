"""Conversion between the keys ``pressure`` and ``picture`` of a foot and `PlantarLayers`."""

from __future__ import annotations

import base64
import binascii
from typing import Any

import cv2
import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.json_object import JsonObject
from insole_core.picture_size import PNG, picture_size
from insole_core.pressure.laid_map import (
    MOST_KEPT_PIXELS,
    FootprintPicture,
    Placement,
    PlantarLayers,
    PressureMap,
)
from insole_core.pressure.recording import PITCH_MM

_NO_SENSOR = -1.0
_MOST_KPA, _MOST_MM, _MOST_CELLS = 1e4, 2000.0, 512
_MOST_ENCODED = 8 * 2**20
_PIXEL_MM = (0.05, 10.0)


def plantar_to_json(plantar: PlantarLayers) -> dict[str, Any]:
    """Return what lies under a foot as plain values: a key for each that there is."""
    content: dict[str, Any] = {}
    if plantar.pressure is not None:
        laid = plantar.pressure
        kpa = np.where(np.isfinite(laid.kpa), np.round(laid.kpa, 1), _NO_SENSOR)
        content["pressure"] = {
            "device": laid.device,
            "shown": laid.shown,
            "pitch_mm": list(laid.pitch_mm),
            "placement": vars(laid.placement).copy(),
            "columns": laid.kpa.shape[1],
            "kpa": [float(value) for value in kpa.ravel()],
        }
    if plantar.picture is not None:
        picture = plantar.picture
        _, encoded = cv2.imencode(".png", picture.colors[:, :, ::-1])
        content["picture"] = {
            "pixel_mm": picture.pitch_mm,
            "placement": vars(picture.placement).copy(),
            "png": base64.b64encode(encoded.tobytes()).decode("ascii"),
        }
    return content


def plantar_from_json(foot: JsonObject) -> PlantarLayers:
    """Read what lies under a foot; empty for files without these keys.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    return PlantarLayers(
        _pressure(foot.object("pressure")) if foot.has("pressure") else None,
        _picture(foot.object("picture")) if foot.has("picture") else None,
    )


def _pressure(pressure: JsonObject) -> PressureMap:
    columns = pressure.integer("columns", 1, _MOST_CELLS)
    across, along = pressure.pair("pitch_mm")
    if not all(PITCH_MM[0] <= pitch <= PITCH_MM[1] for pitch in (across, along)):
        raise pressure.fail("pitch_mm", "is no distance of sensors")
    count = len(pressure.items("kpa"))
    if not count or count % columns or count > columns * _MOST_CELLS:
        raise pressure.fail("kpa", "has not the same number of sensors in each row")
    values: FloatArray = np.array(pressure.numbers("kpa", count, _NO_SENSOR, _MOST_KPA))
    kpa = np.where(values < 0, np.nan, values).reshape(-1, columns)
    if not (kpa > 0).any():
        raise pressure.fail("kpa", "holds no pressure")
    return PressureMap(
        kpa,
        (across, along),
        _placement(pressure.object("placement")),
        pressure.text("device", empty=True),
        pressure.text("shown"),
    )


def _picture(picture: JsonObject) -> FootprintPicture:
    text = picture.text("png")
    try:
        encoded = base64.b64decode(text, validate=True) if len(text) <= _MOST_ENCODED else b""
    except (binascii.Error, ValueError):
        encoded = b""
    width, height = (encoded.startswith(PNG) and picture_size(encoded)) or (0, 0)
    colors = None
    if 0 < width * height <= 2 * MOST_KEPT_PIXELS:
        colors = cv2.imdecode(np.frombuffer(encoded, np.uint8), cv2.IMREAD_COLOR)
    if colors is None:
        raise picture.fail("png", "is no picture")
    return FootprintPicture(
        np.ascontiguousarray(colors[:, :, ::-1], dtype=np.uint8),
        picture.number("pixel_mm", *_PIXEL_MM),
        _placement(picture.object("placement")),
    )


def _placement(placement: JsonObject) -> Placement:
    return Placement(
        placement.number("x_mm", -_MOST_MM, _MOST_MM),
        placement.number("y_mm", -_MOST_MM, _MOST_MM),
        placement.number("turn_deg", -360, 360),
        placement.flag("mirrored"),
    )
