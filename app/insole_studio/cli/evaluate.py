"""``insole-studio evaluate``: measure a sensor's accuracy and check it against limits."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from typing import TYPE_CHECKING

from insole_core.errors import InputError
from insole_core.progress import Progress
from insole_studio.cli import (
    evaluate_chain,
    evaluate_object,
    evaluate_reference_foot,
    evaluate_repeat,
)
from insole_studio.cli.argument_parser import Command, Step, add_steps, positive
from insole_studio.cli.board_arguments import add_board_arguments, read_correspondences
from insole_studio.cli.report_arguments import add_evaluation_arguments, check_reports, conclude
from insole_studio.cli.sensor_arguments import evaluated_lattice, evaluated_sensor

if TYPE_CHECKING:
    from insole_core.calibration.walls.captures import WallCapture
    from insole_core.evaluation.report import ReportSection
    from insole_core.evaluation.wall import Correction
    from insole_core.sensing.sensor import Sensor

NAME = "evaluate"
HELP = "evaluate a sensor from folders of images; a limit that is not kept is exit code 1"


def _add_wall_arguments(parser: argparse.ArgumentParser) -> None:
    add_evaluation_arguments(
        parser, "a sub-folder of raw depth images for each wall, or one image each"
    )
    parser.add_argument(
        "--leave-one-out", action="store_true",
        help="correct each wall by a map made from the other walls of the folder: raw, the two "
        "algorithms of the thesis, and the default",
    )  # fmt: skip


def _run_wall(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the walls, measure them, and check the limits."""
    check_reports(arguments)
    from insole_core.workflows.calibration.wall_steps import (
        check_lattice,
        check_recorded_with,
        read_walls,
    )

    sensor = evaluated_lattice(arguments)
    captures = read_walls(arguments.folder, progress=progress.part(0, 0.4))
    check_recorded_with(sensor.serial, captures)
    check_lattice(captures, sensor)
    measure = _leave_one_out if arguments.leave_one_out else _before_and_after
    section = measure(captures, sensor, progress.part(0.4, 0.9))
    progress.step(0.9, "Writing the report")
    conclude(section, sensor.serial, arguments)


def _leave_one_out(
    captures: list[WallCapture], sensor: Sensor, progress: Progress
) -> ReportSection:
    from insole_core.evaluation.evaluation_sections import wall_section
    from insole_core.evaluation.wall import leave_one_out

    section = wall_section(leave_one_out(captures, sensor.depth_camera, sensor.disparity, progress))
    return replace(section, title="Error of a flat wall, each corrected from the others")


def _before_and_after(
    captures: list[WallCapture], sensor: Sensor, progress: Progress
) -> ReportSection:
    from insole_core.evaluation.evaluation_sections import wall_section
    from insole_core.evaluation.wall import NoCorrection, wall_errors, wall_pictures

    progress.step(0.0, "Measuring the walls")
    corrections: dict[str, Correction] = {"raw": NoCorrection()}
    if sensor.correction is not None:
        corrections["corrected"] = sensor.correction
    else:
        print(
            "The distortion of this sensor was not calibrated yet; only the raw error is measured.",
            file=sys.stderr,
        )
    camera, disparity = sensor.depth_camera, sensor.disparity
    section = wall_section(wall_errors(captures, corrections, camera, disparity))
    pictures = wall_pictures(captures, corrections, camera, disparity)
    return replace(section, plots=section.plots + pictures)


WALL = Step(
    "wall",
    "error of a flat wall over distance, before and after correction (thesis figure 11)",
    _add_wall_arguments,
    _run_wall,
)


def _add_resolution_arguments(parser: argparse.ArgumentParser) -> None:
    add_evaluation_arguments(
        parser, "a sub-folder of raw depth images for each wall, or one image each"
    )


