"""Recordings of libfreenect as views of a session."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from insole_core.errors import InputError
from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.recording.sensor_folder import COLOR_SIZES, DEPTH_SIZE
from insole_core.recording.session import ReferenceSystem, View
from insole_core.sensing.disparity import NO_READING
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.capture_plan import view_faces
from insole_studio.acquisition.driver_values import factory_sensor, translating, usual_sensor
from kinect_v1.pixels import demosaic
from kinect_v1.recordings import (
    RecordedFile,
    Recording,
    read_color,
    read_depth,
    read_received,
    read_recording,
)

_UNKNOWN = "unknown"


@dataclass(frozen=True)
class _Pictures:
    """The image files of a view; colour as it was received, where that was kept."""

    depth: tuple[RecordedFile, ...]
    color: tuple[RecordedFile, ...]

    def read_depth(self, index: int) -> RawArray:
        """Read depth frame number `index`."""
        path = self.depth[index].path
        with translating():
            image = read_depth(self.depth[index])
        if image.shape[::-1] != DEPTH_SIZE or image.max() > NO_READING:
            raise InputError(
                "{path} holds no raw 11-bit depth of 640×480; record it with depth format 11 bit.",
                path=path,
            )
        return image

    def read_color(self, index: int) -> ByteArray:
        """Read colour frame number `index`."""
        file = self.color[index]
        with translating():
            if file.kind == "r":
                return read_color(file)
            return demosaic(np.asarray(read_received(file), np.uint8))


def read_view(name: str, folder: Path, system: ReferenceSystem) -> View:
    """Read a recording; its frames are read on demand.

    Parameters
    ----------
    name
        Name of the view.
    system
        Determines which markers the view sees.

    Returns
    -------
    View
        Its frames are read on demand.

    Raises
    ------
    InputError, SensorError
        When the folder is not a recording, or lacks depth or colour.
    """
    with translating():
        recording = read_recording(folder)
    pictures = _Pictures(recording.of_kind("d"), recording.of_kind("b") or recording.of_kind("r"))
    if not pictures.depth or not pictures.color:
        missing = "colour" if pictures.depth else "depth"
        raise InputError(
            "{folder} holds no {missing} pictures, but a view needs at least one; record again "
            "with {missing}.",
            folder=folder,
            missing=missing,
        )
    height, width = pictures.read_color(0).shape[:2]
    if (width, height) not in COLOR_SIZES:
        raise InputError(
            "{folder} holds colour of {width}×{height}, which no Kinect v1 sends.",
            folder=folder,
            width=width,
            height=height,
        )
    return View(
        name=name,
        sensor=_sensor(recording, view_faces(name, system), (width, height)),
        depth_count=len(pictures.depth),
        color_count=len(pictures.color),
        read_depth=pictures.read_depth,
        read_color=pictures.read_color,
    )


def _sensor(recording: Recording, faces: tuple[str, ...], color_size: tuple[int, int]) -> Sensor:
    serial = recording.serial or _UNKNOWN
    if recording.calibration is None:
        return usual_sensor(serial, faces, color_size)
    return factory_sensor(recording.calibration, serial, faces, color_size)


def recorded_at(folder: Path) -> str:
    """Return date and time of a recording's first picture.

    Raises
    ------
    SensorError
    """
    with translating():
        files = read_recording(folder).files
    return datetime.fromtimestamp(files[0].host_time_s, UTC).isoformat(timespec="seconds")
