"""``insole-studio calibrate``: calibrate a new sensor, step by step."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from insole_core.progress import Progress
from insole_studio.cli import calibrate_infrared, calibrate_reference
from insole_studio.cli.argument_parser import Command, Step, add_steps, number
from insole_studio.cli.board_arguments import add_board_arguments, board_of, read_correspondences
from insole_studio.cli.path_arguments import OutputPath
from insole_studio.cli.report_arguments import add_report_argument, check_reports
from insole_studio.cli.sensor_arguments import add_store_argument, store_of

if TYPE_CHECKING:
    from insole_core.calibration.boards.intrinsics import IntrinsicsOptions
    from insole_core.calibration.walls.captures import WallCapture
    from insole_core.sensing.sensor import Sensor
    from insole_core.workflows.calibration.steps import StepResult

NAME = "calibrate"
HELP = "calibrate a sensor, or measure a reference system, from folders of images"


def _add_step_arguments(parser: argparse.ArgumentParser, holds: str) -> None:
    """Add the folder of images, the sensor and the reports.

    Parameters
    ----------
    holds
        Help text: what the folder contains.
    """
    parser.add_argument("folder", type=Path, metavar="FOLDER", help=f"holds {holds}")
    parser.add_argument("--serial", required=True, help="of the sensor, from its label")
    parser.add_argument(
        "--insist", action="store_true",
        help="save a result that does not fit a Kinect all the same; calibrate undo takes it back",
    )  # fmt: skip
    add_store_argument(parser)
    add_report_argument(parser)


def _run_step(
    arguments: argparse.Namespace,
    progress: Progress,
    work: Callable[[Sensor, Progress], StepResult],
    captures: Sequence[WallCapture] = (),
) -> None:
    """Load the sensor, improve its calibration, and save it with its reports.

    Parameters
    ----------
    work
        Fits the step's part of the calibration of the sensor as known so far.
    captures
        Walls, where these suffice to calibrate the sensor that took them.

    Raises
    ------
    InsoleError
    """
    from insole_core.errors import CalibrationError
    from insole_core.workflows.calibration.report_files import keep_step
    from insole_core.workflows.calibration.sensor_store import (
        delivering_raw_numbers,
        measuring_disparity,
    )
    from insole_core.workflows.calibration.wall_steps import starting_sensor

    check_reports(arguments)
    store = store_of(arguments)
    known = starting_sensor(store, arguments.serial, captures)
    (measuring_disparity if captures else delivering_raw_numbers)(known)
    result = work(known, progress.part(0, 0.9))
    if result.doubt and not arguments.insist:
        raise CalibrationError(
            f"Nothing was saved: {_clause(result.doubt)}, or add --insist to save it all the same."
        )
    progress.step(0.9, "Writing the calibration and its reports")
    folder = keep_step(result, store, arguments.report)
    for sentence in result.sentences:
        print(sentence)
    for sentence in filter(None, (result.doubt, *result.warnings)):
        print(f"Warning: {sentence}", file=sys.stderr)
    for sentence in result.advice:
        print(f"Advice: {sentence}", file=sys.stderr)
    progress.step(1.0, f"Done: {folder}")


def _clause(sentence: str) -> str:
    return sentence[:1].lower() + sentence[1:].removesuffix(".")


def _add_lens_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the parameters that are fixed by default."""
    parser.add_argument("--fit-k3", action="store_true", help="free the sixth order of the lens")
    parser.add_argument("--fit-skew", action="store_true", help="free the skew of the axes")


def options_of(arguments: argparse.Namespace) -> IntrinsicsOptions:
    """Return the options that the arguments select."""
    from insole_core.calibration.boards.intrinsics import IntrinsicsOptions

    return IntrinsicsOptions(fit_k3=arguments.fit_k3, fit_skew=arguments.fit_skew)


