"""Camera and streams on the emulated bus (level 1): what is delivered, and what goes wrong."""

from __future__ import annotations

import errno
from collections.abc import Callable
from typing import NoReturn

import numpy as np
import pytest
from kinect_samples import FRAMES, SERIALS, SPEED, Footage, Images, make_calibration

from kinect_v1 import commands
from kinect_v1.calibration import RGB_DISTANCE_CM
from kinect_v1.emulation.bus import EmulatedBus
from kinect_v1.emulation.device import EmulatedKinect
from kinect_v1.emulation.packet_source import Fault, FaultKind
from kinect_v1.errors import (
    BandwidthError,
    CommandRefusedError,
    InUseError,
    KinectError,
    NoFramesError,
    NoPermissionError,
    NoPowerError,
    NoSensorError,
    ProtocolError,
    StoppedError,
    TransferError,
    UnpluggedError,
    UnsupportedError,
)
from kinect_v1.kinect_camera import CameraSettings, ColorSettings, open_camera
from kinect_v1.models import Model
from kinect_v1.modes import (
    BAYER_640,
    BAYER_1280,
    DEPTH,
    DEPTH_10,
    DEPTH_11,
    IR_640,
    IR_1280,
    MODES,
    VIDEO,
    Register,
    StreamMode,
)
from kinect_v1.sensors import list_sensors
from kinect_v1.streams import Frame, Stream
from kinect_v1.usb_bus import UsbBus, UsbError
from tests.patience import wait_for

QUICK = CameraSettings(watchdog_s=0.3, command_limit_s=0.1)


def number_of(frame: Frame, sent: list[np.ndarray]) -> int:
    return next((i for i, other in enumerate(sent) if np.array_equal(frame.image, other)), -1)


def read_forever(stream: Stream, into: list[Frame] | None = None) -> NoReturn:
    while True:
        frame = stream.read()
        if into is not None:
            into.append(frame)


@pytest.mark.parametrize("serial", SERIALS)
@pytest.mark.parametrize("mode", MODES.values(), ids=MODES)
def test_every_mode_of_every_model_delivers_what_was_sent(
    mode: StreamMode, serial: str, bus: UsbBus, images: Images
) -> None:
    with open_camera(serial, bus=bus) as camera:
        start = camera.start_depth if mode.kind is DEPTH else camera.start_video
        stream = start(mode)
        frames = [stream.read() for _ in range(FRAMES + 1)]
        counts = stream.counts
    sent = images[serial][mode.name]
    assert [number_of(frame, sent) for frame in frames] == [0, 1, 2, 0]
    assert [frame.number for frame in frames] == [0, 1, 2, 3]
    assert all(frame.mode is mode and frame.discarded == 0 for frame in frames)
    assert frames[0].device_time < frames[1].device_time
    assert counts.discarded == counts.lost_packets == 0


def test_three_sensors_stream_depth_and_colour_at_once(bus: UsbBus, images: Images) -> None:
    cameras = [open_camera(serial, bus=bus) for serial in SERIALS]
    streams = [(c.serial, c.start_depth(), c.start_video(BAYER_640)) for c in cameras]
    for serial, depth, video in streams:
        for stream in (depth, video):
            frame = stream.read()
            sent = images[serial][stream.mode.name]
            assert number_of(frame, sent) == frame.number % FRAMES
    for camera in cameras:
        camera.close()


@pytest.mark.parametrize("index", range(3))
def test_calibration_is_the_devices_own(index: int, bus: UsbBus) -> None:
    with open_camera(SERIALS[index], bus=bus) as camera:
        found = camera.calibration.as_dict()
    expected = make_calibration(index).as_dict()
    expected["zero_plane"]["rgb_distance_cm"] = RGB_DISTANCE_CM
    assert found == expected


