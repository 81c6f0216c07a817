"""``insole-studio calibrate stereo``: the pose of the colour camera to the depth camera."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.board_arguments import add_board_arguments, board_of
from insole_studio.cli.calibration.calibration_step import add_step_arguments, run_step

NAME = "stereo"
HELP = "the colour camera beside the depth camera, from a board that both see"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_step_arguments(
        parser,
        "color_000 … of the board, and of the same positions ir_000 … (emitter covered) or "
        "depth_000.png … (raw depth)",
    )
    add_board_arguments(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Fit the pose between the cameras and save it."""
    board = board_of(arguments)
    from insole_core.workflows.calibration.stereo_steps import calibrate_stereo_step

    run_step(
        arguments,
        progress,
        lambda sensor, part: calibrate_stereo_step(arguments.folder, board, sensor, part),
    )
