"""An open camera: its calibration, its streams, and what can be set."""

from __future__ import annotations

import time
from collections import defaultdict, deque
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from realsense_d400.bandwidth import StreamSize
from realsense_d400.cameras import CameraBus, camera_info, find_device
from realsense_d400.errors import RealSenseError
from realsense_d400.library import library, told
from realsense_d400.settings import CameraSettings, Preset

Eye = Literal["left", "right"]
DEPTH_FPS, COLOR_FPS = 30, 15
"""Colour at half the rate leaves room for three cameras on one controller."""
_QUEUE = 12
_MM_PER_M = 1000.0
_SILENT_S, _DEAD_S = 0.5, 5.0
"""Without a frame for so long it is looked whether it is still there; then it is given up."""


@dataclass(frozen=True)
class Intrinsics:
    """The pinhole model of one of its cameras, as the factory calibrated it.

    Parameters
    ----------
    width, height, fx, fy, cx, cy
        px, pixel centres at integers.
    distortion
        k1, k2, p1, p2, k3.
    inverse
        Whether the distortion leads from the picture to the pinhole, rather than into the picture.
    """

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    distortion: tuple[float, float, float, float, float]
    inverse: bool


@dataclass(frozen=True, eq=False)
class Calibration:
    """What the factory stored in a camera.

    Parameters
    ----------
    depth, color
        Of the depth pictures and of the colour pictures.
    rotation : (3, 3) float64
    translation_mm : (3,) float64
        From the depth camera's frame to the colour camera's.
    depth_unit_mm
        Of the numbers in depth pictures.
    baseline_mm
        Between its two infrared cameras.
    """

    depth: Intrinsics
    color: Intrinsics
    rotation: NDArray[np.float64]
    translation_mm: NDArray[np.float64]
    depth_unit_mm: float
    baseline_mm: float


@dataclass(frozen=True, eq=False)
class Frame:
    """One picture, in the library's own memory, of which it has little: copy what is kept.

    Parameters
    ----------
    image
        Depth (height, width) uint16, colour (height, width, 3) uint8, RGB, or infrared (height,
        width) uint8.
    time_s
        When it was taken, by the camera's clock, as `time.monotonic()`.
    number
        The camera's count.
    owner
        The library's frame, which must live as long as the picture.
    """

    image: NDArray[Any]
    time_s: float
    number: int
    owner: Any


class _Wanted(NamedTuple):
    """Pictures that a camera is asked for; of the infrared ones the left have the number 1."""

    stream: Any
    form: Any
    fps: int
    eye: int = 0


@dataclass(frozen=True, eq=False)
class _Running:
    """One of the library's sensors that streams, and its pictures that nobody has taken yet."""

    sensor: Any
    queue: Any
    profiles: list[Any]
    waiting: defaultdict[str, deque[Frame]] = field(
        default_factory=lambda: defaultdict(lambda: deque(maxlen=_QUEUE))
    )


class _Clock:
    """Brings the camera's times to `time.monotonic()`: the frame that came fastest had no delay."""

    def __init__(self) -> None:
        self._offset_s = float("inf")

    def host_s(self, camera_ms: float) -> float:
        camera_s = camera_ms / _MM_PER_M
        self._offset_s = min(self._offset_s, time.monotonic() - camera_s)
        return camera_s + self._offset_s


