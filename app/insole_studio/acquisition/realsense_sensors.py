"""RealSense cameras behind the port: their driver's cameras, its frames and its calibration."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from types import TracebackType
from typing import Self

import numpy as np

from insole_core.geometry.arrays import ByteArray, FloatArray, RawArray
from insole_core.geometry.transforms import rigid
from insole_core.sensing.metric_depth import StereoDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.readings import Readings
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.messages import (
    Capability,
    DetectedSensor,
    LaserRange,
    Preset,
    Tuning,
)
from insole_studio.acquisition.sensor_port import (
    BusFullError,
    ColorSize,
    DepthFrame,
    InfraredPair,
    NoSensorFoundError,
    Place,
    SensorError,
    small_color,
)
from insole_studio.acquisition.tunings import Tunings
from insole_studio.acquisition.warm_up import WarmUps
from realsense_d400.bandwidth import check_controller
from realsense_d400.camera import Calibration, Camera, Eye, Frame, Intrinsics
from realsense_d400.cameras import UNKNOWN_CONTROLLER, CameraBus, CameraInfo, list_cameras
from realsense_d400.errors import BandwidthError, NoCameraError, RealSenseError
from realsense_d400.settings import CameraSettings
from realsense_d400.settings import Preset as CameraPreset

FAMILY = "realsense"
_CAN = frozenset({Capability.TOGETHER, Capability.TIMED})
_EYES: tuple[Eye, Eye] = ("left", "right")
_GRID_PX = 40
"""Pixels between the places at which a lens is compared."""
log = logging.getLogger(__name__)
log.addHandler(logging.NullHandler())  # a command tells the error itself, a window has a log


@contextmanager
def translating() -> Iterator[None]:
    """Convert the driver's errors, whose messages are sentences already, to the application's."""
    try:
        yield
    except RealSenseError as error:
        log.warning("%s", error)
        if isinstance(error, BandwidthError):
            raise BusFullError(str(error)) from error
        kind = NoSensorFoundError if isinstance(error, NoCameraError) else SensorError
        raise kind(str(error)) from error


class _Controllers:
    """What each streaming camera takes of its USB controller."""

    def __init__(self) -> None:
        self._taken: dict[str, tuple[int, float]] = {}

    def take(self, serial: str, controller: int, mb_s: float) -> None:
        """Book a camera.

        Raises
        ------
        BandwidthError
        """
        self.free(serial)
        others = [taken for number, taken in self._taken.values() if number == controller]
        if controller != UNKNOWN_CONTROLLER:
            check_controller(serial, mb_s, others)
        self._taken[serial] = controller, mb_s

    def free(self, serial: str) -> None:
        """Cancel the booking of a camera, if it has one."""
        self._taken.pop(serial, None)


class RealSensePort:
    """Finds and opens RealSense cameras of the D400 series.

    Parameters
    ----------
    bus
        The computer's own cameras, recordings, or emulated ones.
    warm_ups
        Of the cameras; by default they begin when a camera is opened.
    settings
        Of every camera that is opened, where nothing else is kept of it.
    tunings
        What is kept of each camera; by default nothing.
    """

    def __init__(
        self,
        bus: CameraBus,
        warm_ups: WarmUps | None = None,
        settings: CameraSettings | None = None,
        tunings: Tunings | None = None,
    ) -> None:
        self._tunings = tunings or Tunings()
        self._bus = bus
        self._warm_ups = warm_ups or WarmUps()
        self._settings = settings or CameraSettings()
        self._controllers = _Controllers()

    def find(self) -> tuple[DetectedSensor, ...]:
        """List the cameras that are plugged in (see `SensorPort`)."""
        with translating():
            return tuple(map(detected, list_cameras(self._bus)))

    def places(self) -> frozenset[Place]:
        """Return where cameras are plugged in (see `SensorPort`)."""
        return frozenset((FAMILY, *place) for place in self._bus.places())

    def open(self, serial: str) -> OpenRealSense:
        """Open a camera (see `SensorPort`)."""
        asked, kept = self._tunings.asked, self._tunings.kept(serial)
        settings = replace(self._settings, laser_mw=asked.laser_mw)
        if preset := asked.preset or kept.preset:
            settings = replace(settings, preset=CameraPreset[preset.name])
        pair = kept.pair if asked.pair is None else asked.pair
        settings = replace(settings, infrared=settings.infrared if pair is None else pair)
        with translating():
            camera = Camera(self._bus, serial, settings)
            if kept.pair and not asked.pair and not camera.has_infrared:
                camera.set_infrared(False)
            limits = camera.laser_range_mw
            if kept.laser_mw is not None and asked.laser_mw is None and limits is not None:
                camera.set_laser_mw(min(max(kept.laser_mw, limits[0]), limits[1]))
            return OpenRealSense(camera, self._controllers, self._warm_ups, self._tunings)


@dataclass(frozen=True, eq=False)
class RealSenseVideoFrame:
    """A colour frame of a RealSense."""

    frame: Frame

    @property
    def time_s(self) -> float:
        """When it was taken, `time.monotonic()`."""
        return self.frame.time_s

    def picture(self) -> ByteArray:
        """Return the colour picture (height, width, 3) uint8, RGB."""
        return np.array(self.frame.image, np.uint8)

    def preview(self) -> ByteArray:
        """Return colour of at most 640 pixels in a row."""
        return np.array(small_color(self.frame.image), np.uint8)

    def dots(self) -> RawArray:
        """Fail: its infrared pictures come beside colour, never in its place."""
        raise NotImplementedError


class OpenRealSense:
    """An open RealSense (see `OpenSensor`)."""

    def __init__(
        self, camera: Camera, controllers: _Controllers, warm_ups: WarmUps, tunings: Tunings
    ) -> None:
        self.serial = camera.serial
        self.model = camera.info.model or FAMILY
        self.bus = camera.info.controller
        laser = camera.laser_range_mw
        self.laser_range = None if laser is None else LaserRange(*laser)
        self._has_presets = camera.has_presets
        self.tuning = _tuning(camera)
        self._tunings = tunings
        self._eyes: dict[Eye, Frame] = {}
        self._camera = camera
        self._controllers = controllers
        self._warm_ups = warm_ups
        self._place = (camera.info.controller, 0)
        self.on_since_s = warm_ups.since_s(self.serial, self._place)
        self._factory = sensor_of(camera.calibration, self.serial, self.model, ())
        self._readings = Readings.of(self._factory)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def factory_sensor(self, faces: tuple[str, ...]) -> Sensor:
        """Return the calibration stored in the camera, for the marker groups that it sees."""
        with translating():
            return sensor_of(self._camera.calibration, self.serial, self.model, faces)

    @property
    def capabilities(self) -> frozenset[Capability]:
        """What it can do beyond depth and colour (see `OpenSensor`)."""
        found = {
            Capability.PAIR: self.tuning.pair,
            Capability.HAS_PAIR: self.tuning.pair is not None,
            Capability.PRESET: self._has_presets,
            Capability.LASER: self.laser_range is not None,
        }
        return _CAN.union(capability for capability, has in found.items() if has)

    def tune(self, tuning: Tuning) -> None:
        """Set preset, power of the projector and pair, and keep them (see `OpenSensor`)."""
        with translating():
            if tuning.pair is not None:
                self._send_pair(tuning.pair)
            if tuning.preset is not None:
                self._camera.set_preset(CameraPreset[tuning.preset.name])
            if tuning.laser_mw is not None:
                self._camera.set_laser_mw(tuning.laser_mw)
            self.tuning = _tuning(self._camera)
        self._tunings.keep(self.serial, self.tuning)

    def _send_pair(self, on: bool) -> None:
        """Stream the pair of infrared pictures too, or no longer; both restart depth."""
        before, streamed = self._camera.sends_infrared, self.streams
        if on == before:
            return
        self._camera.stop_depth()
        self._eyes.clear()
        self._camera.set_infrared(on)
        if not streamed:
            return
        try:
            self.start()
        except BusFullError:
            self._camera.set_infrared(before)
            self.start()
            raise

    @property
    def emits(self) -> bool:
        """Whether its projector is on."""
        return self._camera.streams_depth

    @property
    def streams(self) -> bool:
        """Whether depth and colour are streaming."""
        return self._camera.streams_depth and self._camera.streams_color

    @property
    def discarded(self) -> int:
        """Number of depth frames that were lost since it was opened."""
        return self._camera.discarded

    @property
    def temperature_c(self) -> float | None:
        """How warm its projector is; None if it does not say."""
        with translating():
            return self._camera.temperature_c

    def start(self, color_size: ColorSize | None = None) -> None:
        """Stream depth and colour (see `OpenSensor`)."""
        with translating():
            self._book(color_size)
            self._camera.start(color_size)

    def start_infrared(self) -> None:
        """Fail: its infrared pictures come beside colour, never in its place."""
        raise NotImplementedError

    @contextmanager
    def reserving(self) -> Iterator[None]:
        """Reserve the bandwidth of depth and colour within a context; switch nothing on."""
        with translating():
            self._book(None)
        try:
            yield
        finally:
            if not self.streams:
                self._controllers.free(self.serial)

    def _book(self, color_size: ColorSize | None) -> None:
        self._controllers.take(self.serial, self.bus, self._camera.mb_s(color_size))

    def stop_depth(self) -> None:
        """Switch the projector off."""
        with translating():
            self._camera.stop_depth()

    def hold_exposure(self) -> None:
        """Keep exposure and gain as they are, once there was a frame."""
        with translating():
            self._camera.hold_exposure()

    def free_exposure(self) -> None:
        """Let the camera choose exposure and gain again."""
        with translating():
            self._camera.free_exposure()

    def stop(self) -> None:
        """Stop everything, which frees the controller's bandwidth."""
        with translating():
            self._camera.stop()
        self._controllers.free(self.serial)

    def poll_depth(self) -> DepthFrame | None:
        """Return the next depth frame if one is waiting (see `DepthFrame`)."""
        with translating():
            frame = self._camera.poll_depth()
        if frame is None:
            return None
        image = np.array(frame.image, np.uint16)
        return DepthFrame(image, frame.time_s, self.discarded, self._readings.glance(image))

    def poll_video(self) -> RealSenseVideoFrame | None:
        """Return the next colour frame if one is waiting."""
        with translating():
            frame = self._camera.poll_color()
        return None if frame is None else RealSenseVideoFrame(frame)

    def poll_pair(self) -> InfraredPair | None:
        """Return the next left and right infrared picture if both are waiting."""
        with translating():
            for eye in _EYES:
                frame = self._eyes.get(eye) or self._camera.poll_infrared(eye)
                if frame is None:
                    return None
                self._eyes[eye] = frame
        older, newer = sorted(_EYES, key=lambda eye: self._eyes[eye].number)
        if self._eyes[older].number < self._eyes[newer].number:
            del self._eyes[older]  # the other one was lost
            return None
        left, right = (np.array(self._eyes.pop(eye).image, np.uint8) for eye in _EYES)
        return left, right

    def tilt_deg(self) -> float:
        """Fail: it has no motor."""
        raise NotImplementedError

    def tilt_to(self, tilt_deg: float) -> None:
        """Fail: it has no motor."""
        raise NotImplementedError

    def roll_deg(self) -> float:
        """Fail: it has no motor."""
        raise NotImplementedError

    def blink(self, on: bool) -> None:
        """Fail: it has no light that blinks."""
        raise NotImplementedError

    def keep_warm_up(self) -> None:
        """Note how long it has been on, in case this process is killed."""
        self._warm_ups.keep(self.serial, self._place, self.on_since_s)

    def close(self) -> None:
        """Stop everything and release the camera, also when it has been unplugged."""
        self.keep_warm_up()
        self._controllers.free(self.serial)
        with translating():
            self._camera.close()


