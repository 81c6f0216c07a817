"""``insole-studio calibrate distortion``: the distortion of the depth, from captures of walls."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from insole_core.progress import Progress
from insole_studio.cli.board_arguments import add_board_arguments, board_of
from insole_studio.cli.calibration.calibration_step import add_step_arguments, run_step

if TYPE_CHECKING:
    from insole_core.sensing.sensor import Sensor
    from insole_core.workflows.calibration.steps import StepResult

NAME = "distortion"
HELP = "the distortion of the depth, from captures of a flat wall at several distances"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_step_arguments(
        parser, "a sub-folder of raw depth images for each wall, or one image each; with --board, "
        "a colour picture color_000 of the board on the wall in each sub-folder",
    )  # fmt: skip
    add_board_arguments(parser, required=False)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the walls, fit the map and save it."""
    from insole_core.workflows.calibration.wall_steps import (
        calibrate_distortion_step,
        place_walls,
        read_walls,
    )

    board = None if arguments.board is None else board_of(arguments)
    captures = read_walls(arguments.folder, progress=progress.part(0, 0.5))

    def work(sensor: Sensor, part: Progress) -> StepResult:
        known = captures
        if board is not None:
            known = place_walls(captures, arguments.folder, board, sensor, part.part(0, 0.3))
        return calibrate_distortion_step(known, sensor, part.part(0.3, 1))

    run_step(arguments, progress.part(0.5, 1), work)
