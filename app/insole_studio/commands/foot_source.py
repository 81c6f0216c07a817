"""FOOT of the command line: a session, or a mesh and its side."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.errors import UsageError
from insole_core.geometry.side import Side
from insole_core.progress import Progress

if TYPE_CHECKING:
    from insole_core.foot.foot import Foot


def read_foot(path: Path, side: Side | None, force: bool, progress: Progress) -> Foot:
    """Give the foot of a session, reconstructed, or of a mesh in any pose.

    Raises
    ------
    UsageError
        When the side is missing or contradicts the session.
    """
    from insole_core.recording.reader import is_session

    read = _foot_of_session if is_session(path) else _foot_of_mesh
    return read(path, side, force, progress)


def _foot_of_session(path: Path, side: Side | None, force: bool, progress: Progress) -> Foot:
    from insole_core.foot.placing import place_foot
    from insole_core.reconstruct import reconstruct
    from insole_core.recording.reader import read_session

    progress.step(0.0, "Reading the session")
    session = read_session(path)
    recorded = session.manifest.side
    if side not in (None, recorded):
        raise UsageError(
            f"The {side} foot is asked for, by --side or the prescription, but {path} was "
            f"recorded as the {recorded} foot; correct the call."
        )
    result = reconstruct(session, "fused", progress.part(0.1, 0.9))
    for warning in result.warnings:
        print(f"Warning: {warning}", file=sys.stderr)
    progress.step(0.9, "Finding heel and toes")
    return place_foot(result.mesh, recorded, frame="reference", force=force)


def _foot_of_mesh(path: Path, side: Side | None, force: bool, progress: Progress) -> Foot:
    from insole_core.foot.mesh_file import read_mesh
    from insole_core.foot.placing import place_foot

    if side is None:
        raise UsageError(f"{path} is a mesh, which does not say which foot it is; add --side.")
    progress.step(0.0, "Reading the scan")
    read = read_mesh(path)
    for note in read.notes:
        print(note, file=sys.stderr)
    progress.step(0.3, "Finding the pose of the foot")
    return place_foot(read.mesh, side, frame="unknown", force=force)
