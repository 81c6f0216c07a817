"""Arguments that describe the calibration board in the pictures, and the points seen of it."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import number

if TYPE_CHECKING:
    from insole_core.calibration.boards.board import Board
    from insole_core.evaluation.alignment import Correspondence
    from insole_core.sensing.sensor import Sensor

_SIZE = re.compile(r"(\d{1,3})[x×](\d{1,3})")


def add_board_arguments(parser: argparse.ArgumentParser, required: bool = True) -> None:
    """Add the arguments that describe the board.

    Parameters
    ----------
    required
        Whether the board must be described.
    """
    parser.add_argument(
        "--board", required=required, metavar="10x7",
        help="inner corners of the chequerboard, a row has one less than squares; "
        "squares of a ChArUco board",
    )  # fmt: skip
    parser.add_argument(
        "--square", type=number, required=required, metavar="MM", help="side of one square"
    )
    parser.add_argument(
        "--marker", type=number, metavar="MM", help="side of a marker: it is a ChArUco board"
    )
    parser.add_argument(
        "--dictionary", default="DICT_5X5_250", help="of the ChArUco markers (DICT_5X5_250)"
    )


def board_of(arguments: argparse.Namespace) -> Board:
    """Return the board that the arguments describe.

    Raises
    ------
    UsageError
        When its size cannot be parsed, or is impossible.
    """
    from insole_core.calibration.boards.board import Charuco, Chequerboard

    size = _SIZE.fullmatch(arguments.board)
    if size is None:
        raise UsageError(f'--board is "{arguments.board}"; give columns x rows, for example 10x7.')
    if arguments.square is None:
        raise UsageError("--board needs --square, the side of one square in mm.")
    columns, rows = int(size[1]), int(size[2])
    if arguments.marker is None:
        return Chequerboard(columns, rows, arguments.square)
    return Charuco(columns, rows, arguments.square, arguments.marker, arguments.dictionary)


def read_correspondences(
    arguments: argparse.Namespace, sensor: Sensor, progress: Progress
) -> list[Correspondence]:
    """Read the points that the arguments name.

    Returns
    -------
    list of Correspondence
        Pairs of a colour and a depth point.

    Raises
    ------
    InsoleError
    """
    from insole_core.evaluation.color_points import load_correspondences
    from insole_core.evaluation.distances import board_correspondences
    from insole_core.workflows.calibration.steps import find_infrared_pairs

    place: Path = arguments.folder
    if place.is_file():
        return load_correspondences(place)
    if arguments.board is None:
        raise UsageError("A folder of pictures needs --board and --square; name the board.")
    pairs = find_infrared_pairs(place, board_of(arguments), progress)
    return board_correspondences(pairs, sensor.depth_camera)
