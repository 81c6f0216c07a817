"""Pictures as frames of an emulated sensor."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import cv2
import numpy as np

from kinect_v1.calibration import Calibration, Padding, RegistrationInfo, ZeroPlane
from kinect_v1.emulation.device import EmulatedKinect
from kinect_v1.errors import RecordingError
from kinect_v1.models import Model
from kinect_v1.modes import (
    BAYER_640,
    BAYER_1280,
    DEPTH_10,
    DEPTH_11,
    IR_640,
    IR_1280,
    PixelFormat,
    StreamMode,
)
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


class _PackedFootage(Mapping[str, list[bytes]]):
    """Frames by name of the mode, packed when a mode is first played: most never are."""

    def __init__(self, images: Mapping[StreamMode, Sequence[ByteArray | RawArray]]) -> None:
        self._images = {mode.name: (mode, shown) for mode, shown in images.items() if shown}
        self._packed: dict[str, list[bytes]] = {}

    def __getitem__(self, name: str) -> list[bytes]:
        if name not in self._packed:
            mode, images = self._images[name]
            self._packed[name] = [encode_image(_in_mode(image, mode), mode) for image in images]
        return self._packed[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._images)

    def __len__(self) -> int:
        return len(self._images)


def make_footage(
    depth: Iterable[RawArray] = (),
    mosaics: Iterable[ByteArray] = (),
    infrared: Iterable[RawArray] = (),
) -> Mapping[str, list[bytes]]:
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
    raw, colored, dotted = list(depth), list(mosaics), list(infrared)
    return _PackedFootage(
        {
            DEPTH_11: raw,
            DEPTH_10: raw,
            BAYER_640: colored,
            BAYER_1280: colored,
            IR_640: [image for image in dotted if image.shape == (488, 640)],
            IR_1280: [image for image in dotted if image.shape != (488, 640)],
        }
    )


def _in_mode(image: ByteArray | RawArray, mode: StreamMode) -> ByteArray | RawArray:
    """Return a picture as a mode shows it."""
    if mode is DEPTH_10:
        return np.right_shift(image, 1, dtype=np.uint16)
    if mode.pixels is PixelFormat.BAYER and image.shape != (mode.height, mode.width):
        return _resized(np.asarray(image, np.uint8), mode)
    return image


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
