"""The argument FOOT: a session, or a mesh and its side."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import InputError
from insole_core.geometry.side import Side
from insole_core.progress import Progress

if TYPE_CHECKING:
    from insole_core.foot.foot import Foot


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what can be said of a foot's scan, besides its path."""
    parser.add_argument("--side", choices=[side.value for side in Side], help="needed for a mesh")
    parser.add_argument(
        "--unit", choices=["mm", "cm", "m", "inch"],
        help="of a mesh (default: the one in which it is as large as a foot)",
    )  # fmt: skip
    parser.add_argument(
        "--force", action="store_true", help="go on although the shape looks like the other foot"
    )


def read_foot(
    path: Path, side: Side | None, arguments: argparse.Namespace, progress: Progress
) -> Foot:
    """Return the foot of a session or a mesh; warnings about it go to stderr.

    Parameters
    ----------
    side
        Needed for a mesh; for a session it has to agree.
    arguments
        With those that `add_arguments` adds.

    Raises
    ------
    UsageError
        When the side is missing or contradicts the session.
    InputError
        When the scan cannot be used, or its shape is that of the other foot.
    """
    from insole_core.foot.foot_placement import SideMismatchError
    from insole_core.workflows.open_scan import open_scan

    try:
        scanned = open_scan(
            path, side, unit=arguments.unit, force=arguments.force, progress=progress
        )
    except SideMismatchError as error:
        raise InputError(
            "{finding} Here: --side {shape_side}, or --force.",
            finding=error.message,
            shape_side=error.asked.other,
        ) from error
    for warning in scanned.warnings:
        print(f"Warning: {warning}", file=sys.stderr)
    for note in scanned.foot.notes:
        print(note, file=sys.stderr)
    return scanned.foot
