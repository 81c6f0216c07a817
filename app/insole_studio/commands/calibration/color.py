"""``insole-studio calibrate color``: intrinsics and lens of the colour camera."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.commands.board_arguments import add_board_arguments, board_of
from insole_studio.commands.calibration.lens_arguments import add_lens_arguments, options_of
from insole_studio.commands.calibration.step import add_step_arguments, run_step

NAME = "color"
HELP = "intrinsics and lens of the colour camera, from pictures of a board"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    add_step_arguments(parser, "colour pictures of the board (color_*, or all pictures)")
    add_board_arguments(parser)
    add_lens_arguments(parser)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Find the boards, fit the camera, keep it."""
    board, options = board_of(arguments), options_of(arguments)
    from insole_studio.workbench.calibration_steps import calibrate_color_step

    run_step(
        arguments,
        progress,
        lambda sensor, part: calibrate_color_step(arguments.folder, board, sensor, options, part),
    )