def _tuning(camera: Camera) -> Tuning:
    preset = camera.preset
    return Tuning(
        None if preset is None else Preset[preset.name],
        camera.laser_mw,
        camera.sends_infrared if camera.has_infrared else None,
    )


def sensor_of(calibration: Calibration, serial: str, model: str, faces: tuple[str, ...]) -> Sensor:
    """Return the sensor as the factory calibrated it.

    Parameters
    ----------
    calibration
    serial, model
    faces
        Marker groups that the sensor sees.
    """
    depth = _camera(calibration.depth)
    return Sensor(
        model=model,
        serial=serial,
        depth_camera=depth,
        color_camera=_camera(calibration.color),
        depth2color=rigid(calibration.rotation, calibration.translation_mm),
        disparity=StereoDisparity(depth.fx, calibration.baseline_mm),
        faces=faces,
        depth_unit_mm=calibration.depth_unit_mm,
        baseline_mm=calibration.baseline_mm,
    )


def detected(info: CameraInfo) -> DetectedSensor:
    """Return a camera as the application lists it."""
    return DetectedSensor(info.serial, info.model, info.controller, info.port, info.problem)


def _camera(values: Intrinsics) -> PinholeCamera:
    camera = PinholeCamera(
        values.width, values.height, values.fx, values.fy, values.cx, values.cy, values.distortion
    )
    if not values.inverse or not any(values.distortion):
        return camera
    return PinholeCamera(
        values.width, values.height, values.fx, values.fy, values.cx, values.cy, _forward(camera)
    )


