"""Flat walls before the sensors of a simulated session, from which their dots can be learnt."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from insole_core.calibration.infrared.infrared_walls import (
    MEAN_SCALE,
    InfraredWall,
    relative_brightness,
)
from insole_core.calibration.infrared.learnt_reference import learn_reference
from insole_core.calibration.walls.captures import capture_from_frames
from insole_core.errors import UsageError
from insole_core.files.atomic import replacing_folder
from insole_core.geometry.arrays import BoolArray, FloatArray, RawArray
from insole_core.geometry.transforms import rotation_about
from insole_core.progress import SILENT, Progress
from insole_core.recording.images import encode_png
from insole_core.recording.sensor_folder import write_sensor
from insole_core.recording.session import Session
from insole_core.sensing.infrared_reference import InfraredReference
from insole_core.simulate.active_stereo import StereoDevice
from insole_core.simulate.block_matching import record_matched_depth
from insole_core.simulate.device import Device
from insole_core.simulate.scene import Hits
from insole_core.simulate.simulation import SimulationOptions, devices_of, dots_of

MOST_WALLS = 30
_NEAREST_MM, _FARTHEST_MM = 560.0, 960.0
_TILT_DEG = 5.0
_PICTURES = 8


@dataclass(frozen=True, eq=False)
class SimulatedWall:
    """A flat wall before a sensor.

    Parameters
    ----------
    infrared : (480, 640) uint16
        64 times the mean of some pictures.
    depth : (480, 640) uint16
        A raw depth frame.
    """

    infrared: RawArray
    depth: RawArray

    def as_read(self, name: str) -> InfraredWall:
        """Return it as `read_infrared_walls` would."""
        picture = self.infrared / MEAN_SCALE
        return InfraredWall(capture_from_frames(name, [self.depth]), relative_brightness(picture))


def simulate_walls(device: Device, count: int, seed: int = 0) -> Iterator[SimulatedWall]:
    """Take a device's pictures of flat walls, the nearest first, a little tilted.

    Parameters
    ----------
    device
        One of `devices_of` a session with infrared pictures: its dots are the same there.
    count
        Number of walls, at even distances of 560 to 960 mm.
    seed
        Of the walls.
    """
    for number, distance_mm in enumerate(np.linspace(_NEAREST_MM, _FARTHEST_MM, count)):
        rng = np.random.default_rng([seed, 6, number])
        yield _take(device, float(distance_mm), rng)


def write_walls(
    options: SimulationOptions, count: int, folder: Path, progress: Progress = SILENT
) -> None:
    """Write walls before all sensors of a session, a folder for each, named by its serial number.

    Each holds ``infrared_00.png …``, ``depth_00.png …`` and the sensor's ``sensor.json``.

    Raises
    ------
    UsageError
        When the number of walls is out of range.
    OutputError
        When the folder cannot be written, or is not empty.
    Cancelled
    """
    check_wall_count(count)
    devices = [one for one in devices_of(options).values() if not isinstance(one, StereoDevice)]
    with replacing_folder(folder) as beside:
        for number, device in enumerate(devices):
            serial = device.sensor.serial
            told = progress.part(number / len(devices), (number + 1) / len(devices))
            place = beside / serial
            place.mkdir(parents=True)
            write_sensor(device.sensor, place)
            for index, wall in enumerate(simulate_walls(device, count, options.seed)):
                told.step(index / count, "Simulating walls before sensor {serial}", serial=serial)
                (place / f"infrared_{index:02d}.png").write_bytes(encode_png(wall.infrared))
                (place / f"depth_{index:02d}.png").write_bytes(encode_png(wall.depth))


def with_patterns(
    session: Session, options: SimulationOptions, count: int, progress: Progress = SILENT
) -> Session:
    """Learn the dots of all sensors from walls, and give them to views with infrared pictures.

    Parameters
    ----------
    session
        Of these options.
    options
    count
        Number of walls before each sensor.
    progress

    Raises
    ------
    UsageError
        When the number of walls is out of range.
    CalibrationError
        When they are too few.
    Cancelled
    """
    check_wall_count(count)
    found: dict[str, InfraredReference] = {}
    devices = devices_of(options)
    for number, device in enumerate(devices.values()):
        told = progress.part(number / len(devices), (number + 1) / len(devices))
        serial = device.sensor.serial
        told.step(0.0, "Simulating walls before sensor {serial}", serial=serial)
        if isinstance(device, StereoDevice):
            continue
        walls = [
            wall.as_read(f"infrared_{index:02d}.png")
            for index, wall in enumerate(simulate_walls(device, count, options.seed))
        ]
        found[serial] = learn_reference(walls, device.sensor, told.part(0.7, 1.0)).reference
    views = [
        replace(view, dots=replace(view.dots, reference=found[view.sensor.serial]))
        if view.dots is not None
        else view
        for view in session.views
    ]
    return replace(session, views=tuple(views))


def check_wall_count(count: int) -> None:
    """Check a number of walls.

    Raises
    ------
    UsageError
    """
    if not 1 <= count <= MOST_WALLS:
        raise UsageError(
            "The number of walls is {count}; give 1 to {most}.", count=count, most=MOST_WALLS
        )


def _take(device: Device, distance_mm: float, rng: np.random.Generator) -> SimulatedWall:
    tilt = rotation_about(np.array([1.0, 0.0, 0.0]), rng.uniform(-_TILT_DEG, _TILT_DEG))
    turn = rotation_about(np.array([0.0, 1.0, 0.0]), rng.uniform(-_TILT_DEG, _TILT_DEG))
    wall = _Wall(np.array([0.0, 0.0, distance_mm]), (tilt @ turn)[:, 2])
    camera = device.sensor.depth_camera
    corners = np.array([[0.0, 0.0], [camera.width - 1.0, camera.height - 1.0]])
    things = np.c_[camera.normalised(corners), np.ones(2)] * distance_mm
    seen = record_matched_depth(wall, device, np.eye(4), rng, things=things, dots=dots_of(device))
    total = sum(seen.picture(rng).astype(np.uint32) for _ in range(_PICTURES))
    mean = np.asarray(total, np.float64) * (MEAN_SCALE / _PICTURES)
    return SimulatedWall(np.rint(mean).astype(np.uint16), seen.frame(rng))


@dataclass(frozen=True, eq=False)
class _Wall:
    """An endless wall through a point, without anything before it; camera frame."""

    point: FloatArray
    normal: FloatArray

    def cast(self, origin: FloatArray, directions: FloatArray) -> Hits:
        """Find where rays hit the wall."""
        distance = ((self.point - origin) @ self.normal) / (directions @ self.normal)
        points = origin + distance[:, None] * directions
        towards = -np.sign((self.point - origin) @ self.normal) * self.normal
        count = len(directions)
        normals = np.broadcast_to(towards, (count, 3))
        return Hits(np.arange(count), distance, points, normals, np.full((count, 3), 200.0))

    def is_blocked(self, points: FloatArray, target: FloatArray) -> BoolArray:
        """Return that nothing is hidden."""
        return np.zeros(len(points), bool)
