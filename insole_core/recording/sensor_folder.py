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
from insole_core.recording.images import MAX_PIXELS, MAX_SIDE
from insole_core.recording.session import DotPictures, FrameTimes
from insole_core.sensing.correction import (
    OF_A_KINECT,
    CorrectedImage,
    DisparityCorrection,
    load_correction,
)
from insole_core.sensing.disparity import (
    NO_READING,
    DisparityModel,
    FactoryDisparity,
    LinearInverseDisparity,
    TangentDisparity,
)
from insole_core.sensing.infrared_reference import MOST_SHIFT_PX
from insole_core.sensing.metric_depth import PlainDepth, StereoDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import UNITS, CalibrationRecord, Sensor
from insole_core.strict_json import MOST_BYTES

DEPTH_SIZE = (640, 480)
COLOR_SIZES = ((1280, 1024), (1280, 960), (640, 480))
_STEP = re.compile(r"[a-z_]{1,32}")
_MOST_STEPS = 20
_TINY = 1e-9
_LEAST_UNIT_MM, _MOST_UNIT_MM = 0.01, 10.0
"""Of known sensors 0.1 to 1; a number of metres, as their libraries state it, lies below."""
_MOST_BASELINE_MM = 1000.0
_LEAST_SIDE = 16
_MOST_MM, _MOST_PX, _MOST_DISTORTION = 1e4, 1e5, 1e3
"""Far beyond any camera; larger numbers are mistakes, and overflow."""
SENSOR_FILE = "sensor.json"
CORRECTION_FILE = "correction.npz"
REFERENCE_FILE = "reference.npz"
INFRARED_SHIFT, INFRARED_MOVED = "infrared_shift_px", "infrared_moved_raw"


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
    metric = is_metric(root)
    sizes = None if metric else (DEPTH_SIZE,)
    depth_camera = _camera(root.object("depth_camera"), sizes)
    baseline_mm = _baseline_mm(root) if metric else None
    return Sensor(
        model=root.text("model"),
        serial=root.text("serial"),
        depth_camera=depth_camera,
        color_camera=_camera(root.object("color_camera"), None if metric else COLOR_SIZES),
        depth2color=_depth2color(root.object("depth2color")),
        disparity=_metric_disparity(depth_camera, baseline_mm)
        if metric
        else _disparity(root.object("disparity")),
        correction=correction,
        faces=tuple(faces),
        calibration=_calibration(root.values.get("calibration")),
        depth_unit_mm=root.number("depth_unit_mm", _LEAST_UNIT_MM, _MOST_UNIT_MM)
        if metric
        else None,
        baseline_mm=baseline_mm,
    )


def is_metric(root: JsonObject) -> bool:
    """Return whether a sensor delivers millimetres rather than raw numbers.

    Raises
    ------
    InputError
        When it says both, or neither.
    """
    if root.has("depth_unit_mm") and root.has("disparity"):
        raise root.fail(
            "depth_unit_mm",
            'is of a sensor that delivers millimetres, and "disparity" of one that delivers raw '
            "numbers; take out the one that is wrong",
        )
    if root.has("depth_unit_mm"):
        return True
    root.object("disparity")
    return False


def corrected_image(root: JsonObject) -> CorrectedImage:
    """Return the depth image that the correction of a sensor must be for.

    Raises
    ------
    InputError
        Names the file and the key of the first violation.
    """
    if not is_metric(root):
        return OF_A_KINECT
    if _baseline_mm(root) is None:
        raise root.fail(
            "disparity_correction",
            'corrects disparities, but there is no "stereo" with the baseline that makes them; '
            "add it, or take out the correction",
        )
    camera = _camera(root.object("depth_camera"), None)
    return CorrectedImage(camera.width, camera.height, "px")


def _baseline_mm(root: JsonObject) -> float | None:
    if not root.has("stereo"):
        return None
    return root.object("stereo").number("baseline_mm", 1.0, _MOST_BASELINE_MM)


def _metric_disparity(camera: PinholeCamera, baseline_mm: float | None) -> DisparityModel:
    return PlainDepth() if baseline_mm is None else StereoDisparity(camera.fx, baseline_mm)


def correction_name(root: JsonObject) -> str | None:
    """Return the name of the correction file beside sensor.json; None without one.

    Raises
    ------
    InputError
        When the name leads out of the folder.
    """
    if root.values.get("disparity_correction") is None:
        return None
    return file_beside(root, "disparity_correction")


