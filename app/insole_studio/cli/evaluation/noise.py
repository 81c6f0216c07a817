"""``insole-studio evaluate noise``: noise of single frames, and drift during warm-up."""

from __future__ import annotations

import argparse

from insole_core.progress import Progress
from insole_studio.cli.argument_parser import number
from insole_studio.cli.evaluation.arguments import add_evaluation_arguments
from insole_studio.cli.report_arguments import check_reports, conclude
from insole_studio.cli.sensor_arguments import evaluated_sensor

NAME = "noise"
HELP = "noise of single frames of a still scene, and drift while the sensor warms up"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_evaluation_arguments(parser, "the raw depth images of a still scene, in order of time")
    parser.add_argument(
        "--every", type=number, metavar="SECONDS",
        help="time from one image to the next: also follow the warm-up",
    )  # fmt: skip


def run(arguments: argparse.Namespace, progress: Progress) -> None:
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