def test_a_calibration_cut_short_is_refused_and_the_sensor_given_back(
    bus: UsbBus, kinects: list[EmulatedKinect], monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(kinects[0].camera, "fixed_parameters", lambda: bytes(60))
        with pytest.raises(ProtocolError, match="60 bytes") as caught:
            open_camera(SERIALS[0], bus=bus)
    assert_one_sentence(caught.value)
    open_camera(SERIALS[0], bus=bus).close()


def test_frames_can_be_delivered_instead_of_read(bus: UsbBus) -> None:
    delivered: list[Frame] = []
    with open_camera(SERIALS[0], bus=bus) as camera:
        stream = camera.start_depth(DEPTH_11, delivered.append)

        def has_three() -> bool:
            stream.check()
            return len(delivered) >= 3

        wait_for(has_three)
    assert [frame.number for frame in delivered[:3]] == [0, 1, 2]


def test_an_error_of_the_receiver_is_raised_to_who_watches(bus: UsbBus) -> None:
    def refuse(_frame: Frame) -> None:
        raise OSError("no space left")

    with open_camera(SERIALS[0], bus=bus) as camera:
        stream = camera.start_depth(DEPTH_11, refuse)
        with pytest.raises(OSError, match="no space left"):
            stream.read(2)


def test_the_emitter_shines_only_while_depth_or_infrared_runs(
    bus: UsbBus, kinects: list[EmulatedKinect]
) -> None:
    device = kinects[0].camera
    with open_camera(SERIALS[0], bus=bus) as camera:
        assert not device.emitter_on
        camera.start_video(BAYER_640)
        assert not device.emitter_on
        camera.start_depth()
        assert device.emitter_on
        camera.stop_depth()
        assert not device.emitter_on
        camera.start_video(IR_640)
        assert device.emitter_on
    assert not device.emitter_on


def test_registers_left_on_by_a_dead_program_are_switched_off_at_open(
    bus: UsbBus, kinects: list[EmulatedKinect]
) -> None:
    device = kinects[0].camera
    device.registers.update({DEPTH.switch: 2, VIDEO.switch: 3})
    device.control_out(0x40, 0, 0, commands.encode_request(2, 99, commands.words(5)))  # unfetched
    with open_camera(SERIALS[0], bus=bus):
        assert not device.emitter_on


def test_changing_the_colour_mode_restarts_the_stream(bus: UsbBus, images: Images) -> None:
    with open_camera(SERIALS[0], bus=bus) as camera:
        first = camera.start_video(BAYER_640)
        first.read()
        second = camera.start_video(BAYER_1280)
        assert number_of(second.read(), images[SERIALS[0]][BAYER_1280.name]) == 0
        with pytest.raises(StoppedError):
            read_forever(first)


def test_large_infrared_and_depth_exclude_each_other(bus: UsbBus) -> None:
    with open_camera(SERIALS[0], bus=bus) as camera:
        camera.start_depth(DEPTH_10)
        with pytest.raises(UnsupportedError, match="stop depth first"):
            camera.start_video(IR_1280)
        camera.stop_depth()
        camera.start_video(IR_1280)
        with pytest.raises(UnsupportedError, match="stop the infrared"):
            camera.start_depth()
        camera.stop_video()
        with pytest.raises(UnsupportedError, match="no mode of the depth"):
            camera.start_depth(BAYER_640)


def test_exposure_and_white_balance(bus: UsbBus, kinects: list[EmulatedKinect]) -> None:
    cmos = kinects[0].camera.cmos
    settings = CameraSettings(color=ColorSettings(exposure_us=10_000))
    with open_camera(SERIALS[0], settings, bus) as camera:
        assert cmos[commands.CMOS_FLAGS] == 0
        assert cmos[commands.CMOS_SHUTTER] == 184  # 184 × 54.21 µs
        camera.set_color(ColorSettings())
        assert cmos[commands.CMOS_FLAGS] == 0x4082
        camera.set_color(ColorSettings(auto_white_balance=False))
        assert cmos[commands.CMOS_FLAGS] == 0x4080


def test_near_mode_is_for_windows_only(bus: UsbBus, kinects: list[EmulatedKinect]) -> None:
    registers = kinects[2].camera.registers
    with open_camera(SERIALS[2], CameraSettings(near_mode=True), bus) as camera:
        assert (registers[Register.SENSOR_GAIN], registers[Register.NEAR_RANGE]) == (7, 0)
        camera.set_near_mode(False)
        assert (registers[Register.SENSOR_GAIN], registers[Register.NEAR_RANGE]) == (0x1E, 0x190)
        camera.set_sensor_gain(99)
        assert registers[Register.SENSOR_GAIN] == 50
    with pytest.raises(UnsupportedError, match="near mode"):
        open_camera(SERIALS[0], CameraSettings(near_mode=True), bus)
    open_camera(SERIALS[0], bus=bus).close()  # the refused one was given back


@pytest.mark.parametrize("kind", ["lost", "packet magic", "flag", "short", "sequence", "repeated"])
@pytest.mark.parametrize("count", [1, 5, 20])
def test_damage_on_the_way_is_never_delivered(
    kind: FaultKind, count: int, bus: UsbBus, kinects: list[EmulatedKinect], images: Images
) -> None:
    at = DEPTH_11.packets * 2
    kinects[0].camera.inject(Fault(kind, "depth", at, count))
    with open_camera(SERIALS[0], bus=bus) as camera:
        stream = camera.start_depth()
        frames = [stream.read() for _ in range(4)]
    sent = images[SERIALS[0]][DEPTH_11.name]
    assert [number_of(frame, sent) for frame in frames] == [0, 2, 0, 1]
    assert frames[0].discarded == 0
    assert frames[1].discarded >= 1


@pytest.mark.parametrize(
    ("kind", "error"),
    [
        ("no reply", TransferError),
        ("stall", TransferError),
        ("error word", CommandRefusedError),
        ("reply tag", ProtocolError),
    ],
)
def test_a_command_that_fails_leaves_the_sensor_usable(
    kind: FaultKind, error: type[KinectError], bus: UsbBus, kinects: list[EmulatedKinect]
) -> None:
    with open_camera(SERIALS[0], QUICK, bus) as camera:
        kinects[0].camera.inject(Fault(kind, at=3))
        with pytest.raises(error) as caught:
            camera.start_depth()
        assert_one_sentence(caught.value)
        assert not kinects[0].camera.emitter_on
        assert camera.start_depth().read().number == 0


def test_premature_replies_of_512_bytes_are_waited_out(
    bus: UsbBus, kinects: list[EmulatedKinect]
) -> None:
    kinects[0].camera.inject(Fault("full reply", count=100))
    with open_camera(SERIALS[0], bus=bus) as camera:
        assert camera.start_depth().read().number == 0


def test_a_full_controller_is_named_with_its_remedy(
    bus: UsbBus, kinects: list[EmulatedKinect]
) -> None:
    kinects[1].camera.inject(Fault("no bandwidth", "depth"))
    with open_camera(SERIALS[1], bus=bus) as camera:
        with pytest.raises(BandwidthError, match=r"bus 2 .*PCIe") as caught:
            camera.start_depth()
        assert_one_sentence(caught.value)
        assert not kinects[1].camera.emitter_on
        assert camera.start_depth().read().number == 0


def test_sensors_on_one_controller_take_turns(
    make_bus: Callable[..., UsbBus], kinects: list[EmulatedKinect]
) -> None:
    shared = make_bus(*kinects[:2], controllers=(4, 4))
    with open_camera(SERIALS[0], bus=shared) as one, open_camera(SERIALS[1], bus=shared) as other:
        for _ in range(2):
            one.start_depth().read()
            one.start_video().read()
            with pytest.raises(BandwidthError, match="bus 4"):
                other.start_depth()
            one.stop_depth()
            one.stop_video()
            other.start_depth().read()
            other.stop_depth()


def test_bandwidth_is_held_without_switching_anything_on(
    make_bus: Callable[..., UsbBus], kinects: list[EmulatedKinect]
) -> None:
    shared = make_bus(kinects[0], kinects[2], controllers=(4, 4))
    with open_camera(SERIALS[0], bus=shared) as one, open_camera(SERIALS[2], bus=shared) as other:
        for first, second in ((one, other), (other, one)):
            with first.reserving():
                assert not any(kinect.camera.emitter_on for kinect in kinects)
                with pytest.raises(BandwidthError, match="bus 4"), second.reserving():
                    pass
        depth = other.start_depth()
        with other.reserving():  # beside what runs already
            assert depth.read().number == 0
        assert depth.read().number == 1


def test_unplug_and_replug(
    emulated: EmulatedBus, kinects: list[EmulatedKinect], images: Images
) -> None:
    bus = UsbBus(emulated)
    sent = images[SERIALS[2]][DEPTH_11.name]
    delivered: list[Frame] = []
    camera = open_camera(SERIALS[2], bus=bus)
    stream = camera.start_depth()
    stream.read()
    emulated.unplug(kinects[2])
    with pytest.raises(UnpluggedError) as caught:
        read_forever(stream, delivered)
    assert all(number_of(frame, sent) >= 0 for frame in delivered[-10:])
    assert_one_sentence(caught.value)
    with pytest.raises(UnpluggedError):
        stream.check()
    with pytest.raises(UnpluggedError):
        camera.start_video()
    camera.close()
    with pytest.raises(NoSensorError, match=SERIALS[2]):
        open_camera(SERIALS[2], bus=bus)
    emulated.plug(kinects[2], controller=1)
    with open_camera(SERIALS[2], bus=bus) as again:
        assert again.bus == 1
        assert number_of(again.start_depth().read(), sent) == 0


def test_a_silent_stream_is_noticed(bus: UsbBus, kinects: list[EmulatedKinect]) -> None:
    kinects[0].camera.inject(Fault("lost", "depth", at=1000, count=1 << 40))
    with open_camera(SERIALS[0], QUICK, bus) as camera:
        stream = camera.start_depth()
        stream.read()
        stream.check()
        with pytest.raises(NoFramesError, match="no usable depth picture") as caught:
            read_forever(stream)
        assert_one_sentence(caught.value)
        with pytest.raises(NoFramesError):
            stream.check()


def test_a_second_program_is_told_who_has_the_sensor(bus: UsbBus) -> None:
    with open_camera(SERIALS[0], bus=bus):
        with pytest.raises(InUseError) as caught:
            open_camera(SERIALS[0], bus=bus)
        assert_one_sentence(caught.value)
    open_camera(SERIALS[0], bus=bus).close()


def test_a_sensor_that_another_program_uses_is_listed_so(bus: UsbBus) -> None:
    with open_camera(SERIALS[1], bus=bus) as camera:
        problems = {sensor.serial: sensor.problem for sensor in list_sensors(bus)}
        assert "used by another program" in (problems.pop(SERIALS[1]) or "")
        assert set(problems.values()) == {None}
        camera.start_depth().read()
    assert not any(sensor.problem for sensor in list_sensors(bus))


def test_a_camera_that_the_system_left_unconfigured(
    emulated: EmulatedBus, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_arguments: object) -> None:
        raise UsbError("Entity not found", None, errno.ENOENT)

    monkeypatch.setattr(emulated, "claim_interface", refuse)
    with pytest.raises(BandwidthError, match="controller of its own") as caught:
        open_camera(SERIALS[0], bus=UsbBus(emulated))
    assert_one_sentence(caught.value)


def test_without_permission_the_rule_is_named(emulated: EmulatedBus) -> None:
    emulated.denied = True
    with pytest.raises(NoPermissionError, match=r"70-kinect-v1\.rules") as caught:
        open_camera(SERIALS[0], bus=UsbBus(emulated))
    assert_one_sentence(caught.value)


def test_no_sensor_no_power_several_sensors(
    make_bus: Callable[..., UsbBus], kinects: list[EmulatedKinect], footage: Footage
) -> None:
    with pytest.raises(NoSensorError, match="No Kinect is plugged in"):
        open_camera(bus=make_bus())
    dark = EmulatedKinect(Model.XBOX_1414, "A0", make_calibration(0), {}, powered=False)
    with pytest.raises(NoPowerError, match="12 V"):
        open_camera(bus=make_bus(dark))
    with pytest.raises(NoSensorError, match=f"choose one of: .*{SERIALS[0]}"):
        open_camera(bus=make_bus(*kinects))
    with pytest.raises(NoSensorError, match=f"number X; plugged in now: {SERIALS[0]}"):
        open_camera("X", bus=make_bus(kinects[0]))
    with open_camera(bus=make_bus(kinects[1])) as only:
        assert only.serial == SERIALS[1]


def test_frames_that_nobody_fetches_are_counted(kinects: list[EmulatedKinect]) -> None:
    with open_camera(SERIALS[0], bus=UsbBus(EmulatedBus(kinects, speed=4 * SPEED))) as camera:
        stream = camera.start_depth()
        wait_for(lambda: stream.counts.overrun)
        assert stream.read().number > 0


def assert_one_sentence(error: BaseException) -> None:
    text = str(error)
    assert text.endswith(".")
    assert "\n" not in text
    assert ". " not in text.replace("e.g. ", "")
