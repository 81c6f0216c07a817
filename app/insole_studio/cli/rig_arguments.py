"""Arguments that choose the sensors of a command."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from insole_studio.cli.sensor_arguments import add_store_argument, store_folder, store_of

if TYPE_CHECKING:
    from insole_studio.acquisition.sensor_source import SensorSource


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