class Camera:
    """An open camera; close it.

    Every method raises `RealSenseError` when the camera is lost or does not answer.

    Parameters
    ----------
    bus
        Where it is plugged in.
    serial
    settings

    Raises
    ------
    NoCameraError
        When it is not plugged in.
    """

    def __init__(self, bus: CameraBus, serial: str, settings: CameraSettings | None = None) -> None:
        self._bus = bus
        self._device, self.info = find_device(bus, serial)
        self.serial = serial
        self._settings = settings or CameraSettings()
        self._rs = library()
        self._clock = _Clock()
        self._last: dict[str, Any] = {}
        self._held = False
        self._heard_s = time.monotonic()
        self._looked_s = self._heard_s
        self.discarded = 0
        self._number: int | None = None
        self._running: dict[str, _Running] = {}
        with told(serial):
            self._depth_sensor, self._color_sensor = self._sensors()
            self._set_up()

    @property
    def depth_size(self) -> StreamSize:
        """Return its largest depth pictures."""
        return _size(self._depth_profile())

    def color_profile_size(self, size: tuple[int, int] | None = None) -> StreamSize:
        """Return its colour pictures of a size, or the largest."""
        return _size(self._color_profile(size))

    def mb_s(self, color_size: tuple[int, int] | None = None) -> float:
        """Return how much its streams take of a USB controller, MB/s."""
        depth = self.depth_size
        eye = StreamSize(depth.width, depth.height, depth.fps, 1)
        pair = 2 * eye.mb_s if self._settings.infrared else 0.0
        return depth.mb_s + self.color_profile_size(color_size).mb_s + pair

    @property
    def calibration(self) -> Calibration:
        """Return what the factory stored in it."""
        rs = self._rs
        with told(self.serial):
            depth = self._depth_profile().as_video_stream_profile()
            color = self._color_profile(None).as_video_stream_profile()
            placed = depth.get_extrinsics_to(color)
            unit_m = self._depth_sensor.get_option(rs.option.depth_units)
            baseline_mm = abs(self._depth_sensor.get_option(rs.option.stereo_baseline))
            return Calibration(
                _intrinsics(depth.get_intrinsics(), rs),
                _intrinsics(color.get_intrinsics(), rs),
                np.reshape(placed.rotation, (3, 3), order="F").astype(float),
                np.array(placed.translation) * _MM_PER_M,
                round(unit_m * _MM_PER_M, 6),
                float(baseline_mm),
            )

    @property
    def temperature_c(self) -> float | None:
        """Return the temperature of its projector, or of its chip; None if it measures none."""
        option = self._rs.option
        for key in (option.projector_temperature, option.asic_temperature):
            with suppress(RuntimeError):  # some are listed, but read only while it streams
                if self._depth_sensor.supports(key):
                    return float(self._depth_sensor.get_option(key))
        return None

    @property
    def has_presets(self) -> bool:
        """Whether a preset can be chosen; of a recording none can."""
        with told(self.serial):
            return self._can_set(self._depth_sensor, "visual_preset")

    @property
    def preset(self) -> Preset | None:
        """Return the preset that it works by; None for one that the program does not know."""
        if not self.has_presets:
            return None
        with told(self.serial):
            value = self._depth_sensor.get_option(self._rs.option.visual_preset)
        return next((preset for preset in Preset if preset.value == value), None)

    @property
    def laser_range_mw(self) -> tuple[float, float, float] | None:
        """Return least, greatest and step of its projector's power; None if it cannot be set."""
        with told(self.serial):
            if not self._can_set(self._depth_sensor, "laser_power"):
                return None
            limits = self._depth_sensor.get_option_range(self._rs.option.laser_power)
        return float(limits.min), float(limits.max), float(limits.step)

    @property
    def laser_mw(self) -> float | None:
        """Return the power of its projector; None if it cannot be set."""
        if self.laser_range_mw is None:
            return None
        with told(self.serial):
            return float(self._depth_sensor.get_option(self._rs.option.laser_power))

    def set_preset(self, preset: Preset) -> None:
        """Choose a preset, which may set the power of the projector too."""
        with told(self.serial):
            self._set(self._depth_sensor, "visual_preset", float(preset.value))

    def set_laser_mw(self, power_mw: float) -> None:
        """Set the power of the projector, to the nearest step that it has."""
        limits = self.laser_range_mw
        if limits is not None:
            least, _, step = limits
            power_mw = least + step * round((power_mw - least) / step) if step else power_mw
        with told(self.serial):
            self._set(self._depth_sensor, "laser_power", power_mw, " mW")

    @property
    def has_infrared(self) -> bool:
        """Whether it can stream the pair of infrared pictures."""
        with told(self.serial), suppress(RealSenseError):
            return bool(self._eyes())
        return False

    def set_infrared(self, on: bool) -> None:
        """Stream the pair of infrared pictures from the next start of depth on, or no longer."""
        self._settings = replace(self._settings, infrared=on)

    @property
    def sends_infrared(self) -> bool:
        """Whether it streams the pair of infrared pictures beside depth."""
        return self._settings.infrared

    @property
    def streams_depth(self) -> bool:
        """Whether depth is streaming."""
        return "depth" in self._running

    @property
    def streams_color(self) -> bool:
        """Whether colour is streaming."""
        return "color" in self._running

    def start(self, color_size: tuple[int, int] | None = None) -> None:
        """Stream depth and colour; running streams go on."""
        with told(self.serial):
            if not self.streams_color:
                self._run("color", self._color_sensor, [self._color_profile(color_size)])
            if not self.streams_depth:
                self._set(self._depth_sensor, "emitter_enabled", 1.0)
                pair = self._eyes() if self._settings.infrared else []
                self._run("depth", self._depth_sensor, [self._depth_profile(), *pair])

    def stop_depth(self) -> None:
        """Stop depth, which switches its projector off."""
        self._halt("depth")

    def stop(self) -> None:
        """Stop everything."""
        self._halt("depth")
        self._halt("color")

    def hold_exposure(self) -> None:
        """Keep exposure and gain of the depth as they are, once there was a frame that tells them.

        Colour goes on as it is: a capture takes one picture of it.
        """
        frame = self._last.get("depth")
        if self._held or frame is None:
            return
        told_by = self._rs.frame_metadata_value
        values = {"exposure": told_by.actual_exposure, "gain": told_by.gain_level}
        self._held = True
        with told(self.serial):
            known = {
                name: float(frame.get_frame_metadata(value))
                for name, value in values.items()
                if frame.supports_frame_metadata(value)
            }
            if known.keys() == values.keys():
                self._set(self._depth_sensor, "enable_auto_exposure", 0.0)
                for name, value in known.items():
                    self._set(self._depth_sensor, name, value)

    def free_exposure(self) -> None:
        """Let the camera choose exposure and gain again."""
        if self._held:
            self._held = False
            with told(self.serial):
                self._set(self._depth_sensor, "enable_auto_exposure", 1.0)

    def poll_depth(self) -> Frame | None:
        """Return the next depth picture if one is waiting.

        Raises
        ------
        RealSenseError
            When it was unplugged, or has sent nothing for a while.
        """
        frame = self._poll("depth", "depth")
        if frame is None:
            self._look_after()
            return None
        self._heard_s = time.monotonic()
        if self._number is not None:
            self.discarded += max(frame.number - self._number - 1, 0)
        self._number = frame.number
        return frame

    def poll_color(self) -> Frame | None:
        """Return the next colour picture if one is waiting."""
        return self._poll("color", "color")

    def poll_infrared(self, eye: Eye) -> Frame | None:
        """Return the next infrared picture of one of its two cameras if one is waiting."""
        return self._poll("depth", eye)

    def close(self) -> None:
        """Stop everything, also when it has been unplugged."""
        with suppress(RealSenseError):
            self.free_exposure()
        self.stop()

    def _sensors(self) -> tuple[Any, Any]:
        """Return the sensors that send depth, with infrared, and colour."""
        stream = self._rs.stream
        by_stream = {
            profile.stream_type(): sensor
            for sensor in self._device.query_sensors()
            for profile in sensor.get_stream_profiles()
        }
        if stream.depth not in by_stream or stream.color not in by_stream:
            missing = "depth" if stream.depth not in by_stream else "colour"
            raise RealSenseError(
                f"{self.info.model} {self.serial} sends no {missing} pictures; use a camera that "
                "has both, such as a D415."
            )
        return by_stream[stream.depth], by_stream[stream.color]

    def _set_up(self) -> None:
        settings = self._settings
        if settings.preset is not None:
            self.set_preset(settings.preset)
        if settings.laser_mw is not None:
            self.set_laser_mw(settings.laser_mw)
        self._set(self._depth_sensor, "depth_units", 1e-4)

    def _set(self, sensor: Any, name: str, value: float, unit: str = "") -> None:
        """Set an option where the camera has it; of a recording nothing can be set."""
        if not self._can_set(sensor, name):
            return
        key = getattr(self._rs.option, name)
        limits = sensor.get_option_range(key)
        if not limits.min <= value <= limits.max:
            raise RealSenseError(
                f"The {name.replace('_', ' ')} of RealSense {self.serial} can be {limits.min:g} to "
                f"{limits.max:g}{unit}, not {value:g}; choose a value in this range."
            )
        sensor.set_option(key, value)

    def _can_set(self, sensor: Any, name: str) -> bool:
        key = getattr(self._rs.option, name)
        return bool(sensor.supports(key)) and not sensor.is_option_read_only(key)

    def _depth_profile(self) -> Any:
        rs = self._rs
        return _best(self._depth_sensor, _Wanted(rs.stream.depth, rs.format.z16, DEPTH_FPS))

    def _color_profile(self, size: tuple[int, int] | None) -> Any:
        rs = self._rs
        return _best(self._color_sensor, _Wanted(rs.stream.color, rs.format.rgb8, COLOR_FPS), size)

    def _eyes(self) -> list[Any]:
        rs, depth = self._rs, self.depth_size
        eyes = [_Wanted(rs.stream.infrared, rs.format.y8, DEPTH_FPS, eye) for eye in (1, 2)]
        return [_best(self._depth_sensor, eye, (depth.width, depth.height)) for eye in eyes]

    def _run(self, kind: str, sensor: Any, profiles: Sequence[Any]) -> None:
        queue = self._rs.frame_queue(_QUEUE * len(profiles), True)
        self._heard_s = time.monotonic()
        sensor.open(list(profiles))
        sensor.start(queue)
        self._running[kind] = _Running(sensor, queue, list(profiles))
        self._number = None

    def _halt(self, kind: str) -> None:
        running = self._running.pop(kind, None)
        self._last.pop(kind, None)
        if running is not None:
            with suppress(RuntimeError):  # it may have been unplugged
                running.sensor.stop()
                running.sensor.close()

    def _poll(self, kind: str, name: str) -> Frame | None:
        """Return the next picture that one of its sensors has sent of a stream."""
        running = self._running.get(kind)
        if running is None:
            return None
        with told(self.serial):
            while frame := running.queue.poll_for_frame():
                image = np.asanyarray(frame.get_data())
                time_s = self._clock.host_s(frame.get_timestamp())
                waiting = running.waiting[_kind(frame.profile, self._rs)]
                waiting.append(Frame(image, time_s, frame.get_frame_number(), frame))
                self._last[kind] = frame
        waiting = running.waiting[name]
        return waiting.popleft() if waiting else None

    def _look_after(self) -> None:
        if self._device.is_playback():
            self._replay()
            return
        now_s = time.monotonic()
        if not self.streams_depth or now_s - max(self._heard_s, self._looked_s) < _SILENT_S:
            return
        self._looked_s = now_s
        if self.serial not in {camera_info(device).serial for device in self._bus.devices()}:
            raise RealSenseError(f"RealSense {self.serial} was unplugged; plug it in again.")
        if now_s - self._heard_s > _DEAD_S:
            raise RealSenseError(
                f"RealSense {self.serial} has sent nothing for {_DEAD_S:.0f} s; plug it in again."
            )

    def _replay(self) -> None:
        """Play a recording again once it has ended."""
        playback = self._device.as_playback()
        with told(self.serial):
            if playback.current_status() != self._rs.playback_status.stopped:
                return
            running = dict(self._running)
            for kind in running:
                self._halt(kind)
            self._clock = _Clock()
            for kind, ended in running.items():
                self._run(kind, ended.sensor, ended.profiles)


