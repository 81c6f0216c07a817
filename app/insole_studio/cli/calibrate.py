"""``insole-studio calibrate``: calibrate a new sensor."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.calibration import (
    camera,
    disparity,
    distortion,
    reference,
    session,
    shift,
    stereo,
    undo,
)
from insole_studio.cli.subcommands import Command, add_steps

NAME = "calibrate"
HELP = "calibrate a sensor, or measure a reference system, from folders of images"
STEPS: tuple[Command, ...] = (
    camera.COLOR,
    distortion,
    camera.DEPTH,
    stereo,
    shift,
    disparity,
    undo,
    reference,
    session,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the steps, in the order in which a technician performs them."""
    add_steps(parser, STEPS, "STEP")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Run the chosen step."""
    arguments.step.run(arguments, progress)
