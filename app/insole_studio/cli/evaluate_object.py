"""``insole-studio evaluate object``: distances between points of a known object."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_core.visible_text import visible_line
from insole_studio.cli.board_arguments import add_board_arguments, board_of
from insole_studio.cli.report_arguments import add_evaluation_arguments, check_reports, conclude
from insole_studio.cli.sensor_arguments import evaluated_sensor

if TYPE_CHECKING:
    from insole_core.evaluation.color_points import ObjectPoints
    from insole_core.evaluation.distances import DistanceError, ObjectEvaluation
    from insole_core.sensing.sensor import Sensor

NAME = "object"
HELP = "distances between points of a known object against their true values (thesis 5.5)"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_evaluation_arguments(
        parser, "color_000 … and depth_000.png … of a board or of an object with coloured "
        "spots, which are found; or, with marked --points, the raw depth images of the object",
    )  # fmt: skip
    add_board_arguments(parser, required=False)
    parser.add_argument(
        "--points", type=Path, metavar="points.json",
        help="the true positions of the points, and where they are marked in the image; without "
        "marks they are coloured spots",
    )  # fmt: skip
    parser.add_argument(
        "--paint", choices=["blue", "red", "green"], default="blue", help="of the spots"
    )


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Detect or read the points, measure their distances, and check the limits."""
    check_reports(arguments)
    if (arguments.board is None) == (arguments.points is None):
        raise UsageError(
            "Name the known object: --board and --square for a board, or --points for a file of "
            "marked points."
        )
    from insole_core.evaluation.evaluation_sections import object_section

    sensor = evaluated_sensor(arguments)
    measure = _measure_points if arguments.board is None else _measure_boards
    section = object_section(measure(arguments, sensor, progress.part(0, 0.9)))
    progress.step(0.9, "Writing the report")
    conclude(section, sensor.serial, arguments)


def _measure_boards(
    arguments: argparse.Namespace, sensor: Sensor, progress: Progress
) -> ObjectEvaluation:
    from insole_core.calibration.boards.boards_in_depth import read_boards_in_depth
    from insole_core.calibration.boards.intrinsics import find_boards
    from insole_core.evaluation.distances import evaluate_boards
    from insole_core.workflows.calibration.steps import (
        COLOR,
        board_pictures,
        check_color_camera,
    )

    board = board_of(arguments)
    pictures = board_pictures(arguments.folder, COLOR)
    sightings, _ = find_boards(pictures, board, progress.part(0, 0.7))
    check_color_camera(sensor, sightings)
    boards = read_boards_in_depth(arguments.folder, sightings, sensor.correction)
    progress.step(0.7, "Measuring the corners")
    return evaluate_boards(sensor, boards)


def _measure_points(
    arguments: argparse.Namespace, sensor: Sensor, progress: Progress
) -> ObjectEvaluation:
    from insole_core.calibration.walls.captures import capture_from_frames, read_frames
    from insole_core.evaluation.color_points import load_object_points
    from insole_core.evaluation.distances import evaluate_object
    from insole_core.workflows.calibration.steps import depth_images

    points = load_object_points(arguments.points)
    if points.pixels is None:
        return _measure_spots(arguments, sensor, points, progress)
    progress.step(0.1, "Reading the depth images")
    paths = depth_images(arguments.folder)
    raw = capture_from_frames(arguments.folder.name, read_frames(paths)).raw
    measured = points.measured_mm(sensor, sensor.depth_mm(raw))
    return evaluate_object(points.names, points.true_mm, measured)


def _measure_spots(
    arguments: argparse.Namespace, sensor: Sensor, points: ObjectPoints, progress: Progress
) -> ObjectEvaluation:
    """Detect the spots in every position of the object; skip positions without them."""
    from insole_core.calibration.boards.board import read_color
    from insole_core.calibration.boards.boards_in_depth import read_depth_beside
    from insole_core.errors import CalibrationError
    from insole_core.evaluation.color_points import measure_spots
    from insole_core.evaluation.distances import evaluate_object, summarise
    from insole_core.workflows.calibration.steps import COLOR, board_pictures

    distances: list[DistanceError] = []
    pictures = board_pictures(arguments.folder, COLOR)
    for done, path in enumerate(pictures):
        progress.step(done / len(pictures), f"Finding the spots in {path.name}")
        depth_mm = sensor.depth_mm(read_depth_beside(arguments.folder, path.name))
        try:
            measured = measure_spots(
                sensor,
                depth_mm,
                read_color(path),
                points.names,
                points.true_mm,
                paint=arguments.paint,
            )
        except CalibrationError as error:
            print(visible_line(f"Warning: {path.name} is left out: {error}."), file=sys.stderr)
            continue
        names = [f"{path.stem}:{name}" for name in points.names]
        distances += evaluate_object(names, points.true_mm, measured).distances
    if not distances:
        raise CalibrationError(
            f"No picture of {arguments.folder} shows the {arguments.paint} spots of the object; "
            "show it whole and well lit, and check its list of points and their --paint."
        )
    return summarise(distances)