def _run_resolution(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the walls, measure them, and check the limits."""
    check_reports(arguments)
    from insole_core.evaluation.evaluation_sections import resolution_section
    from insole_core.evaluation.resolution import evaluate_resolution
    from insole_core.workflows.calibration.wall_steps import (
        check_lattice,
        check_recorded_with,
        read_walls,
    )

    sensor = evaluated_lattice(arguments)
    captures = read_walls(arguments.folder, progress=progress.part(0, 0.8))
    check_recorded_with(sensor.serial, captures)
    check_lattice(captures, sensor)
    progress.step(0.8, "Measuring the resolution")
    section = resolution_section(
        [evaluate_resolution(one, sensor.depth_camera, sensor.disparity) for one in captures]
    )
    conclude(section, sensor.serial, arguments)


RESOLUTION = Step(
    "resolution",
    "spatial and depth resolution over distance, against theory (thesis figures 13, 14)",
    _add_resolution_arguments,
    _run_resolution,
)


def _add_alignment_arguments(parser: argparse.ArgumentParser) -> None:
    add_evaluation_arguments(
        parser, "color_000 … and ir_000 … of a board in the same positions, or is such a file of "
        "marked points as the manual describes",
    )  # fmt: skip
    add_board_arguments(parser, required=False)


def _run_alignment(arguments: argparse.Namespace, progress: Progress) -> None:
    """Detect or read the points, measure, and check the limits."""
    check_reports(arguments)
    from insole_core.evaluation.alignment import evaluate_alignment
    from insole_core.evaluation.evaluation_sections import alignment_section

    sensor = evaluated_sensor(arguments)
    points = read_correspondences(arguments, sensor, progress.part(0, 0.9))
    progress.step(0.9, "Measuring the misalignment")
    section = alignment_section(evaluate_alignment(sensor, points))
    conclude(section, sensor.serial, arguments)


ALIGNMENT = Step(
    "alignment",
    "misalignment of colour and depth at several distances (thesis table 2)",
    _add_alignment_arguments,
    _run_alignment,
)


def _add_artefact_arguments(parser: argparse.ArgumentParser) -> None:
    add_evaluation_arguments(
        parser,
        "bar_000 … and plate_000 …, each a sub-folder of raw depth images or one image",
        judged_by_default=True,
    )
    parser.add_argument(
        "--diameter",
        type=positive,
        required=True,
        metavar="MM",
        help="true diameter of the spheres",
    )
    parser.add_argument(
        "--spacing",
        type=positive,
        required=True,
        metavar="MM",
        help="true distance of their centres",
    )


def _run_artefact(arguments: argparse.Namespace, progress: Progress) -> None:
    """Detect spheres and plates, measure them, and check the limits."""
    check_reports(arguments)
    from insole_core.calibration.walls.captures import read_captures
    from insole_core.evaluation.artefact import evaluate_artefact, plate_points, sphere_points
    from insole_core.evaluation.evaluation_sections import artefact_section
    from insole_core.workflows.calibration.wall_steps import check_lattice, check_recorded_with

    sensor = evaluated_lattice(arguments)
    captures = read_captures(arguments.folder, progress.part(0, 0.6))
    unknown = [c.name for c in captures if not c.name.startswith(("bar", "plate"))]
    if unknown:
        raise InputError(
            f"{unknown[0]} in {arguments.folder} is neither a bar nor a plate; name the captures "
            "bar_000 … and plate_000 …."
        )
    check_recorded_with(sensor.serial, captures)
    check_lattice(captures, sensor)
    progress.step(0.6, "Measuring spheres and plates")
    pairs = [
        sphere_points(one, sensor, arguments.diameter)
        for one in captures
        if one.name.startswith("bar")
    ]
    plates = [plate_points(one, sensor) for one in captures if one.name.startswith("plate")]
    section = artefact_section(
        evaluate_artefact(pairs, plates, arguments.diameter, arguments.spacing)
    )
    conclude(section, sensor.serial, arguments)


ARTEFACT = Step(
    "artefact",
    "acceptance with a bar of two spheres and a plate, in the manner of VDI/VDE 2634",
    _add_artefact_arguments,
    _run_artefact,
)


def _add_noise_arguments(parser: argparse.ArgumentParser) -> None:
    add_evaluation_arguments(parser, "the raw depth images of a still scene, in order of time")
    parser.add_argument(
        "--every", type=positive, metavar="SECONDS",
        help="time from one image to the next: also follow the warm-up",
    )  # fmt: skip


def _run_noise(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read the frames once, measure, and check the limits."""
    check_reports(arguments)
    from insole_core.calibration.walls.captures import read_frames
    from insole_core.evaluation.evaluation_sections import noise_section
    from insole_core.evaluation.noise import measure_noise, measure_warm_up
    from insole_core.workflows.calibration.steps import depth_images

    sensor = evaluated_sensor(arguments)
    paths = depth_images(arguments.folder)
    progress.step(0.0, f"Measuring the noise of {len(paths)} frames")
    noise = measure_noise(read_frames(paths), sensor.disparity)
    warm_up = None
    if arguments.every is not None:
        progress.step(0.5, "Following the warm-up")
        moments = ((i * arguments.every, frame) for i, frame in enumerate(read_frames(paths)))
        warm_up = measure_warm_up(moments, sensor.disparity)
    conclude(noise_section(noise, warm_up), sensor.serial, arguments)


NOISE = Step(
    "noise",
    "noise of single frames of a still scene, and drift while the sensor warms up",
    _add_noise_arguments,
    _run_noise,
)


KINDS: tuple[Command, ...] = (
    WALL,
    RESOLUTION,
    ALIGNMENT,
    evaluate_object,
    ARTEFACT,
    NOISE,
    evaluate_reference_foot,
    evaluate_chain,
    evaluate_repeat,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the kinds of evaluation."""
    add_steps(parser, KINDS, "KIND")


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Run the chosen evaluation."""
    arguments.step.run(arguments, progress)