def _kind(profile: Any, rs: Any) -> str:
    if profile.stream_type() == rs.stream.infrared:
        return "left" if profile.stream_index() == 1 else "right"
    return "depth" if profile.stream_type() == rs.stream.depth else "color"


def _size(profile: Any) -> StreamSize:
    video = profile.as_video_stream_profile()
    return StreamSize(video.width(), video.height(), video.fps())


def _best(sensor: Any, wanted: _Wanted, size: tuple[int, int] | None = None) -> Any:
    """Return the largest pictures, or those of a size, as often as wanted if it can.

    Raises
    ------
    RealSenseError
    """
    sized = [
        profile
        for profile in map(_video, sensor.get_stream_profiles())
        if profile.stream_type() == wanted.stream
        and profile.format() == wanted.form
        and wanted.eye in (0, profile.stream_index())
        and (size is None or (profile.width(), profile.height()) == size)
    ]
    if not sized:
        pictures = "pictures" if size is None else f"pictures of {size[0]}×{size[1]}"
        raise RealSenseError(
            f"The camera sends no {wanted.stream.name} {pictures}; update its firmware, or use "
            "another camera."
        )

    def rank(profile: Any) -> tuple[int, int]:
        return profile.width() * profile.height(), -abs(profile.fps() - wanted.fps)

    return max(sized, key=rank)


def _video(profile: Any) -> Any:
    return profile.as_video_stream_profile()


def _intrinsics(values: Any, rs: Any) -> Intrinsics:
    k1, k2, p1, p2, k3 = map(float, values.coeffs)
    inverse = values.model == rs.distortion.inverse_brown_conrady
    return Intrinsics(
        values.width, values.height, values.fx, values.fy, values.ppx, values.ppy,
        (k1, k2, p1, p2, k3), inverse,
    )  # fmt: skip
