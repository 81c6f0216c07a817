"""A sensor stored as a folder: sensor.json, and correction.npz where it has a correction."""

from __future__ import annotations

import json
import re
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np

from insole_core.errors import InputError
from insole_core.files.atomic import write_private
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import is_rotation, rigid
from insole_core.given_file import read_given
from insole_core.json_object import JsonObject
from insole_core.messages import joined
from insole_core.sensing.correction import DisparityCorrection, load_correction
from insole_core.sensing.disparity import (
    DisparityModel,
    FactoryDisparity,
    LinearInverseDisparity,
    TangentDisparity,
)
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import UNITS, CalibrationRecord, Sensor
from insole_core.strict_json import MOST_BYTES

DEPTH_SIZE = (640, 480)
COLOR_SIZES = ((1280, 1024), (1280, 960), (640, 480))
_STEP = re.compile(r"[a-z_]{1,32}")
_MOST_STEPS = 20
_TINY = 1e-9
_MOST_MM, _MOST_PX, _MOST_DISTORTION = 1e4, 1e5, 1e3
"""Far beyond any camera; larger numbers are mistakes, and overflow."""
SENSOR_FILE = "sensor.json"
CORRECTION_FILE = "correction.npz"


def parse_sensor(root: JsonObject, correction: DisparityCorrection | None) -> Sensor:
    """Read the calibration of one sensor.

    Parameters
    ----------
    root
        The root object of sensor.json.
    correction : optional
        The content of the file that ``disparity_correction`` names.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    faces = root.items("faces")
    if not faces or not all(isinstance(face, str) for face in faces):
        raise root.fail("faces", "must name at least one marker group")
    return Sensor(
        model=root.text("model"),
        serial=root.text("serial"),
        depth_camera=_camera(root.object("depth_camera"), (DEPTH_SIZE,)),
        color_camera=_camera(root.object("color_camera"), COLOR_SIZES),
        depth2color=_depth2color(root.object("depth2color")),
        disparity=_disparity(root.object("disparity")),
        correction=correction,
        faces=tuple(faces),
        calibration=_calibration(root.values.get("calibration")),
    )


def correction_name(root: JsonObject) -> str | None:
    """Return the name of the correction file beside sensor.json; None without one.

    Raises
    ------
    InputError
        When the name leads out of the folder.
    """
    if root.values.get("disparity_correction") is None:
        return None
    name = root.text("disparity_correction")
    if "/" in name or "\\" in name or ".." in name:
        raise root.fail("disparity_correction", "must name a file beside sensor.json")
    return name


def sensor_json(sensor: Sensor, correction: str | None) -> dict[str, Any]:
    """Return the JSON form of a sensor.

    Parameters
    ----------
    correction
        Name of the file that its correction is stored in; None without one.
    """
    values: dict[str, Any] = {
        "model": sensor.model,
        "serial": sensor.serial,
        "depth_camera": _camera_json(sensor.depth_camera),
        "color_camera": _camera_json(sensor.color_camera),
        "depth2color": {
            "rotation": sensor.depth2color[:3, :3].tolist(),
            "translation_mm": sensor.depth2color[:3, 3].tolist(),
        },
        "disparity": _disparity_json(sensor.disparity),
        "faces": list(sensor.faces),
    }
    if correction is not None:
        values["disparity_correction"] = correction
    if sensor.calibration:
        values["calibration"] = [vars(step) for step in sensor.calibration]
    return values


def _calibration(values: Any) -> tuple[CalibrationRecord, ...]:
    """Read the steps of a calibration; what another program means by the key is passed over."""
    items = values if isinstance(values, list) else []
    steps = [_calibration_step(item) for item in items[:_MOST_STEPS] if isinstance(item, dict)]
    return tuple(step for step in steps if step is not None)


def _calibration_step(values: dict[str, Any]) -> CalibrationRecord | None:
    match values:
        case {"step": str(step), "made_at": str(made_at), "residual": int(left) | float(left)}:
            unit = next((unit for unit in UNITS if unit == values.get("unit")), None)
            is_known = _STEP.fullmatch(step) and _is_moment(made_at) and 0 <= left < _MOST_PX
            if unit is not None and is_known:
                return CalibrationRecord(step, made_at, float(left), unit)
    return None


def _is_moment(text: str) -> bool:
    try:
        datetime.fromisoformat(text)
    except ValueError:
        return False
    return True


def _camera(item: JsonObject, sizes: tuple[tuple[int, int], ...]) -> PinholeCamera:
    width, height = item.integer("width", 1, 10_000), item.integer("height", 1, 10_000)
    if (width, height) not in sizes:
        allowed = joined((f"{w}×{h}" for w, h in sizes), " or ")
        raise item.fail(
            "width",
            "and height are {width}×{height}, but must be {allowed}",
            width=width,
            height=height,
            allowed=allowed,
        )
    k1, k2, p1, p2, k3 = item.numbers("distortion", 5, -_MOST_DISTORTION, _MOST_DISTORTION)
    camera = PinholeCamera(
        width=width,
        height=height,
        fx=item.number("fx", 1, _MOST_PX),
        fy=item.number("fy", 1, _MOST_PX),
        cx=item.number("cx", -_MOST_PX, _MOST_PX),
        cy=item.number("cy", -_MOST_PX, _MOST_PX),
        distortion=(k1, k2, p1, p2, k3),
        skew=item.number("skew", -_MOST_PX, _MOST_PX) if item.has("skew") else 0.0,
    )
    if not camera.can_be_undistorted:
        raise item.fail("distortion", "bends the edges of the picture more than a lens does")
    return camera


def _camera_json(camera: PinholeCamera) -> dict[str, Any]:
    values: dict[str, Any] = {
        "width": camera.width, "height": camera.height, "fx": camera.fx, "fy": camera.fy,
        "cx": camera.cx, "cy": camera.cy, "distortion": list(camera.distortion),
    }  # fmt: skip
    return {**values, "skew": camera.skew} if camera.skew else values


def _depth2color(item: JsonObject) -> FloatArray:
    rotation = np.array(item.matrix("rotation", 3))
    if not is_rotation(rotation):
        kind = "mirrored" if is_rotation(-rotation) else "no rotation"
        raise item.fail(
            "rotation", "is {what}; its rows must be right-handed unit vectors", what=kind
        )
    return rigid(rotation, np.array(item.triple("translation_mm", _MOST_MM)))


def _disparity(item: JsonObject) -> DisparityModel:
    model = item.choice("model", ["kinect-v1-factory", "linear-inverse", "tangent"])
    if model == "kinect-v1-factory":
        return FactoryDisparity(
            item.number("reference_distance_mm", _TINY, _MOST_MM),
            item.number("reference_pixel_size_mm", _TINY, _MOST_MM),
            item.number("baseline_mm", _TINY, _MOST_MM),
            item.number("constant_shift", -_MOST_PX, _MOST_PX),
        )
    if model == "linear-inverse":
        return LinearInverseDisparity(
            item.number("a", -_MOST_PX, _MOST_PX), item.number("b", -_MOST_PX, -_TINY)
        )
    return TangentDisparity(
        item.number("k1_mm", _TINY, _MOST_MM),
        item.number("k2", _TINY, _MOST_PX),
        item.number("k3", -_MOST_PX, _MOST_PX),
    )


def _disparity_json(model: DisparityModel) -> dict[str, Any]:
    names: dict[type, str] = {
        FactoryDisparity: "kinect-v1-factory",
        LinearInverseDisparity: "linear-inverse",
        TangentDisparity: "tangent",
    }
    return {"model": names[type(model)], **vars(model)}


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
