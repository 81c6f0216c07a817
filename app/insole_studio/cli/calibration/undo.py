"""``insole-studio calibrate undo``: a sensor as it was before its last step."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.sensor_arguments import add_store_argument, store_of

NAME = "undo"
HELP = "take back the last step of a sensor, also one that cannot be read; again, to redo it"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("--serial", required=True, help="of the sensor, from its label")
    add_store_argument(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Exchange the calibration of the sensor for the one before."""
    calibrated = store_of(arguments).undo(arguments.serial)
    print(
        f"The calibration of sensor {arguments.serial} from before its last step is in use again."
        if calibrated
        else f"Sensor {arguments.serial} counts as not calibrated, as before its first step."
    )
    progress.step(1.0, "Done: the same command takes this back")
