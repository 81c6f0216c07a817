"""From a path on the disk to a foot: a session reconstructed, or a mesh brought into its place."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from pathlib import Path

from insole_core.cases.case_record import ScanSource
from insole_core.errors import UsageError
from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.foot.mesh_file import read_mesh
from insole_core.geometry.side import Side
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct import reconstruct
from insole_core.recording.reader import is_session, read_session
from insole_core.recording.session import Session

MANIFEST = "manifest.json"


@dataclass(frozen=True, eq=False)
class ScannedFoot:
    """A foot and where it came from; `warnings` are sentences for the user."""

    foot: Foot
    source: ScanSource
    warnings: tuple[str, ...] = ()


def open_scan(
    path: Path, side: Side | None = None, *, force: bool = False, progress: Progress = SILENT
) -> ScannedFoot:
    """Make a foot of a recorded session, or of a surface from a mesh file in any pose.

    Parameters
    ----------
    path
    side
        A mesh needs it; a session knows its own.
    force
        Go on although the shape looks like the other foot.

    Raises
    ------
    UsageError
        When the side is missing or contradicts the session.
    SideMismatchError
        When the shape is that of the other foot, unless `force`.
    InputError, ReconstructionError
    Cancelled
    """
    scan = _session_foot if is_session(path) else _mesh_foot
    scanned = scan(path, side, force, progress)
    progress.step(1.0, "Foot ready")
    return scanned


def change_of_source(source: ScanSource) -> str:
    """Say in a sentence what has become of a scan since it was read; empty when nothing has."""
    path = Path(source.path)
    if not path.is_absolute():
        return ""  # a case that was made elsewhere, as the example
    try:
        if _sha256(_signed_file(path)) == source.sha256:
            return ""
    except OSError:
        return Message(
            "The scan {path} is not there any more, or cannot be read; the case holds its "
            "own copy of the foot, so the work can go on.",
            path=path,
        )
    return Message(
        "The scan {path} has changed since this case was made; the case keeps the foot as "
        "it was, open the scan again if the new one is wanted.",
        path=path,
    )


def _session_foot(path: Path, side: Side | None, force: bool, progress: Progress) -> ScannedFoot:
    progress.step(0.0, "Reading the session")
    session = read_session(path)
    recorded = session.manifest.side
    if side not in (None, recorded):
        raise UsageError(
            "The {side} foot is asked for, by --side, --other or the prescription, but {path} was "
            "recorded as the {recorded} foot; correct the call.",
            side=side,
            path=path,
            recorded=recorded,
        )
    result = reconstruct(session, "fused", progress.part(0.05, 0.9))
    progress.step(0.9, "Finding heel and toes")
    foot = place_foot(result.mesh, recorded, frame="reference", force=force)
    return ScannedFoot(foot, session_source(path, session), tuple(result.warnings))


def _mesh_foot(path: Path, side: Side | None, force: bool, progress: Progress) -> ScannedFoot:
    if side is None:
        raise UsageError(
            "{path} is a mesh, which does not say which foot it is; add --side.", path=path
        )
    progress.step(0.0, "Reading the scan")
    read = read_mesh(path)
    progress.step(0.3, "Finding the pose of the foot")
    foot = place_foot(read.mesh, side, frame="unknown", force=force)
    return ScannedFoot(replace(foot, notes=(*read.notes, *foot.notes)), _source("mesh", path))


def session_source(path: Path, session: Session) -> ScanSource:
    """Say of a foot that it comes from a session."""
    return _source("session", path, session.manifest.recorded_at)


def _source(kind: str, path: Path, recorded_at: str = "") -> ScanSource:
    return ScanSource(kind, str(path.resolve()), _sha256(_signed_file(path)), recorded_at)


def _signed_file(path: Path) -> Path:
    """Give the file whose bytes stand for a scan."""
    return path / MANIFEST if path.is_dir() else path


def _sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
