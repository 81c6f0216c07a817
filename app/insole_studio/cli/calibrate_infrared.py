"""``insole-studio calibrate infrared``: learn a device's own dot pattern, or check it by a wall."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import CalibrationError, UsageError
from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.sensor_arguments import add_store_argument, store_of

if TYPE_CHECKING:
    from insole_core.sensing.sensor import Sensor

NAME = "infrared"
HELP = "learn the dot pattern of a sensor from infrared pictures of flat walls, or check it"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "walls", type=Path, metavar="WALLS",
        help="holds infrared_00.png … and depth_00.png … of flat walls at 600 to 900 mm",
    )  # fmt: skip
    parser.add_argument(
        "--sensor", type=Path, required=True, metavar="sensor.json",
        help="the sensor's calibration, for example of a view of a session; or its folder",
    )  # fmt: skip
    parser.add_argument(
        "--out", action=OutputPath, metavar="reference.npz", help="write the pattern"
    )
    parser.add_argument(
        "--keep", action="store_true",
        help="keep the pattern with the calibration of the sensor; calibrate session puts it into "
        "the sessions of that sensor",
    )  # fmt: skip
    parser.add_argument(
        "--check", type=Path, metavar="reference.npz",
        help="write nothing; say by the first wall whether this pattern has drifted or changed. A "
        "shift along the rows that is the same on all of the wall stays unseen, as it moves the "
        "sensor's depth of the wall as well",
    )  # fmt: skip
    add_store_argument(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Learn the pattern and write it, or compare a wall with it."""
    if bool(arguments.out or arguments.keep) == bool(arguments.check):
        raise UsageError(
            "Give --out or --keep, to learn a pattern, or --check, to compare with one."
        )
    if arguments.out and arguments.out.suffix.lower() != ".npz":
        raise UsageError(f"--out is {arguments.out}, but the pattern is written as .npz.")
    (_check if arguments.check else _learn)(arguments, progress)


def _check(arguments: argparse.Namespace, progress: Progress) -> None:
    from insole_core.calibration.infrared.infrared_walls import read_infrared_walls
    from insole_core.calibration.infrared.learnt_reference import find_drift
    from insole_core.sensing.infrared_reference import load_reference

    sensor, shift_px = _sensor_of(arguments.sensor)
    reference = load_reference(arguments.check)
    (wall,) = read_infrared_walls(
        arguments.walls, sensor.serial, progress.part(0, 0.7), shift_px=shift_px, most=1
    )
    drift = find_drift(wall, sensor, reference)
    if drift.doubt:
        raise CalibrationError("{what}: {reason}", what=wall.depth.name, reason=drift.doubt)
    print(
        f"By {wall.depth.name} the pattern still holds: it has drifted by {drift.drift_px:.3f} px, "
        f"and the wall is like it ({drift.likeness:.2f}). A shift along the rows that is the same "
        f"on all of the wall cannot be seen."
    )
    progress.step(1.0, "Done: nothing was written")


def _learn(arguments: argparse.Namespace, progress: Progress) -> None:
    from insole_core.calibration.infrared.infrared_walls import read_infrared_walls
    from insole_core.calibration.infrared.learnt_reference import learn_reference
    from insole_core.files.transaction import Transaction

    sensor, shift_px = _sensor_of(arguments.sensor)
    store = store_of(arguments)
    if arguments.keep:
        store.check_known(sensor.serial)
    walls = read_infrared_walls(
        arguments.walls, sensor.serial, progress.part(0, 0.2), shift_px=shift_px
    )
    learnt = learn_reference(walls, sensor, progress.part(0.2, 0.95))
    with Transaction() as outputs:
        if arguments.out:
            learnt.reference.save(outputs.file(arguments.out))
        if arguments.keep:
            store.keep_reference(learnt.reference, outputs)
    figures = learnt.reference.record.figures
    print(
        f"{len(learnt.used)} of {len(walls)} walls were used, {figures['nearest_mm']:.0f} to "
        f"{figures['farthest_mm']:.0f} mm; {figures['covered_share']:.0%} of the pattern was seen "
        f"often enough."
    )
    print(f"The distortion leaves {figures['residual_raw'] / 8:.3f} px of the walls' shifts (rms).")
    for name, reason in learnt.left_out.items():
        print(f"Warning: {name} was left out: {reason}", file=sys.stderr)
    progress.step(1.0, f"Done: {arguments.out or 'the pattern is kept'}")


def _sensor_of(named: Path) -> tuple[Sensor, tuple[float, float]]:
    """Return the sensor of a sensor.json or of its folder, and the shift of its pictures."""
    from insole_core.json_object import JsonObject
    from insole_core.recording.sensor_folder import (
        SENSOR_FILE,
        folder_of_sensor,
        infrared_shift_px,
        read_sensor,
    )
    from insole_core.workflows.calibration.sensor_store import delivering_raw_numbers

    folder = folder_of_sensor(named)
    sensor = delivering_raw_numbers(read_sensor(folder))
    return sensor, infrared_shift_px(JsonObject.read(folder / SENSOR_FILE)) or (0.0, 0.0)
