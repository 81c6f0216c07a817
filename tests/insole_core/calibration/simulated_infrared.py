"""Infrared pictures of flat walls before a device whose dots and distortion are known."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
from simulated_device import SimulatedDevice

from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.recording.images import encode_png
from insole_core.recording.sensor_folder import write_sensor
from insole_core.sensing.sensor import Sensor
from insole_core.simulate.dot_pattern import DotPattern

_BRIGHTNESS, _BLACK = 60.0, 8.0
_SPECKLE = 0.2


def dots(seed: int) -> Float32Array:
    """The pattern of a device as its camera sees it, eight columns a pixel."""
    return DotPattern.draw(np.random.default_rng(seed), px_per_dot=9.0).seen()


def infrared_picture(pattern: Float32Array, raw: FloatArray, seed: int) -> FloatArray:
    """A picture (480, 640), 10 bits, of a surface with these raw numbers, with speckle."""
    v, u = np.mgrid[:480, :640].astype(np.float32)
    seen = cv2.remap(pattern, u * 8 + raw.astype(np.float32), v, cv2.INTER_LINEAR)
    speckle = np.random.default_rng(seed).gamma(_SPECKLE**-2, _SPECKLE**2, seen.shape)
    return np.asarray(_BLACK + _BRIGHTNESS * seen * speckle)


def write_infrared_walls(
    folder: Path,
    device: SimulatedDevice,
    pattern: Float32Array,
    planes: Sequence[FloatArray],
) -> Path:
    """Write ``infrared_00.png`` (64 times the mean) and ``depth_00.png`` of every wall."""
    folder.mkdir(parents=True)
    for number, plane in enumerate(planes):
        picture = infrared_picture(pattern, device.distorted(plane), number)
        write_infrared(folder / f"infrared_{number:02d}.png", picture * 64)
        (frame,) = device.frames(plane, 1)
        (folder / f"depth_{number:02d}.png").write_bytes(encode_png(frame))
    return folder


def write_infrared(path: Path, picture: FloatArray) -> None:
    path.write_bytes(encode_png(np.clip(picture, 0, 65535).astype(np.uint16)))


def write_sensor_beside(folder: Path, sensor: Sensor) -> Path:
    folder.mkdir(parents=True)
    write_sensor(sensor, folder)
    return folder / "sensor.json"
