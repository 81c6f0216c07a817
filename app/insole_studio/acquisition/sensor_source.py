"""Where captures come from: the sensors of this computer, or a recorded session that plays them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import cv2
import numpy as np

from insole_core.errors import InputError
from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.recording.reader import read_session
from insole_core.recording.session import Session, View
from insole_core.sensing.disparity import DisparityModel, FactoryDisparity, LinearInverseDisparity
from insole_core.sensing.family import DIRECT_DEPTH
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.capture_plan import (
    MOST_BURSTS,
    CaptureStep,
    burst_tilt_deg,
    burst_view,
)
from insole_studio.acquisition.capture_setup import (
    CaptureSetup,
    SensorFiles,
    own_setup,
    recorded_setup,
)
from insole_studio.acquisition.driver_values import translating
from insole_studio.acquisition.kinect_sensors import KinectPort
from insole_studio.acquisition.rig import Rig
from insole_studio.acquisition.sensor_port import SensorPort
from insole_studio.acquisition.tunings import Tunings
from insole_studio.acquisition.warm_up import WarmUps
from kinect_v1.calibration import Calibration, ZeroPlane
from kinect_v1.emulation.bus import EmulatedBus
from kinect_v1.emulation.device import EmulatedKinect, Footage
from kinect_v1.emulation.playback import TYPICAL_CALIBRATION, make_footage
from kinect_v1.models import Model
from kinect_v1.pixels import mosaic
from kinect_v1.usb_bus import UsbBus, system_bus
from realsense_d400.cameras import CameraBus, SystemCameras
from realsense_d400.settings import CameraSettings

if TYPE_CHECKING:
    from realsense_d400.emulation import EmulatedCameras

RECORDING = ".db3"
_INFRARED_SIZE = (640, 488)
_CUT_ROWS = 32
"""Rows that a picture of 1280 × 960 lacks at top and bottom compared with 1280 × 1024."""


class EmulatedRig:
    """One emulated sensor for each serial number of a session, each on its own USB controller.

    Kinects are emulated below their driver, cameras with metric depth as RealSense cameras below
    their library.

    A sensor that recorded several views was either tilted by its motor, if the views are named like
    bursts (``left``, ``left_2``), or moved by hand. The emulated sensor therefore plays the view of
    its present tilt at its present position, which initially is that of its first view.

    Parameters
    ----------
    speed
        Factor on the sensors' clock; 1 = real time.
    """

    def __init__(self, session: Session, speed: float = 1.0) -> None:
        places = _bursts_by_place(session)
        self._scenes = {
            place: {burst_tilt_deg(burst): _footage(view) for burst, view in enumerate(bursts)}
            for place, bursts in places.items()
            if not _is_metric(bursts[0])
        }
        self._metric = {place: views[0] for place, views in places.items() if _is_metric(views[0])}
        self._serials = dict(emulated_views(session))
        self._kinects: dict[str, EmulatedKinect] = {}
        sensors = {view.name: view.sensor for view in session.views}
        for place, scenes in self._scenes.items():
            serial = self._serials[place]
            if serial not in self._kinects:
                self._kinects[serial] = _kinect(sensors[place], scenes)
        self.bus = EmulatedBus(list(self._kinects.values()), speed=speed)
        self.cameras = self._emulated_cameras(speed) if self._metric else None

    def _emulated_cameras(self, speed: float) -> EmulatedCameras:
        from insole_studio.acquisition.emulated_realsense import emulated_camera
        from realsense_d400.emulation import EmulatedCameras

        first: dict[str, View] = {}
        for view in self._metric.values():
            first.setdefault(view.sensor.serial, view)
        self._realsenses = {
            serial: emulated_camera(view, bus)
            for bus, (serial, view) in enumerate(first.items(), 1)
        }
        return EmulatedCameras(self._realsenses.values(), speed)

    def ports(
        self, warm_ups: WarmUps, settings: CameraSettings, tunings: Tunings
    ) -> tuple[SensorPort, ...]:
        """Return the ports of the families that the session was recorded with."""
        kinects = (KinectPort(UsbBus(self.bus), warm_ups),) if self._kinects else ()
        if self.cameras is None:
            return kinects
        return (*kinects, _realsense_port(self.cameras, warm_ups, settings, tunings))

    def put(self, serial: str, place: str) -> None:
        """Move a sensor to the position of a view, as somebody would by hand.

        Parameters
        ----------
        place
            Name of the view without the number of the burst.
        """
        if self._serials.get(place) != serial:
            return
        if place in self._metric:
            from insole_studio.acquisition.emulated_realsense import face

            face(self._realsenses[serial], self._metric[place])
        else:
            self._kinects[serial].face(self._scenes[place])


def emulated_views(session: Session) -> tuple[tuple[str, str], ...]:
    """Return view and serial number of each position, without further bursts."""
    places = _bursts_by_place(session).items()
    return tuple((place, views[0].sensor.serial) for place, views in places)


def emulated_bursts(session: Session) -> int:
    """Return how many bursts every view of a sensor with a motor has."""
    places = _bursts_by_place(session).values()
    fewest = min((len(views) for views in places if not _is_metric(views[0])), default=1)
    return min(MOST_BURSTS, fewest)


def recordings_in(path: Path) -> tuple[Path, ...]:
    """Return the recordings (``.db3``) that a path names: itself, or all in a folder."""
    if path.suffix.lower() == RECORDING:
        return (path,)
    if not path.is_dir() or (path / "manifest.json").exists():
        return ()
    return tuple(sorted(path.glob(f"*{RECORDING}")))


def _realsense_port(
    bus: CameraBus, warm_ups: WarmUps, settings: CameraSettings, tunings: Tunings
) -> SensorPort:
    from insole_studio.acquisition.realsense_sensors import RealSensePort

    return RealSensePort(bus, warm_ups, settings, tunings)


def _bursts_by_place(session: Session) -> dict[str, list[View]]:
    """Return the views of each position, further bursts after the first."""
    left = {view.name: view for view in session.views}
    places: dict[str, list[View]] = {}
    for view in session.views:
        if view.name not in left:
            continue
        bursts = places[view.name] = [left.pop(view.name)]
        while (other := left.get(burst_view(view.name, len(bursts)))) is not None:
            if other.sensor.serial != view.sensor.serial or _is_metric(other):
                break
            bursts.append(left.pop(other.name))
    return places


def _is_metric(view: View) -> bool:
    return view.sensor.depth_unit_mm is not None


def _kinect(sensor: Sensor, scenes: Mapping[float, Footage]) -> EmulatedKinect:
    calibration = factory_calibration(sensor)
    kinect = EmulatedKinect(Model.XBOX_1414, sensor.serial, calibration, scenes[0.0])
    kinect.face(scenes)
    return kinect


def _footage(view: View) -> Footage:
    depth = [view.read_depth(index) for index in range(view.depth_count)]
    colors = [view.read_color(index) for index in range(view.color_count)]
    mosaics = [mosaic(_whole(color)) for color in colors]
    return make_footage(depth, mosaics, _infrared(view, colors))


def _infrared(view: View, colors: Iterable[ByteArray]) -> list[RawArray]:
    """Return the infrared pictures (488, 640) of a view, or colour in their place."""
    below = (0, _INFRARED_SIZE[1] - view.sensor.depth_camera.height)
    if view.dots is not None and view.dots.pictures is not None:
        with suppress(InputError):  # what is wrong with them spoils no session
            pictures = view.dots.pictures
            return [np.pad(pictures.read(one), (below, (0, 0))) for one in range(pictures.count)]
    return [_in_grey(color) for color in colors]


def _in_grey(color: ByteArray) -> RawArray:
    """Return a colour picture as an infrared one, (488, 640)."""
    grey = cv2.resize(cv2.cvtColor(color, cv2.COLOR_RGB2GRAY), _INFRARED_SIZE)
    return 4 * grey.astype(np.uint16)


def _whole(color: ByteArray) -> ByteArray:
    if color.shape[:2] != (960, 1280):
        return color
    return np.pad(color, ((_CUT_ROWS, _CUT_ROWS), (0, 0), (0, 0)))


def factory_calibration(sensor: Sensor) -> Calibration:
    """Return the factory values of a device that measures as a sensor does.

    With the constant shift fixed (the device stores an integer), focal length, slope and offset
    of 1 / Z over the raw number determine the other three: D, p = D / (2 f), and the baseline b.
    """
    slope_offset = _inverse_depth(sensor.disparity)
    if slope_offset is None:
        return TYPICAL_CALIBRATION
    slope, offset = slope_offset
    shift = TYPICAL_CALIBRATION.constant_shift
    distance_mm = 1 / (offset + (4 * shift + 1.5) * slope)
    plane = ZeroPlane(
        emitter_distance_cm=1 / (-80 * sensor.depth_camera.fx * slope),
        rgb_distance_cm=TYPICAL_CALIBRATION.zero_plane.rgb_distance_cm,
        reference_distance_cm=distance_mm / 10,
        reference_pixel_cm=distance_mm / (20 * sensor.depth_camera.fx),
    )
    typical = TYPICAL_CALIBRATION
    return Calibration(plane, typical.registration, typical.padding, shift)


def _inverse_depth(model: DisparityModel) -> tuple[float, float] | None:
    """Return slope and offset of 1 / Z over the raw number; None if it is not a straight line."""
    if not isinstance(model, FactoryDisparity | LinearInverseDisparity):
        return None
    low, high = 400.0, 900.0
    at_low, at_high = (1 / float(model.depth_mm(np.array(raw))) for raw in (low, high))
    slope = (at_high - at_low) / (high - low)
    return slope, at_low - low * slope


@dataclass(frozen=True)
class SensorSource:
    """Creates rig and capture setup; small enough to be passed to another process.

    Parameters
    ----------
    stored
        Calibrations kept on this computer.
    emulate
        A recorded session whose frames are played as live sensors, or recordings of RealSense
        cameras (``.db3``, or a folder of them); None for real ones.
    system_file
        File of the reference system; None selects the bundled one, or that of the session.
    warm_up_file
        Where it is kept how long each sensor has been on; None keeps nothing.
    camera
        Settings of RealSense cameras of which nothing else is kept.
    tunings
        What was set of each sensor, and is kept.
    """

    stored: SensorFiles
    emulate: Path | None = None
    system_file: Path | None = None
    warm_up_file: Path | None = None
    camera: CameraSettings = field(default_factory=CameraSettings)
    tunings: Tunings = field(default_factory=Tunings)

    @cached_property
    def session(self) -> Session | None:
        """Return the emulated session, if any.

        Raises
        ------
        InputError
            When it cannot be read, or is of sensors that cannot be emulated.
        """
        if self.emulate is None or recordings_in(self.emulate):
            return None
        session = read_session(self.emulate)
        for view in session.views:
            if view.sensor.family is DIRECT_DEPTH:
                raise InputError(
                    "{session} cannot be played back, because its view {view} was recorded by a "
                    "{model}, neither a Kinect nor a stereo camera; reconstruct it instead.",
                    session=session.source,
                    view=view.name,
                    model=view.sensor.model,
                )
        return session

    @cached_property
    def emulated_rig(self) -> EmulatedRig | None:
        """Return the emulated sensors, if any."""
        return None if self.session is None else EmulatedRig(self.session)

    def rig(self) -> Rig:
        """Find the sensors' bus, or create the emulated one.

        Raises
        ------
        InputError
            When the session cannot be read.
        SensorError
            When libusb is missing, or a recording cannot be played.
        """
        known = WarmUps(self.warm_up_file), self.camera, self.tunings
        if self.emulated_rig is not None:
            return Rig(*self.emulated_rig.ports(*known))
        recordings = recordings_in(self.emulate) if self.emulate is not None else ()
        if recordings:
            from insole_studio.acquisition.emulated_realsense import recorded_cameras

            return Rig(_realsense_port(recorded_cameras(recordings), *known))
        with translating():
            kinects = KinectPort(system_bus(), known[0])
        return Rig(kinects, _realsense_port(SystemCameras(), *known))

    def setup(self) -> CaptureSetup:
        """Return the capture setup.

        Raises
        ------
        InputError
        """
        if self.session is not None:
            return recorded_setup(self.stored, self.session, self.system_file)
        return own_setup(self.stored, self.system_file)

    def usual_views(self) -> tuple[tuple[str, str], ...]:
        """Return view and serial number of each emulated view; empty for real sensors."""
        return () if self.session is None else emulated_views(self.session)

    def usual_bursts(self) -> int:
        """Return the number of bursts per view of emulated sensors; one for real sensors."""
        return 1 if self.session is None else emulated_bursts(self.session)

    def put(self, step: CaptureStep) -> None:
        """Move emulated sensors to the positions of a step; the user has moved real ones."""
        if self.emulated_rig is not None:
            for shot in step.shots:
                self.emulated_rig.put(shot.serial, shot.place)
