"""Which sensors a command works with."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from insole_studio.cli.sensor_arguments import add_store_argument, store_of

if TYPE_CHECKING:
    from insole_studio.acquisition.sensor_source import SensorSource


def add_rig_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what takes the place of sensors, and where the stored calibrations are."""
    add_emulate_argument(parser)
    add_store_argument(parser)


def add_emulate_argument(parser: argparse.ArgumentParser) -> None:
    """Declare the recorded session that takes the place of sensors."""
    parser.add_argument(
        "--emulate", type=Path, metavar="SESSION", default=argparse.SUPPRESS,
        help="play a recorded session as live sensors; no device is needed",
    )  # fmt: skip


def sensor_source_of(
    arguments: argparse.Namespace, system_file: Path | None = None
) -> SensorSource:
    """Give the place of a call."""
    from insole_studio.acquisition.sensor_source import SensorSource

    return SensorSource(store_of(arguments), arguments.emulate, system_file)
