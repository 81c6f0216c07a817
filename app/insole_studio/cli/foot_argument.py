"""The argument FOOT: a session, or a mesh and its side."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import InputError, UsageError
from insole_core.formats.file_formats import SCAN_SUFFIXES
from insole_core.geometry.side import Side
from insole_core.imprints.form import Form
from insole_core.progress import Progress
from insole_studio.cli.argument_parser import number

if TYPE_CHECKING:
    from insole_core.cases.scan_source import ImportChoice
    from insole_core.foot.foot import Foot
    from insole_core.workflows.scanned_feet import ScannedFoot


A_MESH = f"a mesh ({' '.join(SCAN_SUFFIXES)})"


def add_arguments(parser: argparse.ArgumentParser, *, reads_both: bool = False) -> None:
    """Add what can be said of a foot's scan, besides its path.

    Parameters
    ----------
    parser
    reads_both
        Whether both feet are read where a session holds them and no side is said.
    """
    parser.add_argument(
        "--side",
        choices=[side.value for side in Side],
        help="needed for a mesh; of a session of both feet, only this one"
        if reads_both
        else "needed for a mesh, and for a session of both feet",
    )
    add_scan_arguments(parser)
    parser.add_argument(
        "--force", action="store_true",
        help="go on although the shape looks like the other foot, or has no proportions of one",
    )  # fmt: skip


def add_scan_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what can be said of a mesh besides its side."""
    size = parser.add_mutually_exclusive_group()
    size.add_argument(
        "--unit", choices=["mm", "cm", "m", "inch"],
        help="of a mesh (default: the one in which it is as large as a foot)",
    )  # fmt: skip
    size.add_argument(
        "--length-mm", type=number, metavar="L", help="length of the foot, where no unit is known"
    )
    size.add_argument(
        "--shoe-size", type=number, metavar="EU", help="its shoe size, where no unit is known"
    )
    parser.add_argument(
        "--form", choices=[form.value for form in Form],
        help="what a mesh shows: a foot, an imprint such as a foam box, or a cast, taken under "
        "weight or without (unloaded_cast)",
    )  # fmt: skip
    for name, place in (
        ("heel", "the end of the heel"),
        ("toe", "the tip of a toe"),
        ("sole", "the sole under the ball"),
    ):
        parser.add_argument(
            f"--{name}", type=number, nargs=3, metavar=("X", "Y", "Z"),
            help=f"{place}, mm, as a mesh lies; all three tell how",
        )  # fmt: skip


def said_of_scan(arguments: argparse.Namespace, *, force: bool = False) -> ImportChoice:
    """Return what the arguments of `add_scan_arguments` say.

    Raises
    ------
    UsageError
        When some of the three points are missing.
    """
    from insole_core.cases.scan_source import ImportChoice
    from insole_core.foot.foot_candidate import PoseClicks
    from insole_core.scans.scale import KnownFootLength, KnownShoeSize

    points = [arguments.heel, arguments.toe, arguments.sole]
    given = [tuple(point) for point in points if point is not None]
    if len(given) not in (0, 3):
        raise UsageError("Give all three points of the foot: --heel, --toe and --sole.")
    size: KnownFootLength | KnownShoeSize | None = None
    if arguments.length_mm is not None:
        size = KnownFootLength(arguments.length_mm)
    elif arguments.shoe_size is not None:
        size = KnownShoeSize(arguments.shoe_size)
    return ImportChoice(
        unit=arguments.unit,
        known_size=size,
        form=None if arguments.form is None else Form(arguments.form),
        pose=PoseClicks(*given) if given else None,
        force=force,
    )


def recorded_sides(path: Path) -> tuple[Side, ...]:
    """Return the sides that a session was recorded with; none of a mesh.

    Raises
    ------
    InputError
        When it is a session that cannot be read.
    """
    from insole_core.recording.reader import is_session, read_session
    from insole_core.scans.scan_folder import holds_scans

    if not is_session(path) or holds_scans(path):
        return ()
    return read_session(path).manifest.sides


def read_foot(
    path: Path, side: Side | None, arguments: argparse.Namespace, progress: Progress
) -> Foot:
    """Return the foot of a session or a mesh without its scan: see `read_scan`."""
    return read_scan(path, side, arguments, progress).foot


def read_scan(
    path: Path, side: Side | None, arguments: argparse.Namespace, progress: Progress
) -> ScannedFoot:
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
        choice = said_of_scan(arguments, force=arguments.force)
        scanned = open_scan(path, side, choice=choice, progress=progress)
    except SideMismatchError as error:
        raise InputError(
            "{finding} Here: --side {shape_side}, or --force.",
            finding=error.message,
            shape_side=error.asked.other,
        ) from error
    return _told(scanned)


def read_feet(path: Path, arguments: argparse.Namespace, progress: Progress) -> dict[Side, Foot]:
    """Return all feet of a session, read at once; warnings about them go to stderr.

    Raises
    ------
    UsageError
        When more is said of them than whether to insist.
    InputError
        When a foot cannot be made, or is not in its place.
    """
    from insole_core.workflows.open_scan import open_feet

    choice = said_of_scan(arguments, force=arguments.force)
    feet = [_told(one).foot for one in open_feet(path, choice=choice, progress=progress)]
    return {foot.side: foot for foot in feet}


def _told(scanned: ScannedFoot) -> ScannedFoot:
    for warning in scanned.warnings:
        print(f"Warning: {warning}", file=sys.stderr)
    for note in scanned.foot.notes:
        print(note, file=sys.stderr)
    return scanned
