"""``insole-studio calibrate disparity``: raw number to mm, from walls at known distances."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.argument_parser import number
from insole_studio.cli.calibration.calibration_step import add_step_arguments, run_step

NAME = "disparity"
HELP = "raw number to mm, from captures of a wall at measured distances"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_step_arguments(parser, "a sub-folder of raw depth images for each wall, or one image each")
    parser.add_argument(
        "--distances", type=number, nargs="+", required=True, metavar="MM",
        help="to the wall at the image centre, one for each capture in the order of their names",
    )  # fmt: skip
    parser.add_argument("--model", choices=["linear-inverse", "tangent"], default="linear-inverse")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the walls, fit the model and save it."""
    from insole_core.workflows.calibration.wall_steps import calibrate_disparity_step, read_walls

    captures = read_walls(arguments.folder, arguments.distances, progress.part(0, 0.5))
    run_step(
        arguments,
        progress.part(0.5, 1),
        lambda sensor, part: calibrate_disparity_step(captures, sensor, arguments.model, part),
    )
