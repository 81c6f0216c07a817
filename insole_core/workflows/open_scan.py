"""Make a foot from a path: reconstruct a session, or place a mesh in the insole frame."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from insole_core.cases.scan_source import NOTHING_SAID, ImportChoice
from insole_core.errors import UsageError
from insole_core.foot.foot_placement import DoubtfulScanError
from insole_core.geometry.side import Side
from insole_core.messages import joined
from insole_core.progress import SILENT, Progress
from insole_core.recording.reader import is_session
from insole_core.scans.scan_folder import holds_scans
from insole_core.workflows.import_scan import examine_scan, read_scan, take_foot
from insole_core.workflows.make_feet import make_feet
from insole_core.workflows.make_foot import open_foot, open_session
from insole_core.workflows.scanned_feet import ScannedFoot


def open_scan(
    path: Path,
    side: Side | None = None,
    *,
    choice: ImportChoice = NOTHING_SAID,
    progress: Progress = SILENT,
) -> ScannedFoot:
    """Make a foot from a recorded session, or from a mesh file in any pose.

    Parameters
    ----------
    side
        Required for a mesh, and to choose from a session of both feet; one of one foot states its
        own.
    choice
        What else was said of a mesh. Of a session, only `force` counts.

    Raises
    ------
    UsageError
        When the side is missing or contradicts the session, or more is said of a session.
    SideMismatchError
        When the shape is that of the other foot, unless forced.
    ProportionsError
        When the surface is no foot by its proportions, unless forced.
    DoubtfulScanError
        When it is not sure how the foot lies or whether it is one, unless its points are given or
        it is forced; or when its unit is not, unless that or a size is given.
    InputError
        When the file cannot be read.
    ReconstructionError
        When no view of a session can be used.
    Cancelled
    """
    if is_session(path) and not holds_scans(path):
        scanned = _session_foot(path, side, choice, progress)
    else:
        scanned = _mesh_foot(path, side, choice, progress)
    progress.step(1.0, "Foot ready")
    return scanned


def open_feet(
    path: Path, *, choice: ImportChoice = NOTHING_SAID, progress: Progress = SILENT
) -> tuple[ScannedFoot, ...]:
    """Make all feet of a recorded session in one go, from views that are read once.

    Parameters
    ----------
    choice
        Only `force` may be said.

    Returns
    -------
    tuple
        The only foot, or the left and the right one.

    Raises
    ------
    UsageError
        When more is said.
    DoubtfulFeetError
        When one of two feet reaches out of its place or is of the wrong side, unless forced.
    SideMismatchError, InputError, ReconstructionError, Cancelled
        As of `open_scan`.
    """
    _require_nothing_said(path, choice)
    opened = open_session(path, progress)
    made = make_feet(opened, progress=progress.part(0.05, 1.0), force=choice.force)
    progress.step(1.0, "The feet are ready")
    return tuple(one.scan for one in made)


def _session_foot(
    path: Path, side: Side | None, choice: ImportChoice, progress: Progress
) -> ScannedFoot:
    _require_nothing_said(path, choice)
    opened = open_foot(path, side, progress)
    (made,) = make_feet(opened, progress=progress.part(0.05, 1.0), force=choice.force)
    return made.scan


def _require_nothing_said(path: Path, choice: ImportChoice) -> None:
    if choice.unit is not None or choice.known_size is not None:
        raise UsageError(
            "{path} is a session, which is always in millimetres; leave out the unit.", path=path
        )
    if choice.form is not None or choice.pose is not None:
        raise UsageError(
            "{path} is a session, which says how the foot lies; leave out form and points.",
            path=path,
        )


def _mesh_foot(
    path: Path, side: Side | None, choice: ImportChoice, progress: Progress
) -> ScannedFoot:
    if side is None:
        read_scan(path, choice, progress)  # what is no scan is told before anything is asked of it
        raise UsageError(
            "{path} is a mesh, which does not say which foot it is; add --side.", path=path
        )
    choice = replace(choice, side=side)
    examination = examine_scan(path, choice, progress)
    feet = examination.feet
    found = next((foot for foot in feet if foot.candidates[0].side is side), feet[0])
    if found.unit_readings:
        raise DoubtfulScanError(
            "{path} is doubtful: {doubts} Use --unit, --length-mm or --shoe-size.",
            path=path,
            doubts=joined(found.doubts, " "),
        )
    candidate = next(one for one in found.candidates if one.side is side)
    scanned = take_foot(examination, found, candidate, choice)
    if found.doubts and choice.pose is None and not choice.force:
        raise DoubtfulScanError(
            "{path} is doubtful: {doubts} Open it in the window, or insist with --force.",
            path=path,
            doubts=joined(found.doubts, " "),
        )
    return replace(scanned, warnings=(*scanned.warnings, *found.doubts))