def _forward(inverse: PinholeCamera) -> tuple[float, float, float, float, float]:
    """Return the distortion that leads into the picture, of one that leads out of it.

    Both have the same form, so its five numbers follow from places of the picture by least squares.
    """
    rows, columns = np.mgrid[0 : inverse.height : _GRID_PX, 0 : inverse.width : _GRID_PX]
    x = (columns.ravel() - inverse.cx) / inverse.fx
    y = (rows.ravel() - inverse.cy) / inverse.fy
    u, v = _bent(x, y, inverse.distortion)
    square = u**2 + v**2
    by_u = [u * square, u * square**2, 2 * u * v, square + 2 * u**2, u * square**3]
    by_v = [v * square, v * square**2, square + 2 * v**2, 2 * u * v, v * square**3]
    system = np.concatenate([np.stack(by_u, axis=1), np.stack(by_v, axis=1)])
    numbers = np.linalg.lstsq(system, np.concatenate([x - u, y - v]))[0]
    k1, k2, p1, p2, k3 = map(float, numbers)
    return k1, k2, p1, p2, k3


def _bent(
    x: FloatArray, y: FloatArray, distortion: tuple[float, float, float, float, float]
) -> tuple[FloatArray, FloatArray]:
    k1, k2, p1, p2, k3 = distortion
    square = x**2 + y**2
    radial = 1 + square * (k1 + square * (k2 + square * k3))
    return (
        x * radial + 2 * p1 * x * y + p2 * (square + 2 * x**2),
        y * radial + p1 * (square + 2 * y**2) + 2 * p2 * x * y,
    )