@dataclass
class _CameraStep:
    """The step for one camera: its name and help, and what its folder contains."""

    NAME: str
    HELP: str
    which: Literal["color", "depth"]
    holds: str

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Add the arguments."""
        _add_step_arguments(parser, self.holds)
        add_board_arguments(parser)
        _add_lens_arguments(parser)

    def run(self, arguments: argparse.Namespace, progress: Progress) -> None:
        """Detect the boards, fit the camera and save it."""
        board, options = board_of(arguments), options_of(arguments)
        from insole_core.workflows.calibration.board_steps import calibrate_camera_step

        _run_step(
            arguments,
            progress,
            lambda sensor, part: calibrate_camera_step(
                self.which, arguments.folder, board, sensor, options=options, progress=part
            ),
        )


COLOR = _CameraStep(
    "color",
    "intrinsics and lens of the colour camera, from pictures of a board",
    "color",
    "colour pictures of the board (color_*, or all pictures)",
)
DEPTH = _CameraStep(
    "depth",
    "intrinsics and lens of the depth camera, from infrared pictures of a board (emitter covered)",
    "depth",
    "infrared pictures of the board (ir_*, or all pictures)",
)


def _add_distortion_arguments(parser: argparse.ArgumentParser) -> None:
    _add_step_arguments(
        parser, "a sub-folder of depth images for each wall, or one image each; with --board, "
        "a colour picture color_000 of the board on the wall in each sub-folder",
    )  # fmt: skip
    add_board_arguments(parser, required=False)


def _run_distortion(arguments: argparse.Namespace, progress: Progress) -> None:
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

    _run_step(arguments, progress.part(0.5, 1), work, captures)


DISTORTION = Step(
    "distortion",
    "the distortion of the depth, from captures of a flat wall at several distances",
    _add_distortion_arguments,
    _run_distortion,
)


def _add_stereo_arguments(parser: argparse.ArgumentParser) -> None:
    _add_step_arguments(
        parser,
        "color_000 … of the board, and of the same positions ir_000 … (emitter covered) or "
        "depth_000.png … (raw depth)",
    )
    add_board_arguments(parser)


def _run_stereo(arguments: argparse.Namespace, progress: Progress) -> None:
    """Fit the pose between the cameras and save it."""
    board = board_of(arguments)
    from insole_core.workflows.calibration.board_steps import calibrate_stereo_step

    _run_step(
        arguments,
        progress,
        lambda sensor, part: calibrate_stereo_step(arguments.folder, board, sensor, part),
    )


STEREO = Step(
    "stereo",
    "the colour camera beside the depth camera, from a board that both see",
    _add_stereo_arguments,
    _run_stereo,
)


def _add_shift_arguments(parser: argparse.ArgumentParser) -> None:
    _add_step_arguments(
        parser, "color_000 … and ir_000 … of a board in the same positions, or is such a file of "
        "marked points as the manual describes",
    )  # fmt: skip
    add_board_arguments(parser, required=False)


def _run_shift(arguments: argparse.Namespace, progress: Progress) -> None:
    """Detect or read the points, fit the shift and save it."""
    from insole_core.workflows.calibration.board_steps import shift_color_step

    _run_step(
        arguments,
        progress,
        lambda sensor, part: shift_color_step(
            read_correspondences(arguments, sensor, part), sensor
        ),
    )


SHIFT = Step(
    "shift",
    "colour on depth by a constant pixel shift, as the thesis did; stereo is better",
    _add_shift_arguments,
    _run_shift,
)


def _add_disparity_arguments(parser: argparse.ArgumentParser) -> None:
    _add_step_arguments(parser, "a sub-folder of raw depth images for each wall, or one image each")
    parser.add_argument(
        "--distances", type=number, nargs="+", required=True, metavar="MM",
        help="to the wall at the image centre, one for each capture in the order of their names",
    )  # fmt: skip
    parser.add_argument("--model", choices=["linear-inverse", "tangent"], default="linear-inverse")


def _run_disparity(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the walls, fit the model and save it."""
    from insole_core.workflows.calibration.wall_steps import calibrate_disparity_step, read_walls

    captures = read_walls(arguments.folder, arguments.distances, progress.part(0, 0.5))
    _run_step(
        arguments,
        progress.part(0.5, 1),
        lambda sensor, part: calibrate_disparity_step(captures, sensor, arguments.model, part),
    )


DISPARITY = Step(
    "disparity",
    "raw number to mm, from captures of a wall at measured distances",
    _add_disparity_arguments,
    _run_disparity,
)


def _add_undo_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--serial", required=True, help="of the sensor, from its label")
    add_store_argument(parser)


def _run_undo(arguments: argparse.Namespace, progress: Progress) -> None:
    """Exchange the calibration of the sensor for the one before."""
    calibrated = store_of(arguments).undo(arguments.serial)
    print(
        f"The calibration of sensor {arguments.serial} from before its last step is in use again."
        if calibrated
        else f"Sensor {arguments.serial} counts as not calibrated, as before its first step."
    )
    progress.step(1.0, "Done: the same command takes this back")


UNDO = Step(
    "undo",
    "take back the last step of a sensor, also one that cannot be read; again, to redo it",
    _add_undo_arguments,
    _run_undo,
)


def _add_session_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("session", type=Path, metavar="SESSION", help="folder or .zip")
    parser.add_argument("--out", action=OutputPath, required=True, metavar="SESSION")
    parser.add_argument(
        "--correction", type=Path, metavar="correction.npz",
        help="use this distortion correction for all views instead",
    )  # fmt: skip
    parser.add_argument(
        "--insist", action="store_true", help="use a correction of another sensor all the same"
    )
    add_store_argument(parser)


def _run_session(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the session, calibrate it and write it."""
    from insole_core.recording.reader import read_session
    from insole_core.recording.writer import check_session_target, write_session
    from insole_core.sensing.correction import load_correction
    from insole_core.workflows.calibration.calibrated_session import calibrated_session

    check_session_target(arguments.out)
    progress.step(0.0, "Reading the session")
    session = read_session(arguments.session)
    corrects = arguments.correction and any(v.sensor.depth_unit_mm is None for v in session.views)
    correction = load_correction(arguments.correction) if corrects else None
    calibrated, warnings = calibrated_session(
        session, store_of(arguments), correction, arguments.insist
    )
    for warning in warnings:
        print(f"Warning: {warning}", file=sys.stderr)
    write_session(calibrated, arguments.out, progress=progress.part(0.1, 1.0))
    progress.step(1.0, f"Done: {arguments.out}")


SESSION = Step(
    "session",
    "write a copy of a session whose sensors are calibrated as they are kept here",
    _add_session_arguments,
    _run_session,
)


STEPS: tuple[Command, ...] = (
    COLOR,
    DISTORTION,
    DEPTH,
    STEREO,
    SHIFT,
    DISPARITY,
    calibrate_infrared,
    UNDO,
    calibrate_reference,
    SESSION,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the steps, in the order in which a technician performs them."""
    add_steps(parser, STEPS, "STEP")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Run the chosen step."""
    arguments.step.run(arguments, progress)
