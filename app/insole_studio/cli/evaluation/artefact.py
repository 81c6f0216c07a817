"""``insole-studio evaluate artefact``: acceptance test with two spheres and a plate."""

from __future__ import annotations

import argparse

from insole_core.errors import InputError
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import number
from insole_studio.cli.evaluation.arguments import add_evaluation_arguments
from insole_studio.cli.report_arguments import check_reports, conclude
from insole_studio.cli.sensor_arguments import evaluated_sensor

NAME = "artefact"
HELP = "acceptance with a bar of two spheres and a plate, in the manner of VDI/VDE 2634"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_evaluation_arguments(
        parser,
        "bar_000 … and plate_000 …, each a sub-folder of raw depth images or one image",
        judged_by_default=True,
    )
    parser.add_argument(
        "--diameter", type=number, required=True, metavar="MM", help="true diameter of the spheres"
    )
    parser.add_argument(
        "--spacing", type=number, required=True, metavar="MM", help="true distance of their centres"
    )


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Detect spheres and plates, measure them, and check the limits."""
    check_reports(arguments)
    from insole_core.calibration.walls.captures import read_captures
    from insole_core.evaluation.artefact import evaluate_artefact
    from insole_core.evaluation.artefact_points import plate_points, sphere_points
    from insole_core.evaluation.evaluation_sections import artefact_section
    from insole_core.workflows.calibration.wall_steps import check_recorded_with

    sensor = evaluated_sensor(arguments)
    captures = read_captures(arguments.folder, progress.part(0, 0.6))
    unknown = [c.name for c in captures if not c.name.startswith(("bar", "plate"))]
    if unknown:
        raise InputError(
            f"{unknown[0]} in {arguments.folder} is neither a bar nor a plate; name the captures "
            "bar_000 … and plate_000 …."
        )
    check_recorded_with(sensor.serial, captures)
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
