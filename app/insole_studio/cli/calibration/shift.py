"""``insole-studio calibrate shift``: map colour to depth by a constant shift (thesis 5.4)."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.board_arguments import add_board_arguments
from insole_studio.cli.calibration.calibration_step import add_step_arguments, run_step

NAME = "shift"
HELP = "colour on depth by a constant pixel shift, as the thesis did; stereo is better"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_step_arguments(
        parser, "color_000 … and ir_000 … of a board in the same positions, or is such a file of "
        "marked points as the manual describes",
    )  # fmt: skip
    add_board_arguments(parser, required=False)


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Detect or read the points, fit the shift and save it."""
    from insole_core.workflows.calibration.stereo_steps import shift_color_step
    from insole_studio.cli.correspondences import read_correspondences

    run_step(
        arguments,
        progress,
        lambda sensor, part: shift_color_step(
            read_correspondences(arguments, sensor, part), sensor
        ),
    )
