"""``insole-studio calibrate infrared``: learn a device's own dot pattern, or check it by a wall."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from insole_core.errors import CalibrationError, UsageError
from insole_core.progress import Progress
from insole_studio.cli.path_arguments import OutputPath

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
        help="the sensor's calibration, for example of a view of a session",
    )  # fmt: skip
    parser.add_argument(
        "--out", action=OutputPath, metavar="reference.npz", help="write the pattern"
    )
    parser.add_argument(
        "--check", type=Path, metavar="reference.npz",
        help="write nothing; say whether this pattern has drifted, by one wall",
    )  # fmt: skip


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Learn the pattern and write it, or compare a wall with it."""
    if (arguments.out is None) == (arguments.check is None):
        raise UsageError("Give either --out, to learn a pattern, or --check, to compare with one.")
    if arguments.out and arguments.out.suffix.lower() != ".npz":
        raise UsageError(f"--out is {arguments.out}, but the pattern is written as .npz.")
    from insole_core.calibration.infrared.infrared_walls import read_infrared_walls
    from insole_core.calibration.infrared.learnt_reference import find_drift, learn_reference
    from insole_core.recording.sensor_folder import SENSOR_FILE, read_sensor
    from insole_core.sensing.infrared_reference import load_reference
    from insole_core.workflows.calibration.sensor_store import delivering_raw_numbers

    named: Path = arguments.sensor
    folder = named.parent if named.name == SENSOR_FILE else named
    sensor = delivering_raw_numbers(read_sensor(folder))
    if arguments.check:
        reference = load_reference(arguments.check)
        wall = read_infrared_walls(arguments.walls, sensor.serial, progress.part(0, 0.7))[0]
        drift = find_drift(wall, sensor, reference)
        if drift.doubt:
            raise CalibrationError(drift.doubt)
        print(
            f"The pattern still holds: it has drifted by {drift.shift_px:.3f} px, and the wall is "
            f"like it ({drift.likeness:.2f})."
        )
        progress.step(1.0, "Done: nothing was written")
        return
    walls = read_infrared_walls(arguments.walls, sensor.serial, progress.part(0, 0.2))
    learnt = learn_reference(walls, sensor, progress.part(0.2, 0.95))
    learnt.reference.save(arguments.out)
    figures = learnt.reference.record.figures
    print(
        f"{len(learnt.used)} of {len(walls)} walls were used, {figures['nearest_mm']:.0f} to "
        f"{figures['farthest_mm']:.0f} mm; {figures['covered_share']:.0%} of the pattern was seen "
        f"often enough."
    )
    print(f"The distortion leaves {figures['residual_raw'] / 8:.3f} px of the walls' shifts (rms).")
    for name, reason in learnt.left_out.items():
        print(f"Warning: {name} was left out: {reason}", file=sys.stderr)
    progress.step(1.0, f"Done: {arguments.out}")
