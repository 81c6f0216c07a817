"""``insole-studio sensors``: list the sensors that are plugged in, and whether they are usable."""

from __future__ import annotations

import argparse
import json
import sys
from typing import TYPE_CHECKING

from insole_core.progress import Progress
from insole_studio.cli.sensor_arguments import add_rig_arguments, sensor_source_of

if TYPE_CHECKING:
    from insole_studio.acquisition.messages import DetectedSensor

NAME = "sensors"
HELP = "list the sensors: a line each with serial number, model, USB bus, and state"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("--json", action="store_true", help="as JSON, for other programs")
    add_rig_arguments(parser)


def run(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Print one line for each sensor."""
    rig = sensor_source_of(arguments).rig()
    looked = rig.find()
    found = looked.sensors
    if arguments.json:
        print(json.dumps([_values(sensor) for sensor in found], indent=1))
    for sensor in () if arguments.json else found:
        print(
            sensor.serial or "-", sensor.model or "-", f"bus {sensor.bus}", _state(sensor), sep="\t"
        )
    for problem in looked.problems:
        print(f"Warning: {problem}", file=sys.stderr)
    rig.require()


def _state(sensor: DetectedSensor) -> str:
    return sensor.problem or "ready"


def _values(sensor: DetectedSensor) -> dict[str, object]:
    return {
        "serial": sensor.serial,
        "model": sensor.model,
        "bus": sensor.bus,
        "place": sensor.place,
        "state": "ready" if sensor.problem is None else "unusable",
        "problem": sensor.problem,
    }
