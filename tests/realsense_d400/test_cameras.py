"""The library's own devices, emulated and recorded, below the driver."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from realsense_samples import CALIBRATION, FRAMES, HEIGHT, WIDTH, camera

from realsense_d400 import cameras, usb_places
from realsense_d400.bandwidth import StreamSize, check_controller
from realsense_d400.camera import Camera, Frame
from realsense_d400.cameras import RecordedCameras, SystemCameras, list_cameras
from realsense_d400.emulation import (
    EXPOSURE_US,
    GAIN,
    EmulatedCamera,
    EmulatedCameras,
    Make,
    record,
)
from realsense_d400.errors import (
    BandwidthError,
    LibraryMissingError,
    NoCameraError,
    RealSenseError,
)
from realsense_d400.library import library, told
from realsense_d400.settings import CameraSettings, Preset
from realsense_d400.usb_places import UsbPlace
from tests.patience import wait_for

SPEED = 4.0


@pytest.fixture
def plugged() -> Iterator[Callable[..., EmulatedCameras]]:
    made: list[EmulatedCameras] = []

    def plug(*cameras: EmulatedCamera) -> EmulatedCameras:
        made.append(EmulatedCameras(cameras, SPEED))
        return made[-1]

    yield plug
    for bus in made:
        bus.close()


def taken(poll: Callable[[], Frame | None], count: int) -> list[Frame]:
    frames: list[Frame] = []

    def has_all() -> bool:
        frame = poll()
        frames.extend([] if frame is None else [frame])
        return len(frames) >= count

    wait_for(has_all)
    return frames


def test_pictures_arrive_bit_for_bit_with_the_time_of_the_camera(
    plugged: Callable[..., EmulatedCameras],
) -> None:
    rng = np.random.default_rng(1)
    eyes = [rng.integers(0, 255, (2, HEIGHT, WIDTH)).astype(np.uint8) for _ in range(FRAMES)]
    made = camera("815", infrared=[(left, right) for left, right in eyes])
    opened = Camera(plugged(made), "815", CameraSettings(infrared=True))
    opened.start()
    depth, color = taken(opened.poll_depth, 2), taken(opened.poll_color, 1)
    left, right = (taken(lambda eye=eye: opened.poll_infrared(eye), 1) for eye in ("left", "right"))
    for frame in depth:
        assert np.array_equal(frame.image, made.depth[frame.number % FRAMES])
    assert np.array_equal(color[0].image, made.color[color[0].number % len(made.color)])
    assert np.array_equal(left[0].image, eyes[left[0].number % FRAMES][0])
    assert np.array_equal(right[0].image, eyes[right[0].number % FRAMES][1])
    assert depth[1].time_s - depth[0].time_s > 0
    assert depth[1].time_s <= time.monotonic()
    opened.close()


def test_the_calibration_of_the_factory_is_what_the_camera_has(
    plugged: Callable[..., EmulatedCameras],
) -> None:
    found = Camera(plugged(camera("815")), "815").calibration
    assert (found.depth, found.color) == (CALIBRATION.depth, CALIBRATION.color)
    assert np.allclose(found.rotation, CALIBRATION.rotation)
    assert np.allclose(found.translation_mm, CALIBRATION.translation_mm, atol=1e-5)
    assert (found.depth_unit_mm, found.baseline_mm) == (0.1, 55.0)


def test_three_recordings_play_at_once_bit_for_bit(tmp_path: Path) -> None:
    """Of the library itself: pipelines whose frames wait until they are taken."""
    rs = library()
    made = [camera(serial) for serial in ("815", "816", "817")]
    context, pipelines = rs.context(), list[tuple[Any, Any]]()
    for one in made:
        record(one, tmp_path / f"{one.serial}.db3", FRAMES)
        pipeline, config = rs.pipeline(context), rs.config()
        config.enable_device_from_file(str(tmp_path / f"{one.serial}.db3"), repeat_playback=False)
        config.enable_stream(rs.stream.depth)
        resolved = config.resolve(rs.pipeline_wrapper(pipeline))
        playback = resolved.get_device().as_playback()
        playback.set_real_time(False)
        pipeline.start(config)
        pipelines.append((pipeline, playback))
    for one, (pipeline, playback) in zip(made, pipelines, strict=True):
        seen = []
        while len(seen) < FRAMES:
            is_there, frames = pipeline.try_wait_for_frames(60_000)
            assert is_there
            frame = frames.get_depth_frame()
            seen.append(int(frame.get_frame_number()))
            assert np.array_equal(np.asanyarray(frame.get_data()), one.depth[seen[-1]])
        # The library ends the process now and then where it is stopped while its file just ends.
        wait_for(partial(_has_ended, playback))
        pipeline.stop()
        assert seen == list(range(FRAMES))


def _has_ended(playback: Any) -> bool:
    return bool(playback.current_status() == library().playback_status.stopped)


def test_a_recording_is_a_camera_that_plays_over_and_over(tmp_path: Path) -> None:
    made = camera("815")
    record(made, tmp_path / "a.db3", FRAMES)
    bus = RecordedCameras([tmp_path / "a.db3"])
    (info,) = list_cameras(bus)
    assert (info.serial, info.model, info.problem) == ("815", "realsense-d415", None)
    opened = Camera(bus, "815")
    opened.start()
    frames = taken(opened.poll_depth, 2 * FRAMES)
    assert all(np.array_equal(one.image, made.depth[one.number % FRAMES]) for one in frames)
    assert len({frame.number for frame in frames}) < len(frames)
    opened.close()


def test_a_recording_that_was_cut_off_or_is_none_is_told(tmp_path: Path) -> None:
    whole, cut, other = (tmp_path / f"{name}.db3" for name in ("whole", "cut", "other"))
    record(camera("815"), whole, 2)
    cut.write_bytes(whole.read_bytes()[: whole.stat().st_size // 2])
    other.write_text("no recording")
    foreign = tmp_path / "foreign.db3"
    record(camera("9", make=Make("Intel RealSense L515", "L500")), foreign, 2)
    (found,) = list_cameras(RecordedCameras([foreign]))
    assert "L515 9 is of another series" in (found.problem or "")
    for path in (cut, other):
        with pytest.raises(RealSenseError, match=f"{path.name} is no complete recording"):
            RecordedCameras([path])
    with pytest.raises(RealSenseError, match=r"gone\.db3 does not exist"):
        RecordedCameras([tmp_path / "gone.db3"])


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (Make(usb="2.1"), "by USB 2.1, which is too slow for its full pictures; use a USB 3 port"),
        (Make(firmware="5.9.2.0"), "has the firmware 5.9.2.0, which is too old; update it to 5.12"),
        (Make("Intel RealSense L515", "L500"), "L515 815 is of another series"),
    ],
)
def test_a_camera_that_cannot_be_used_is_listed_with_the_reason(
    plugged: Callable[..., EmulatedCameras], make: Make, sentence: str
) -> None:
    bus = plugged(camera("815", make=make), camera("816", make=Make(bus=4)))
    unusable, usable = list_cameras(bus)
    assert sentence in (unusable.problem or "")
    assert (usable.problem, usable.firmware, usable.usb, usable.controller) == (
        None, "5.16.0.1", "3.2", 4,
    )  # fmt: skip
    with pytest.raises(RealSenseError, match=r"815"):
        Camera(bus, "815")
    with pytest.raises(NoCameraError, match="No RealSense has the number 9; plug it in"):
        Camera(bus, "9")


def test_a_camera_that_the_library_may_not_open_is_listed_with_the_remedy(
    plugged: Callable[..., EmulatedCameras],
) -> None:
    bus = plugged(camera("815"))
    bus.places = lambda: frozenset({UsbPlace(1, 4), UsbPlace(2, 3)})  # type: ignore[method-assign]
    hidden = list_cameras(bus)[1]
    assert "install the udev rule 70-realsense.rules" in (hidden.problem or "")


@pytest.mark.parametrize(
    ("reason", "sentence"),
    [
        ("failed to open usb interface: 0, error: RS2_USB_STATUS_ACCESS", "install the udev rule"),
        ("xioctl(VIDIOC_S_FMT) failed, Device or resource busy", "used by another program; close"),
        ("hwmon command 0x15 failed", r"does not answer \(hwmon.*plug it in again"),
    ],
)
def test_what_the_library_raises_says_what_to_do(reason: str, sentence: str) -> None:
    with pytest.raises(RealSenseError, match=sentence), told("815"):
        raise RuntimeError(reason)


def test_a_camera_that_is_unplugged_says_so_and_can_be_plugged_in_again(
    plugged: Callable[..., EmulatedCameras],
) -> None:
    bus = plugged(camera("815"))
    before = bus.places()
    opened = Camera(bus, "815")
    opened.start()
    taken(opened.poll_depth, 1)
    bus.unplug("815")
    with pytest.raises(RealSenseError, match="RealSense 815 was unplugged; plug it in again"):
        taken(opened.poll_depth, 1000)
    opened.close()
    assert list_cameras(bus) == ()
    bus.plug("815")
    assert bus.places() != before
    again = Camera(bus, "815")
    again.start()
    taken(again.poll_depth, 1)
    again.close()


def test_settings_reach_the_camera_and_those_it_cannot_have_are_refused(
    plugged: Callable[..., EmulatedCameras],
) -> None:
    made = camera("815")
    bus, option = plugged(made), library().option
    Camera(bus, "815", CameraSettings(Preset.HIGH_DENSITY, 210.0))
    stereo = made.device.query_sensors()[0]
    assert stereo.get_option(option.visual_preset) == Preset.HIGH_DENSITY.value
    assert stereo.get_option(option.laser_power) == 210.0
    with pytest.raises(RealSenseError, match="The laser power of RealSense 815 can be 0 to 360 mW"):
        Camera(bus, "815", CameraSettings(laser_mw=500.0))


@pytest.mark.parametrize("ask", ["has_presets", "preset", "laser_mw", "has_infrared"])
def test_what_cannot_be_asked_of_a_lost_camera_is_told(
    plugged: Callable[..., EmulatedCameras], monkeypatch: pytest.MonkeyPatch, ask: str
) -> None:
    opened = Camera(plugged(camera("815")), "815")

    class Lost:
        def __getattr__(self, _name: str) -> Any:
            raise RuntimeError("hwmon command 0x4f failed")

    monkeypatch.setattr(opened, "_depth_sensor", Lost())
    with pytest.raises(RealSenseError, match="RealSense 815 does not answer"):
        getattr(opened, ask)


def test_exposure_is_held_once_there_is_a_picture_and_freed(
    plugged: Callable[..., EmulatedCameras],
) -> None:
    made = camera("815")
    option = library().option
    opened = Camera(plugged(made), "815")

    def chooses() -> list[float]:
        sensors = made.device.query_sensors()
        return [sensor.get_option(option.enable_auto_exposure) for sensor in sensors]

    opened.start()
    opened.hold_exposure()
    assert chooses() == [1.0, 1.0]
    taken(opened.poll_depth, 1)
    taken(opened.poll_color, 1)
    opened.hold_exposure()
    assert chooses() == [0.0, 1.0]
    stereo = made.device.query_sensors()[0]
    held = [stereo.get_option(key) for key in (option.exposure, option.gain)]
    assert held == [EXPOSURE_US, GAIN]
    opened.free_exposure()
    assert chooses() == [1.0, 1.0]
    assert opened.temperature_c == 36.5
    opened.close()


def test_a_controller_takes_three_cameras_and_tells_how_many_fit() -> None:
    depth, color = StreamSize(1280, 720, 30), StreamSize(1920, 1080, 15)
    each = depth.mb_s + color.mb_s
    check_controller("815", each, [each, each])
    with pytest.raises(BandwidthError, match=r"carries 3 cameras already.*so that 3 fit. Plug it"):
        check_controller("815", each, [each, each, each])


def test_without_its_library_a_camera_that_is_plugged_in_is_told_and_else_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "pyrealsense2", None)
    monkeypatch.setattr(cameras, "plugged_in", frozenset)
    assert list_cameras(SystemCameras()) == ()
    monkeypatch.setattr(cameras, "plugged_in", lambda: frozenset({UsbPlace(2, 3)}))
    with pytest.raises(LibraryMissingError, match=r"pyrealsense2, which is missing here; install"):
        list_cameras(SystemCameras())


def test_the_bus_tells_cameras_from_other_devices(monkeypatch: pytest.MonkeyPatch) -> None:
    class Plugged:
        def __init__(self, product: int, address: int) -> None:
            self.idProduct, self.bus, self.address = product, 2, address

    def find(**asked: Any) -> list[Plugged]:
        assert asked["idVendor"] == 0x8086
        return [Plugged(0x0AD3, 7), Plugged(0x0026, 8)]

    monkeypatch.setattr(usb_places.usb.core, "find", find)
    assert usb_places.plugged_in() == {UsbPlace(2, 7)}
