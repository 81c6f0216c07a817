"""A complete simulated capture: a foot in the reference system, recorded by three sensors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Protocol

import numpy as np

from insole_core.errors import UsageError
from insole_core.geometry.arrays import ByteArray, FloatArray, RawArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.recording.box import Box
from insole_core.recording.sensor_json import COLOR_SIZES
from insole_core.recording.session import CaptureCondition, Manifest, ReferenceSystem, Session, View
from insole_core.simulate.block_matching import record_matched_depth
from insole_core.simulate.color_image import ColorRecording, record_color
from insole_core.simulate.depth_image import record_depth
from insole_core.simulate.device import Device, make_device
from insole_core.simulate.foot_model import DEFAULT_CELL_MM, FootModel, build_foot
from insole_core.simulate.foot_shape import FootShape, vary_shape
from insole_core.simulate.poses import stand_sensor
from insole_core.simulate.ray_caster import SceneCaster
from insole_core.simulate.scene import build_scene, load_reference_system
from insole_core.simulate.simulation_limits import Limits, check_limits

_SENSOR_FACES = {"left": "sole", "right": "sole", "top": "achilles"}
_VOLUME = Box((-72.0, -150.0, -25.0), (72.0, 150.0, 165.0))
_RECORDED_AT = "2026-01-01T00:00:00Z"
_LIMITS: Limits = {
    "seed": ("seed of the simulation", 0, 2**32 - 1),
    "distance_mm": ("distance of the sensors (mm)", 500, 1500),
    "half_angle_deg": ("angle of the sole sensors (degrees)", 5, 45),
    "bursts": ("number of places each sensor stands in", 1, 9),
    "frames": ("number of depth frames", 1, 999),
    "color_frames": ("number of colour frames", 1, 999),
    "foot_cell_mm": ("resolution of the foot's surface (mm)", 1, 8),
}


@dataclass(frozen=True)
class SimulationOptions:
    """The options of a simulation.

    Parameters
    ----------
    seed
        The same seed gives the same session, value for value.
    side
    distance_mm
        From the sensors to the foot.
    bursts
        Number of slightly different positions of each sensor; views left, left_2, ...
    frames, color_frames
        Number of depth and colour frames of every view.
    shape
        Of the foot; by default it is drawn from the seed.
    half_angle_deg
        Angle of the two sole sensors' axes to the direction of the leg.
    color_size
        Width and height of the colour images, px: 1280 x 1024, 1280 x 960 or 640 x 480.
    foot_cell_mm
        Resolution of the foot's surface.
    ideal
        Whether the sensors have no matching window: depth errors are as large as a real sensor's,
        but fine structure is kept and rims are not widened. The method ``fused`` corrects the
        window of a real sensor, and so degrades the views of an ideal one (decision 0023).

    Raises
    ------
    UsageError
        When a number is out of its range, or the shape is of the other side.
    """

    seed: int = 1
    side: Side = Side.LEFT
    distance_mm: float = 800.0
    bursts: int = 1
    frames: int = 10
    color_frames: int = 1
    shape: FootShape | None = None
    half_angle_deg: float = 27.0
    color_size: tuple[int, int] = (1280, 1024)
    foot_cell_mm: float = DEFAULT_CELL_MM
    ideal: bool = False

    def __post_init__(self) -> None:
        check_limits(self, _LIMITS)
        if self.color_size not in COLOR_SIZES:
            raise UsageError(
                "A colour image of {width} x {height} px cannot be simulated; choose 1280 x 1024, "
                "1280 x 960 or 640 x 480.",
                width=self.color_size[0],
                height=self.color_size[1],
            )
        if self.shape is not None and self.shape.side is not self.side:
            raise UsageError(
                "The foot's shape is a {shape_side} one, but a {side} foot is to be simulated; "
                "give both the same side.",
                shape_side=self.shape.side,
                side=self.side,
            )


@dataclass(frozen=True, eq=False)
class SimulatedSession:
    """A simulated session and its ground truth.

    Parameters
    ----------
    session
        Its frames are drawn when they are read, and always the same.
    foot
        The true surface with its shape and landmarks, mm, reference frame.
    sensor2reference : view name -> (4, 4) float64, mm
        True poses of the depth cameras.
    """

    session: Session
    foot: FootModel
    sensor2reference: dict[str, FloatArray]

    @property
    def truth(self) -> TriangleMesh:
        """The true surface with its colours, mm, reference frame."""
        return self.foot.mesh


def simulate_session(options: SimulationOptions, progress: Progress = SILENT) -> SimulatedSession:
    """Simulate one capture.

    Parameters
    ----------
    options
    progress
        Reports every view.

    Returns
    -------
    SimulatedSession
        The session with the true foot and the true poses.
    """
    progress.step(0.0, "Shaping the foot")
    rng = np.random.default_rng([options.seed, 0])
    foot = build_foot(options.shape or vary_shape(rng, options.side), rng, options.foot_cell_mm)
    reference_system = load_reference_system()
    caster = SceneCaster(build_scene(foot.mesh, reference_system, rng))

    record = _recorder_of_depth(options, foot, reference_system)
    plan = _plan(options.bursts)
    devices = {
        sensor: _device(options, number, sensor) for number, sensor in enumerate(_SENSOR_FACES)
    }
    views, poses = [], {}
    for number, (name, sensor) in enumerate(plan):
        progress.step(0.1 + 0.9 * number / len(plan), "Simulating view {name}", name=name)
        rng = np.random.default_rng([options.seed, 2, number])
        poses[name] = stand_sensor(sensor, options.distance_mm, options.half_angle_deg, rng)
        recorder = Recorder(
            record(caster, devices[sensor], poses[name], rng),
            record_color(caster, devices[sensor].sensor, poses[name]),
            [options.seed, 3, number],
        )
        views.append(_view(name, devices[sensor], recorder, options))
    manifest = _manifest(options, reference_system, tuple(poses))
    session = Session(
        manifest, tuple(views), Message("the simulation with seed {seed}", seed=options.seed)
    )
    return SimulatedSession(session, foot, poses)


def _plan(bursts: int) -> list[tuple[str, str]]:
    """Return (view, sensor) of all views: left, left_2, ... right, ..."""
    return [
        (sensor if burst == 1 else f"{sensor}_{burst}", sensor)
        for sensor in _SENSOR_FACES
        for burst in range(1, bursts + 1)
    ]


def _device(options: SimulationOptions, number: int, sensor: str) -> Device:
    rng = np.random.default_rng([options.seed, 1, number])
    return make_device(
        f"SIM{options.seed:05d}{number}",
        (_SENSOR_FACES[sensor],),
        options.distance_mm,
        options.color_size,
        rng,
    )


def _view(name: str, device: Device, recorder: Recorder, options: SimulationOptions) -> View:
    return View(
        name,
        device.sensor,
        options.frames,
        options.color_frames,
        recorder.read_depth,
        recorder.read_color,
    )


def _manifest(
    options: SimulationOptions, reference_system: ReferenceSystem, views: tuple[str, ...]
) -> Manifest:
    return Manifest(
        recorded_at=_RECORDED_AT,
        side=options.side,
        reference_system=reference_system,
        views=views,
        volume_of_interest=_VOLUME,
        capture_condition=CaptureCondition(notes=f"Simulated, seed {options.seed}"),
    )


class _DepthView(Protocol):
    """A recording of a still scene by a depth camera."""

    def frame(self, rng: np.random.Generator) -> RawArray:
        """Draw one frame: (480, 640) uint16."""
        ...


def _recorder_of_depth(
    options: SimulationOptions, foot: FootModel, reference_system: ReferenceSystem
) -> Callable[[SceneCaster, Device, FloatArray, np.random.Generator], _DepthView]:
    if options.ideal:
        return record_depth
    markers = [marker.position_mm for marker in reference_system.markers]
    return partial(record_matched_depth, things=np.vstack([foot.mesh.vertices, *markers]))


@dataclass(frozen=True, eq=False)
class Recorder:
    """The recording of one sensor.

    Every frame has its own random stream, so frames can be read in any order.
    """

    depth: _DepthView
    color: ColorRecording
    seed: list[int]

    def read_depth(self, frame: int) -> RawArray:
        """Draw a depth frame, (480, 640) uint16, raw units."""
        return self.depth.frame(np.random.default_rng([*self.seed, 1, frame]))

    def read_color(self, frame: int) -> ByteArray:
        """Draw a colour frame, (height, width, 3) uint8, RGB."""
        return self.color.frame(np.random.default_rng([*self.seed, 2, frame]))
