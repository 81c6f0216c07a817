"""Arguments that choose the sensors of a command, and where their calibration is stored."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_studio.cli.argument_parser import number

if TYPE_CHECKING:
    from insole_core.sensing.sensor import Sensor
    from insole_core.workflows.calibration.sensor_store import SensorStore
    from insole_studio.acquisition.sensor_source import SensorSource


_AS_IT_IS = "as-it-is"


def add_store_argument(parser: argparse.ArgumentParser) -> None:
    """Add the folder of calibrated sensors."""
    parser.add_argument(
        "--sensors", type=Path, metavar="FOLDER",
        help="holds a folder for each serial number (by default in the user's application data)",
    )  # fmt: skip


def add_evaluated_sensor(parser: argparse.ArgumentParser) -> None:
    """Add the sensor to be evaluated."""
    parser.add_argument("--serial", help="of a calibrated sensor")
    parser.add_argument(
        "--sensor", type=Path, metavar="FOLDER",
        help="holds sensor.json, for example a view of a session; instead of --serial",
    )  # fmt: skip
    parser.add_argument(
        "--correction", type=Path, metavar="correction.npz",
        help="use this distortion correction instead of the sensor's own",
    )  # fmt: skip
    parser.add_argument(
        "--insist", action="store_true", help="use a correction of another sensor all the same"
    )
    add_store_argument(parser)


def store_of(arguments: argparse.Namespace) -> SensorStore:
    """Return the sensor store that the arguments select."""
    from insole_core.workflows.calibration.sensor_store import SensorStore

    return SensorStore(store_folder(arguments))


def store_folder(arguments: argparse.Namespace) -> Path:
    """Return the folder of the sensor store that the arguments select."""
    from insole_core.workflows.calibration.sensor_store import sensors_folder_of_user

    folder: Path | None = arguments.sensors
    return folder or sensors_folder_of_user()


def evaluated_lattice(arguments: argparse.Namespace) -> Sensor:
    """Return the sensor to be evaluated by captures, with the lattice of its readings.

    Raises
    ------
    InsoleError
    """
    from insole_core.sensing.readings import Readings
    from insole_core.workflows.calibration.sensor_store import measuring_disparity

    sensor = measuring_disparity(_named_sensor(arguments))
    return Readings.of(_with_correction(sensor, arguments)).sensor


def evaluated_sensor(arguments: argparse.Namespace) -> Sensor:
    """Return the Kinect to be evaluated, with the selected correction.

    Raises
    ------
    InsoleError
    """
    from insole_core.workflows.calibration.sensor_store import delivering_raw_numbers

    return _with_correction(delivering_raw_numbers(_named_sensor(arguments)), arguments)


def _with_correction(sensor: Sensor, arguments: argparse.Namespace) -> Sensor:
    if arguments.correction is None and sensor.correction is None:
        return sensor
    from datetime import UTC, datetime

    from insole_core.calibration.stored_correction import apply_correction
    from insole_core.sensing.correction import load_correction

    correction = sensor.correction
    if arguments.correction is not None:
        correction = load_correction(arguments.correction, sensor.corrected_image)
    assert correction is not None
    if not sensor.serial:
        sensor = replace(sensor, serial=correction.record.serial)
    applied = apply_correction(sensor, correction, datetime.now(UTC), arguments.insist)
    for warning in applied.warnings:
        print(f"Warning: {warning}", file=sys.stderr)
    return applied.sensor


def _named_sensor(arguments: argparse.Namespace) -> Sensor:
    from insole_core.recording.sensor_folder import read_sensor
    from insole_core.sensing.sensor import nominal_kinect

    if arguments.serial and arguments.sensor:
        raise UsageError("--serial and --sensor both name a sensor; give one of them.")
    if arguments.sensor:
        return read_sensor(arguments.sensor)
    if not arguments.serial:
        print(
            "No sensor is named (--serial or --sensor); the numbers that Burrus published for a "
            "Kinect v1 are used, whose depths are about 5 % less than those of a calibrated one.",
            file=sys.stderr,
        )
        return nominal_kinect("")
    sensor = store_of(arguments).load(arguments.serial)
    if sensor is None:
        known = ", ".join(store_of(arguments).serials()) or "none yet"
        raise UsageError(
            f"Sensor {arguments.serial} was never calibrated here (calibrated: {known}); calibrate "
            "it, or name its folder with --sensor."
        )
    return sensor


def add_rig_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the session that replaces the sensors, and the folder of stored calibrations."""
    add_emulate_argument(parser)
    add_store_argument(parser)


def add_emulate_argument(parser: argparse.ArgumentParser) -> None:
    """Add the recorded session that replaces the sensors."""
    parser.add_argument(
        "--emulate", type=Path, metavar="SESSION", default=argparse.SUPPRESS,
        help="play a recorded session as live sensors; no device is needed",
    )  # fmt: skip


def add_camera_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what can be set of RealSense cameras."""
    parser.add_argument(
        "--preset", choices=["high-accuracy", "high-density", _AS_IT_IS],
        help="how strictly RealSense cameras judge their own depth (as set in the window, else "
        "high-accuracy)",
    )  # fmt: skip
    parser.add_argument(
        "--laser-power", type=number, metavar="MW",
        help="of the projectors of RealSense cameras (as set in the window, else as it is)",
    )  # fmt: skip
    parser.add_argument(
        "--infrared-pair", action=argparse.BooleanOptionalAction,
        help="also record the infrared pictures, left and right, of RealSense cameras, which makes "
        "the foot finer (as set in the window, else not)",
    )  # fmt: skip


def with_camera_arguments(source: SensorSource, arguments: argparse.Namespace) -> SensorSource:
    """Return the sensors with what the arguments set of RealSense cameras."""
    from insole_studio.acquisition.messages import Preset, Tuning
    from insole_studio.acquisition.tunings import TUNING_FILE, Tunings
    from realsense_d400.settings import CameraSettings

    settings, file = CameraSettings(), None
    preset = None
    if arguments.preset == _AS_IT_IS:
        settings = replace(settings, preset=None)
    else:
        file = store_folder(arguments) / TUNING_FILE
        preset = Preset(arguments.preset) if arguments.preset else None
    asked = Tuning(preset, arguments.laser_power, arguments.infrared_pair)
    tunings = Tunings(file, asked)
    return replace(source, camera=settings, tunings=tunings)


def sensor_source_of(
    arguments: argparse.Namespace, system_file: Path | None = None
) -> SensorSource:
    """Return the sensor source that the arguments select.

    Parameters
    ----------
    system_file
        File of the reference system; None selects the bundled one.
    """
    from insole_studio.acquisition.sensor_source import SensorSource
    from insole_studio.acquisition.warm_up import WARM_UP_FILE

    warm_up_file = store_folder(arguments) / WARM_UP_FILE
    return SensorSource(store_of(arguments), arguments.emulate, system_file, warm_up_file)
