"""The driver on its own: ``python -m kinect_v1 list | info | view | record DIR``."""

from __future__ import annotations

import argparse
import json
import shutil
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

from kinect_v1 import modes
from kinect_v1.emulation.bus import EmulatedBus
from kinect_v1.emulation.playback import recorded_kinect
from kinect_v1.errors import KinectError, NoSensorError, UnsupportedError
from kinect_v1.kinect_camera import CameraSettings, KinectCamera, open_camera
from kinect_v1.modes import StreamMode
from kinect_v1.motor import Posture
from kinect_v1.recordings import recording_folder
from kinect_v1.sensors import list_sensors
from kinect_v1.streams import Frame, Stream
from kinect_v1.terminal_view import CLEAR, HOME, beside, color_picture, render
from kinect_v1.usb_bus import UsbBus, system_bus

VIDEO_MODES: dict[str, StreamMode | None] = {
    "640x480": modes.BAYER_640,
    "1280x1024": modes.BAYER_1280,
    "ir": modes.IR_640,
    "none": None,
}
_STATUS_LINES = 2
_STOP_SIGNALS = tuple(
    getattr(signal, name)
    for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
    if hasattr(signal, name)
)
_PATIENT = CameraSettings(watchdog_s=3.0)


class Stopped(KeyboardInterrupt):
    """The user or the system asked the command to stop.

    Attributes
    ----------
    number
        Of the signal.
    """

    def __init__(self, number: int, outcome: str = "nothing was written") -> None:
        super().__init__(f"Stopped on request; {outcome}.")
        self.number = number


def main(arguments: list[str] | None = None, find_bus: Callable[[], UsbBus] = system_bus) -> int:
    """Run a command and return its exit code.

    Parameters
    ----------
    arguments
        By default those of this process.
    find_bus
        Returns the bus to search for sensors.
    """
    options = _parser().parse_args(arguments)
    try:
        if options.emulate is not None:
            bus = UsbBus(EmulatedBus([recorded_kinect(options.emulate)]))
        else:
            bus = find_bus()
        options.run(options, bus)
    except KinectError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt as stop:
        print(stop if isinstance(stop, Stopped) else Stopped(signal.SIGINT), file=sys.stderr)
        return 128 + _number_of(stop)  # as shells count it
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="kinect_v1", description="Kinect v1 sensors.")
    parser.add_argument(
        "--emulate", type=Path, metavar="RECORDING", help="play a fakenect folder as a sensor"
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    def command(name: str, run: Callable[..., None], text: str) -> argparse.ArgumentParser:
        sub = commands.add_parser(name, help=text, description=text)
        sub.set_defaults(run=run)
        return sub

    command("list", _list, "Name the sensors that are plugged in.")
    info = command("info", _info, "Print model, serial number and calibration as JSON.")
    view = command("view", _view, "Show depth and colour in the terminal; Ctrl+C ends it.")
    record = command("record", _record, "Record frames as a fakenect folder.")
    record.add_argument("folder", type=Path, metavar="DIR")
    for sub in (info, view, record):
        sub.add_argument("--serial", help="which sensor; may be left out where there is one")
    for sub in (view, record):
        sub.add_argument("--frames", type=_count, help="how many depth frames")
        sub.add_argument("--color", choices=VIDEO_MODES, default="640x480")
    return parser


def _count(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("one frame at least")
    return number


def _list(_options: argparse.Namespace, bus: UsbBus) -> None:
    sensors = list_sensors(bus)
    if not sensors:
        raise NoSensorError("No Kinect is plugged in; plug in its USB cable and its 12 V supply.")
    for sensor in sensors:
        model = sensor.model.value if sensor.model else "?"
        print(sensor.serial or "-", model, sensor.place, sensor.problem or "ready", sep="\t")


def _info(options: argparse.Namespace, bus: UsbBus) -> None:
    with open_camera(options.serial, bus=bus) as camera:
        print(
            json.dumps(
                {
                    "model": camera.model.value,
                    "serial": camera.serial,
                    "calibration": camera.calibration.as_dict(),
                },
                indent=2,
            )
        )


def _start(camera: KinectCamera, options: argparse.Namespace) -> tuple[Stream, Stream | None]:
    mode = VIDEO_MODES[options.color]
    depth = camera.start_depth()
    return depth, camera.start_video(mode) if mode else None


def _view(options: argparse.Namespace, bus: UsbBus) -> None:
    try:
        _show(options, bus)
    except KeyboardInterrupt as stop:  # without a number, Ctrl+C is how the view ends
        if options.frames is not None or _number_of(stop) != signal.SIGINT:
            raise


def _show(options: argparse.Namespace, bus: UsbBus) -> None:
    with open_camera(options.serial, _PATIENT, bus) as camera:
        depth, video = _start(camera, options)
        print(CLEAR, end="")
        shown = 0
        while options.frames is None or shown < options.frames:
            pictures = [stream.read_latest() for stream in (depth, video) if stream]
            print(HOME + _drawing(pictures) + f"\n{depth.counts}", flush=True)
            shown += 1


def _drawing(frames: list[Frame]) -> str:
    terminal = shutil.get_terminal_size()
    columns = (terminal.columns - len(frames)) // len(frames)
    drawings = [
        render(color_picture(frame), columns, terminal.lines - _STATUS_LINES) for frame in frames
    ]
    return drawings[0] if len(drawings) == 1 else beside(*drawings)


def _posture(camera: KinectCamera) -> Posture | None:
    """Read the accelerometer, if the sensor allows it."""
    try:
        return camera.motor.posture()
    except UnsupportedError:
        return None


def _record(options: argparse.Namespace, bus: UsbBus) -> None:
    wanted, taken = options.frames or 10, 0
    try:
        with (
            recording_folder(options.folder) as writer,
            open_camera(options.serial, _PATIENT, bus) as camera,
        ):
            posture = _posture(camera)
            if posture is not None:
                writer.add_posture(posture)
            depth, video = _start(camera, options)
            for _ in range(wanted):
                writer.add(depth.read())
                taken += 1
                if video and (frame := video.poll()) is not None:  # colour is never faster
                    writer.add(frame)
            if video and not video.counts.frames:
                writer.add(video.read())
            counts = depth.counts
            writer.finish(camera.serial, camera.model.value, camera.calibration)
    except KeyboardInterrupt as stop:
        raise Stopped(
            _number_of(stop),
            f"{taken} of {wanted} depth frames had come and are discarded, "
            f"and {options.folder} was not written",
        ) from None
    print(
        f"{options.folder}: {wanted} depth frames; left out: {counts.discarded} damaged, "
        f"{counts.overrun} that came faster than they could be written"
    )


def _number_of(stop: KeyboardInterrupt) -> int:
    return stop.number if isinstance(stop, Stopped) else signal.SIGINT


def stop_on_signals() -> None:
    """Raise `Stopped` at the first signal, so that emitters go dark and nothing half-written stays.

    Those that follow do not disturb that. A signal that the caller had switched off, like `nohup`,
    stays off.
    """
    for number in _STOP_SIGNALS:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, _stop)


def _stop(number: int, _frame: object) -> NoReturn:
    for other in _STOP_SIGNALS:
        signal.signal(other, signal.SIG_IGN)
    raise Stopped(number)


if __name__ == "__main__":
    stop_on_signals()
    sys.exit(main())
