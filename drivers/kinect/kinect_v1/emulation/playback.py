"""Pictures as frames of an emulated sensor."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import cv2
import numpy as np

from kinect_v1.calibration import Calibration, Padding, RegistrationInfo, ZeroPlane
from kinect_v1.emulation.device import EmulatedKinect
from kinect_v1.errors import RecordingError
from kinect_v1.models import Model
from kinect_v1.modes import BAYER_640, BAYER_1280, DEPTH_10, DEPTH_11, IR_640, IR_1280, StreamMode
from kinect_v1.pixels import ByteArray, RawArray, demosaic, encode_image, mosaic
from kinect_v1.recordings import Recording, read_color, read_depth, read_received, read_recording

TYPICAL_CALIBRATION = Calibration(
    ZeroPlane(
        emitter_distance_cm=7.5,
        rgb_distance_cm=2.3,
        reference_distance_cm=120.0,
        reference_pixel_cm=0.1042,
    ),
    RegistrationInfo(**dict.fromkeys(RegistrationInfo.__dataclass_fields__, 0)),
    Padding(0, 0, 0),
    200,
)
"""What devices usually report, except the registration, which varies between devices."""


def make_footage(
    depth: Iterable[RawArray] = (),
    mosaics: Iterable[ByteArray] = (),
    infrared: Iterable[RawArray] = (),
) -> dict[str, list[bytes]]:
    """Return the packed frames that an emulated camera plays.

    Parameters
    ----------
    depth
        (480, 640) raw 11-bit numbers; in 10-bit mode the last bit is lost, as in the device.
    mosaics
        (480, 640) or (1024, 1280) Bayer mosaics; the other size is derived from them.
    infrared
        (488, 640) or (1024, 1280), 10 bits.
    """
    footage: dict[str, list[bytes]] = {}

    def add(mode: StreamMode, image: ByteArray | RawArray) -> None:
        footage.setdefault(mode.name, []).append(encode_image(image, mode))

    for raw in depth:
        add(DEPTH_11, raw)
        add(DEPTH_10, np.right_shift(raw, 1, dtype=np.uint16))
    for picture in mosaics:
        own, other = (BAYER_640, BAYER_1280)[:: 1 if picture.shape == (480, 640) else -1]
        add(own, picture)
        add(other, _resized(picture, other))
    for image in infrared:
        add(IR_640 if image.shape == (488, 640) else IR_1280, image)
    return footage


def _resized(picture: ByteArray, mode: StreamMode) -> ByteArray:
    """Return a mosaic in the size of a mode."""
    size = (mode.width, mode.height)
    scaled = cv2.resize(demosaic(picture), size, interpolation=cv2.INTER_AREA)
    return mosaic(np.asarray(scaled, np.uint8))


def recorded_kinect(folder: Path) -> EmulatedKinect:
    """Return a sensor that plays a fakenect recording.

    Raises
    ------
    RecordingError
        When the folder is not a recording, or contains no depth.
    """
    recording = read_recording(folder)
    depth = [read_depth(file) for file in recording.of_kind("d")]
    if not depth:
        raise RecordingError(f"{folder} holds no depth pictures; choose another recording.")
    infrared = [read_received(file) for file in recording.of_kind("i")]
    footage = make_footage(depth, _mosaics(recording), infrared)
    models = {model.value: model for model in Model}
    model = models.get(recording.model or "", Model.XBOX_1414)
    calibration = recording.calibration or TYPICAL_CALIBRATION
    return EmulatedKinect(model, recording.serial or "A00000000000000A", calibration, footage)


def _mosaics(recording: Recording) -> list[ByteArray]:
    """Return the mosaics as received; where only interpolated colour was kept, derived from it."""
    received = [read_received(file) for file in recording.of_kind("b")]
    return received or [mosaic(read_color(file)) for file in recording.of_kind("r")]
