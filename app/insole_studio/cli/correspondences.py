"""Points seen in both images: corners of a board, or a file of marked points."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_studio.cli.board_arguments import board_of

if TYPE_CHECKING:
    from insole_core.evaluation.alignment import Correspondence
    from insole_core.sensing.sensor import Sensor


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
    from insole_core.evaluation.board_points import board_correspondences
    from insole_core.evaluation.marked_points import load_correspondences
    from insole_core.workflows.calibration.steps import find_infrared_pairs

    place: Path = arguments.folder
    if place.is_file():
        return load_correspondences(place)
    if arguments.board is None:
        raise UsageError("A folder of pictures needs --board and --square; name the board.")
    pairs = find_infrared_pairs(place, board_of(arguments), progress)
    return board_correspondences(pairs, sensor.depth_camera)
