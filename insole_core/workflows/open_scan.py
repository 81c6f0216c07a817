"""Make a foot from a path: reconstruct a session, or place a mesh in the insole frame."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from insole_core.errors import UsageError
from insole_core.foot.foot_placement import place_foot
from insole_core.foot.mesh_file import read_mesh
from insole_core.geometry.side import Side
from insole_core.progress import SILENT, Progress
from insole_core.recording.reader import is_session
from insole_core.workflows.make_foot import make_foot, open_session
from insole_core.workflows.scanned_foot import ScannedFoot, mesh_source


def open_scan(
    path: Path, side: Side | None = None, *, force: bool = False, progress: Progress = SILENT
) -> ScannedFoot:
    """Make a foot from a recorded session, or from a mesh file in any pose.

    Parameters
    ----------
    side
        Required for a mesh; a session states its own.
    force
        Continue although the shape looks like the other foot.

    Raises
    ------
    UsageError
        When the side is missing or contradicts the session.
    SideMismatchError
        When the shape is that of the other foot, unless `force`.
    InputError
        When the file cannot be read.
    ReconstructionError
        When no view of a session can be used.
    Cancelled
    """
    scan = _session_foot if is_session(path) else _mesh_foot
    scanned = scan(path, side, force, progress)
    progress.step(1.0, "Foot ready")
    return scanned


def _session_foot(path: Path, side: Side | None, force: bool, progress: Progress) -> ScannedFoot:
    opened = open_session(path, progress)
    recorded = opened.session.manifest.side
    if side not in (None, recorded):
        raise UsageError(
            "The {side} foot is asked for, by --side, --other or the prescription, but {path} was "
            "recorded as the {recorded} foot; correct the call.",
            side=side,
            path=path,
            recorded=recorded,
        )
    return make_foot(opened, progress=progress.part(0.05, 1.0), force=force).scan


def _mesh_foot(path: Path, side: Side | None, force: bool, progress: Progress) -> ScannedFoot:
    if side is None:
        raise UsageError(
            "{path} is a mesh, which does not say which foot it is; add --side.", path=path
        )
    progress.step(0.0, "Reading the scan")
    read = read_mesh(path)
    progress.step(0.3, "Finding the pose of the foot")
    foot = place_foot(read.mesh, side, frame="unknown", force=force)
    return ScannedFoot(replace(foot, notes=(*read.notes, *foot.notes)), mesh_source(path))
