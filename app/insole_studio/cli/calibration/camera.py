"""``insole-studio calibrate color`` and ``depth``: intrinsics and lens of one camera."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from typing import Literal

from insole_core.progress import Progress
from insole_studio.cli.board_arguments import add_board_arguments, board_of
from insole_studio.cli.calibration.calibration_step import add_step_arguments, run_step
from insole_studio.cli.calibration.lens_arguments import add_lens_arguments, options_of


@dataclass
class CameraStep:
    """The step for one camera: its name and help, and what its folder contains."""

    NAME: str
    HELP: str
    which: Literal["color", "depth"]
    holds: str

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Add the arguments."""
        add_step_arguments(parser, self.holds)
        add_board_arguments(parser)
        add_lens_arguments(parser)

    def run(self, arguments: argparse.Namespace, progress: Progress) -> None:
        """Detect the boards, fit the camera and save it."""
        board, options = board_of(arguments), options_of(arguments)
        from insole_core.workflows.calibration.camera_step import calibrate_camera_step

        run_step(
            arguments,
            progress,
            lambda sensor, part: calibrate_camera_step(
                self.which, arguments.folder, board, sensor, options=options, progress=part
            ),
        )


COLOR = CameraStep(
    "color",
    "intrinsics and lens of the colour camera, from pictures of a board",
    "color",
    "colour pictures of the board (color_*, or all pictures)",
)
DEPTH = CameraStep(
    "depth",
    "intrinsics and lens of the depth camera, from infrared pictures of a board (emitter covered)",
    "depth",
    "infrared pictures of the board (ir_*, or all pictures)",
)