def file_beside(root: JsonObject, key: str) -> str:
    """Return the name that a key gives of a file beside sensor.json.

    Raises
    ------
    InputError
        When there is none, or it leads out of the folder.
    """
    name = root.text(key)
    if "/" in name or "\\" in name or ".." in name:
        raise root.fail(key, "must name a file beside sensor.json")
    return name


def infrared_shift_px(root: JsonObject) -> tuple[float, float] | None:
    """Return by how much infrared pictures are shifted against the depth image (see `DotPictures`).

    Returns
    -------
    (u, v) or None
        None where it is not said.

    Raises
    ------
    InputError
        When the key holds anything else.
    """
    if not root.has(INFRARED_SHIFT):
        return None
    return root.pair(INFRARED_SHIFT, MOST_SHIFT_PX)


def infrared_moved_raw(root: JsonObject) -> float | None:
    """Return by how much depth had changed when infrared pictures were taken (see `DotPictures`).

    Raises
    ------
    InputError
        When the key holds anything else.
    """
    if not root.has(INFRARED_MOVED):
        return None
    return root.number(INFRARED_MOVED, 0, NO_READING)


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
        **_depth_json(sensor),
        "faces": list(sensor.faces),
    }
    if correction is not None:
        values["disparity_correction"] = correction
    if sensor.calibration:
        values["calibration"] = [vars(step) for step in sensor.calibration]
    return values


def _depth_json(sensor: Sensor) -> dict[str, Any]:
    """Return what makes millimetres of the numbers in its frames."""
    if sensor.depth_unit_mm is None:
        return {"disparity": _disparity_json(sensor.disparity)}
    values: dict[str, Any] = {"depth_unit_mm": sensor.depth_unit_mm}
    if sensor.baseline_mm is not None:
        values["stereo"] = {"baseline_mm": sensor.baseline_mm}
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


def _camera(item: JsonObject, sizes: tuple[tuple[int, int], ...] | None) -> PinholeCamera:
    least, most = (_LEAST_SIDE, MAX_SIDE) if sizes is None else (1, 10_000)
    width, height = (item.integer(key, least, most) for key in ("width", "height"))
    if sizes is None and width * height > MAX_PIXELS:
        raise item.fail(
            "width",
            "and height are {width}×{height}, more than the pictures of a sensor have",
            width=width,
            height=height,
        )
    if sizes is not None and (width, height) not in sizes:
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


def folder_of_sensor(named: Path) -> Path:
    """Return the folder of a sensor that somebody named: as it is, or by its sensor.json.

    Raises
    ------
    InputError
        When it holds no sensor, or is another file.
    """
    folder = named.parent if named.name == SENSOR_FILE else named
    if not (folder / SENSOR_FILE).exists():
        raise InputError(
            "{path} is no sensor: name a sensor.json, or the folder that holds one.", path=named
        )
    return folder


def read_sensor(folder: Path) -> Sensor:
    """Read the sensor of a folder, for example of one view of a session.

    Parameters
    ----------
    folder
        Or its sensor.json.

    Raises
    ------
    InputError
        When a file is missing, or violates the format.
    """
    folder = folder_of_sensor(folder)
    path = folder / SENSOR_FILE
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


def write_sensor(
    sensor: Sensor,
    folder: Path,
    times: FrameTimes | None = None,
    dots: DotPictures | None = None,
) -> None:
    """Write a sensor into an existing folder.

    Parameters
    ----------
    sensor
    folder
    times : optional
        Of the frames beside it.
    dots : optional
        The infrared pictures beside it, which are written but for the pictures.

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
    values = sensor_json(sensor, name)
    if times is not None:
        values["frame_times_ms"] = {"depth": times.depth_ms, "color": times.color_ms}
    if dots is not None and any(dots.shift_px):
        values[INFRARED_SHIFT] = dots.shift_px
    if dots is not None and dots.moved_raw is not None:
        values[INFRARED_MOVED] = round(dots.moved_raw, 3)
    if dots is not None and dots.reference is not None:
        values["infrared_reference"] = REFERENCE_FILE
        dots.reference.save(folder / REFERENCE_FILE)
    text = json.dumps(values, indent=1, ensure_ascii=False)
    write_private(folder / SENSOR_FILE, f"{text}\n".encode())


def _sensor_of(root: JsonObject, folder: Path) -> Sensor:
    named = correction_name(root)
    if named is None:
        return parse_sensor(root, None)
    return parse_sensor(root, load_correction(folder / named, corrected_image(root)))
