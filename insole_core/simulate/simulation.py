"""A complete simulated capture: a foot in the reference system, recorded by three sensors."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from typing import Literal, Protocol, get_args

import numpy as np

from insole_core.errors import UsageError
from insole_core.geometry.arrays import ByteArray, FloatArray, RawArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import BOTH, Side, Sides
from insole_core.geometry.transforms import rigid, rotation_about, transform
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.recording.box import Box
from insole_core.recording.sensor_folder import COLOR_SIZES
from insole_core.recording.session import (
    CaptureCondition,
    DotPictures,
    InfraredPictures,
    Manifest,
    ReferenceSystem,
    Session,
    View,
)
from insole_core.simulate.active_stereo import (
    LEAST_LIKENESS,
    Projector,
    StereoDevice,
    StereoRecording,
    make_stereo_device,
    record_stereo,
)
from insole_core.simulate.block_matching import (
    REAL_MATCHER,
    MatchedRecording,
    record_matched_depth,
)
from insole_core.simulate.color_image import ColorRecording, record_color
from insole_core.simulate.depth_image import record_depth
from insole_core.simulate.device import Device, make_device
from insole_core.simulate.foot_model import DEFAULT_CELL_MM, FootModel, build_foot
from insole_core.simulate.foot_shape import FootShape, Limits, check_limits, vary_shape
from insole_core.simulate.known_bodies import KnownBody
from insole_core.simulate.poses import AROUND_ONE_FOOT, Stand, stand_sensor, stands_around_both
from insole_core.simulate.scene import SceneCaster, build_scene, joined, load_reference_system
from insole_core.simulate.surroundings import Disturbance, disturbed

SensorKind = Literal["kinect", "d415", "mixed"]
SENSOR_KINDS: tuple[SensorKind, ...] = get_args(SensorKind)
_FULL_COLOR = (1280, 1024)
_VOLUME = Box((-72.0, -150.0, -25.0), (72.0, 150.0, 165.0))
_ONE_FOOT, _BOTH_FEET = "lego-20", "lego-40"
"""Reference systems."""
_PUT_BACK_MM, _PUT_BACK_DEG = (6.0, 8.0, 3.0), (2.0, 2.0, 4.0)
"""How far a foot that is taken off and put back lies elsewhere at most, along and about x, y, z."""
_RECORDED_AT = "2026-01-01T00:00:00Z"
_LIMITS: Limits = {
    "seed": ("seed of the simulation", 0, 2**32 - 1),
    "sensor_seed": ("seed of the sensors", 0, 2**32 - 1),
    "foot_seed": ("seed of the foot", 0, 2**32 - 1),
    "distance_mm": ("distance of the sensors (mm)", 400, 1500),
    "half_angle_deg": ("angle of the sole sensors (degrees)", 5, 45),
    "bursts": ("number of places each sensor stands in", 1, 9),
    "frames": ("number of depth frames", 1, 999),
    "color_frames": ("number of colour frames", 1, 999),
    "infrared_frames": ("number of infrared pictures", 0, 999),
    "sensors": ("number of sensors around both feet", 4, 6),
    "least_likeness": ("least likeness of windows", 0.1, 0.95),
    "foot_cell_mm": ("resolution of the foot's surface (mm)", 1, 8),
}


@dataclass(frozen=True)
class StandingFoot:
    """A foot in the place of one of two.

    Parameters
    ----------
    shape
        Its side may be the wrong one.
    place
        The side whose place it is in.
    aside_mm
        How far it is towards +x from the middle of its place.
    """

    shape: FootShape
    place: Side
    aside_mm: float = 0.0


@dataclass(frozen=True)
class SimulationOptions:
    """The options of a simulation.

    Parameters
    ----------
    seed
        The same seed gives the same session, value for value.
    side
        One foot, or both in one capture.
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
        window of a real sensor, and so degrades the views of an ideal one (decision 0015).
    sensors
        Number of sensors around both feet.
    standing
        What stands in the places of both feet, by default a foot of each side, drawn from the
        seed. Other feet make captures that must be refused.
    body
        What is in the place of one foot, instead of it.
    sensor_seed
        Of the sensors, so that several sessions are captured with the same ones; by default `seed`.
    foot_seed
        Of the one foot, which is put back some millimetres and degrees away, by chance of `seed`;
        by default the foot is that of `seed`, in its place.
    sensor
        ``kinect``, ``d415`` (stereo cameras as a RealSense D415, all projectors on at once), or
        ``mixed``: stereo cameras before the sole, Kinects behind the tendon.
    least_likeness
        Correlation of a stereo camera's windows below which it gives no reading.
    infrared_frames
        Number of infrared pictures of every view of a Kinect. With any, the dots are the sensor's
        own, those of its walls (`simulate_walls`); else they are drawn with the view.
    disturbances
        What spoils the infrared picture, and so the depth.

    Raises
    ------
    UsageError
        When a number is out of its range, the shape is of the other side, a body is given in place
        of both feet, or infrared pictures are asked of sensors without dots of their own.
    """

    seed: int = 1
    side: Sides = Side.LEFT
    distance_mm: float = 800.0
    bursts: int = 1
    frames: int = 10
    color_frames: int = 1
    shape: FootShape | None = None
    half_angle_deg: float = 27.0
    color_size: tuple[int, int] = _FULL_COLOR
    foot_cell_mm: float = DEFAULT_CELL_MM
    ideal: bool = False
    sensors: int = 4
    standing: tuple[StandingFoot, ...] | None = None
    body: KnownBody | None = None
    sensor_seed: int | None = None
    foot_seed: int | None = None
    sensor: SensorKind = "kinect"
    least_likeness: float = LEAST_LIKENESS
    infrared_frames: int = 0
    disturbances: tuple[Disturbance, ...] = ()

    def __post_init__(self) -> None:
        check_limits(self, _LIMITS)
        if self.color_size not in COLOR_SIZES:
            raise UsageError(
                "A colour image of {width} x {height} px cannot be simulated; choose 1280 x 1024, "
                "1280 x 960 or 640 x 480.",
                width=self.color_size[0],
                height=self.color_size[1],
            )
        if self.sensor != "kinect" and (self.ideal or self.color_size != _FULL_COLOR):
            raise UsageError(
                "A stereo camera always has a matching window, and colour images of 1920 x 1080; "
                "leave out what asks for others."
            )
        if (self.infrared_frames or self.disturbances) and (self.ideal or self.sensor != "kinect"):
            raise UsageError(
                "Infrared pictures of dots are those of Kinects with a matching window; leave out "
                "ideal and stereo sensors, or the infrared pictures and what disturbs them."
            )
        if self.shape is not None and self.shape.side is not self.side:
            raise UsageError(
                "The foot's shape is a {shape_side} one, but a {side} foot is to be simulated; "
                "give both the same side.",
                shape_side=self.shape.side,
                side=self.side,
            )
        if self.body is not None and self.side == BOTH:
            raise UsageError(
                "A body of known form takes the place of one foot; choose the side left or right."
            )
        if self.foot_seed is not None and (self.side == BOTH or self.body is not None):
            raise UsageError("One foot is put back; leave out the seed of the foot, or the others.")


@dataclass(frozen=True, eq=False)
class SimulatedSession:
    """A simulated session and its ground truth.

    Parameters
    ----------
    session
        Its frames are drawn when they are read, and always the same.
    feet
        By place, the true surface with its shape and landmarks, mm, in the foot's own reference
        frame; empty where a known body is in the place of the foot.
    truths
        The true surface of every foot, or of the body, with its colours, mm, in its own reference
        frame.
    sensor2reference : view name -> (4, 4) float64, mm
        True poses of the depth cameras.
    """

    session: Session
    feet: dict[Side, FootModel]
    truths: dict[Side, TriangleMesh]
    sensor2reference: dict[str, FloatArray]

    @property
    def foot(self) -> FootModel:
        """The only foot."""
        (foot,) = self.feet.values()
        return foot

    @property
    def truth(self) -> TriangleMesh:
        """The true surface of the only foot or body with its colours, mm, reference frame."""
        (truth,) = self.truths.values()
        return truth


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
    foot_seed = options.seed if options.foot_seed is None else options.foot_seed
    rng = np.random.default_rng([foot_seed, 0])
    both = options.side == BOTH
    reference_system = load_reference_system(_BOTH_FEET if both else _ONE_FOOT)
    told = reference_system
    feet = {foot.place: _foot(foot, options, rng) for foot in _standing(options, rng)}
    truths, holders = {side: foot.mesh for side, foot in feet.items()}, []
    if options.body is not None:
        truths, holders = {Side(options.side): options.body.mesh}, [options.body.holder]
        told = options.body.system or told
        reference_system = options.body.true_system or told
    placed = (_in_system(mesh, side, reference_system) for side, mesh in truths.items())
    surface = joined([*placed, *holders])
    caster = SceneCaster(build_scene(surface, reference_system, rng))

    markers = [marker.position_mm for marker in reference_system.markers]
    things = np.vstack([surface.vertices, *markers])
    record = _recorder_of_depth(options, things)
    stands = _stands(options.sensors, reference_system)
    plan = _plan(stands, options.bursts)
    devices = devices_of(options)
    rngs = [np.random.default_rng([options.seed, 2, number]) for number in range(len(plan))]
    poses = {
        name: stand_sensor(stands[sensor], options.distance_mm, options.half_angle_deg, rng)
        for (name, sensor), rng in zip(plan, rngs, strict=True)
    }
    views = []
    for number, (name, sensor) in enumerate(plan):
        progress.step(0.1 + 0.9 * number / len(plan), "Simulating view {name}", name=name)
        device, rng = devices[sensor], rngs[number]
        depth: _DepthView
        if isinstance(device, StereoDevice):
            projectors = _projectors(plan, devices, poses, name)
            depth = record_stereo(caster, projectors[0], projectors, rng, things=things)
        else:
            depth = record(caster, device, poses[name], rng, dots=_dots(options, device))
        color = record_color(caster, device.sensor, poses[name])
        recorder = Recorder(depth, color, [options.seed, 3, number])
        views.append(_view(name, device, recorder, options))
    manifest = _manifest(options, told, tuple(poses))
    session = Session(
        manifest, tuple(views), Message("the simulation with seed {seed}", seed=options.seed)
    )
    return SimulatedSession(session, feet, truths, poses)


def devices_of(options: SimulationOptions) -> dict[str, Device | StereoDevice]:
    """Return the sensors that take a session, by the names of their views."""
    both = options.side == BOTH
    system = load_reference_system(_BOTH_FEET if both else _ONE_FOOT)
    return {
        name: _device(options, number, stand.face)
        for number, (name, stand) in enumerate(_stands(options.sensors, system).items())
    }


def dots_of(device: Device) -> np.random.Generator:
    """Return the random numbers that place the dots of a device, the same at every call."""
    return np.random.default_rng([*device.sensor.serial.encode()])


def _dots(options: SimulationOptions, device: Device) -> np.random.Generator | None:
    return dots_of(device) if options.infrared_frames else None


def _standing(options: SimulationOptions, rng: np.random.Generator) -> tuple[StandingFoot, ...]:
    """Return the feet of a scene; those that are not given are drawn."""
    if options.body is not None:
        return ()
    if options.side != BOTH:
        shape = options.shape or vary_shape(rng, options.side)
        return (StandingFoot(shape, options.side),)
    if options.standing is not None:
        return options.standing
    return tuple(StandingFoot(vary_shape(rng, side), side) for side in Side)


def _foot(
    standing: StandingFoot, options: SimulationOptions, rng: np.random.Generator
) -> FootModel:
    foot = build_foot(standing.shape, rng, options.foot_cell_mm)
    if options.foot_seed is not None:
        return _moved(foot, _put_back(np.random.default_rng([options.seed, 4])))
    if standing.aside_mm == 0.0:
        return foot
    return _moved(foot, rigid(np.eye(3), np.array([standing.aside_mm, 0.0, 0.0])))


def _moved(foot: FootModel, step: FloatArray) -> FootModel:
    landmarks = {name: transform(step, point) for name, point in foot.landmarks_mm.items()}
    return FootModel(foot.shape, foot.mesh.transformed(step), landmarks)


def _put_back(rng: np.random.Generator) -> FloatArray:
    """Return a step (4, 4) by which somebody puts a foot back elsewhere, about its middle."""
    angles_deg = rng.uniform(-1.0, 1.0, 3) * _PUT_BACK_DEG
    turn = np.eye(3)
    for axis, angle_deg in zip(np.eye(3), angles_deg, strict=True):
        turn = rotation_about(axis, angle_deg) @ turn
    return rigid(turn, rng.uniform(-1.0, 1.0, 3) * _PUT_BACK_MM)


def _in_system(mesh: TriangleMesh, side: Side, system: ReferenceSystem) -> TriangleMesh:
    """Return the surface of a foot in the frame of the reference system."""
    if not system.feet:
        return mesh
    return mesh.transformed(rigid(np.eye(3), np.array(system.place(side).origin_mm)))


def _stands(sensors: int, system: ReferenceSystem) -> dict[str, Stand]:
    if not system.feet:
        return AROUND_ONE_FOOT
    left_mm, right_mm = (place.origin_mm[0] for place in system.feet)
    return stands_around_both(sensors, left_mm, right_mm)


def _plan(stands: Iterable[str], bursts: int) -> list[tuple[str, str]]:
    """Return (view, sensor) of all views: left, left_2, ... right, ..."""
    return [
        (sensor if burst == 1 else f"{sensor}_{burst}", sensor)
        for sensor in stands
        for burst in range(1, bursts + 1)
    ]


def _projectors(
    plan: list[tuple[str, str]],
    devices: dict[str, Device | StereoDevice],
    poses: dict[str, FloatArray],
    own: str,
) -> list[Projector]:
    """Return the projectors that shine while a view is taken, its own first.

    Of sensors that stand in several places those of the same number, as they are taken at once.
    """
    places = [view for view, sensor in plan if view.removeprefix(sensor) == _place_of(plan, own)]
    others = (view for view in places if view != own)
    found = ((devices[dict(plan)[view]], poses[view]) for view in (own, *others))
    return [Projector(device, pose) for device, pose in found if isinstance(device, StereoDevice)]


def _place_of(plan: list[tuple[str, str]], view: str) -> str:
    return view.removeprefix(dict(plan)[view])


def _device(options: SimulationOptions, number: int, face: str) -> Device | StereoDevice:
    seed = options.seed if options.sensor_seed is None else options.sensor_seed
    rng = np.random.default_rng([seed, 1, number])
    serial = f"SIM{seed:05d}{number}"
    if options.sensor == "d415" or (options.sensor == "mixed" and face == "sole"):
        return make_stereo_device(serial, (face,), rng, options.least_likeness)
    return make_device(
        serial,
        (face,),
        options.distance_mm,
        options.color_size,
        rng,
    )


def _view(
    name: str, device: Device | StereoDevice, recorder: Recorder, options: SimulationOptions
) -> View:
    return View(
        name,
        device.sensor,
        options.frames,
        options.color_frames,
        recorder.read_depth,
        recorder.read_color,
        recorder.infrared,
        dots=recorder.dots(options.infrared_frames),
    )


def _manifest(
    options: SimulationOptions, reference_system: ReferenceSystem, views: tuple[str, ...]
) -> Manifest:
    return Manifest(
        recorded_at=_RECORDED_AT,
        side=options.side,
        reference_system=reference_system,
        views=views,
        volume_of_interest=_VOLUME if reference_system.name == _ONE_FOOT else None,
        capture_condition=CaptureCondition(notes=f"Simulated, seed {options.seed}"),
    )


class _DepthView(Protocol):
    """A recording of a still scene by a depth camera."""

    def frame(self, rng: np.random.Generator) -> RawArray:
        """Draw one frame as it is stored: (height, width) uint16."""
        ...


class _Record(Protocol):
    """Record a scene by the depth camera of a device."""

    def __call__(
        self,
        caster: SceneCaster,
        device: Device,
        sensor2reference: FloatArray,
        rng: np.random.Generator,
        *,
        dots: np.random.Generator | None,
    ) -> _DepthView: ...


def _recorder_of_depth(options: SimulationOptions, things: FloatArray) -> _Record:
    if options.ideal:
        return _record_ideal
    matcher, around = disturbed(REAL_MATCHER, options.disturbances, float(things[:, 1].max()))
    return partial(record_matched_depth, things=things, matcher=matcher, surroundings=around)


def _record_ideal(
    caster: SceneCaster,
    device: Device,
    sensor2reference: FloatArray,
    rng: np.random.Generator,
    *,
    dots: np.random.Generator | None,
) -> _DepthView:
    assert dots is None, "an ideal sensor has no dots"
    return record_depth(caster, device, sensor2reference, rng)


@dataclass(frozen=True, eq=False)
class Recorder:
    """The recording of one sensor.

    Every frame has its own random stream, so frames can be read in any order.
    """

    depth: _DepthView
    color: ColorRecording
    seed: list[int]

    def read_depth(self, frame: int) -> RawArray:
        """Draw a depth frame as it is stored, (height, width) uint16."""
        return self.depth.frame(np.random.default_rng([*self.seed, 1, frame]))

    def read_color(self, frame: int) -> ByteArray:
        """Draw a colour frame, (height, width, 3) uint8, RGB."""
        return self.color.frame(np.random.default_rng([*self.seed, 2, frame]))

    @property
    def infrared(self) -> dict[str, InfraredPictures]:
        """The pair behind a stereo camera's depth, one picture each."""
        if not isinstance(self.depth, StereoRecording):
            return {}
        pair = self.depth.infrared(np.random.default_rng([*self.seed, 3]))
        return {
            name: InfraredPictures(1, partial(_only, image), bits=8) for name, image in pair.items()
        }

    def dots(self, count: int) -> DotPictures | None:
        """Some infrared pictures of a Kinect's dots."""
        if not count or not isinstance(self.depth, MatchedRecording):
            return None
        return DotPictures(InfraredPictures(count, self._read_infrared, bits=16))

    def _read_infrared(self, index: int) -> RawArray:
        assert isinstance(self.depth, MatchedRecording)
        return self.depth.picture(np.random.default_rng([*self.seed, 4, index]))


def _only(image: RawArray, _index: int) -> RawArray:
    return image
