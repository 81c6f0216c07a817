"""``insole-studio calibrate distortion``: the distortion of the depth, from captures of walls."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.commands.calibration.step import add_step_arguments, run_step

NAME = "distortion"
HELP = "the distortion of the depth, from captures of a flat wall at several distances"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    add_step_arguments(parser, "a sub-folder of raw depth images for each wall, or one image each")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the walls, fit the map, keep it."""
    from insole_studio.workbench.calibration_steps import calibrate_distortion_step, read_walls

    captures = read_walls(arguments.folder, progress=progress.part(0, 0.5))
    run_step(
        arguments,
        progress.part(0.5, 1),
        lambda sensor, part: calibrate_distortion_step(captures, sensor, part),
    )
