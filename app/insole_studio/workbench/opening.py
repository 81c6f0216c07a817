"""From a path on the disk to a foot on the bench; runs beside the window."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from pathlib import Path

from insole_core.cases.record import Source
from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.foot.mesh_file import read_mesh
from insole_core.foot.placing import place_foot
from insole_core.geometry.side import Side
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct import reconstruct
from insole_core.recording.reader import is_session, read_session

MESH_SUFFIXES = (".ply", ".stl", ".obj")
CASE_SUFFIX = ".insole"


@dataclass(frozen=True, eq=False)
class OpenedFoot:
    """A foot and where it came from; `warnings` are sentences for the user."""

    foot: Foot
    source: Source
    warnings: tuple[str, ...] = ()


def open_session(path: Path, progress: Progress = SILENT) -> OpenedFoot:
    """Reconstruct the foot of a recorded session.

    Raises
    ------
    InputError, ReconstructionError
    Cancelled
    """
    progress.step(0.0, "Reading the session")
    session = read_session(path)
    result = reconstruct(session, "fused", progress.part(0.05, 0.85))
    progress.step(0.85, "Placing the foot")
    foot = place_foot(result.mesh, session.manifest.side, frame="reference")
    manifest = path / "manifest.json" if path.is_dir() else path
    source = Source("session", str(path.resolve()), _sha256(manifest), session.manifest.recorded_at)
    progress.step(1.0, "Foot ready")
    return OpenedFoot(foot, source, tuple(result.warnings))


def open_mesh(
    path: Path, side: Side, force: bool = False, progress: Progress = SILENT
) -> OpenedFoot:
    """Bring a surface from a mesh file to the insole frame.

    Parameters
    ----------
    force
        Go on although the shape looks like the other foot.

    Raises
    ------
    InputError, ReconstructionError
    SideMismatchError
        When the shape is that of the other foot, unless `force`.
    """
    progress.step(0.0, "Reading the mesh")
    read = read_mesh(path)
    progress.step(0.3, "Placing the foot")
    foot = place_foot(read.mesh, side, frame="unknown", force=force)
    foot = replace(foot, notes=(*read.notes, *foot.notes))
    progress.step(1.0, "Foot ready")
    return OpenedFoot(foot, Source("mesh", str(path.resolve()), _sha256(path)))


def kind_of(path: Path) -> str:
    """Tell a case, a session and a mesh apart by the name alone.

    Raises
    ------
    InputError
        When it is none of them.
    """
    if path.suffix.lower() == CASE_SUFFIX:
        return "case"
    if path.name == "manifest.json":
        return "manifest"
    if is_session(path):
        return "session"
    if path.suffix.lower() in MESH_SUFFIXES:
        return "mesh"
    raise InputError(
        f"{path} is neither a case, a session nor a mesh; open a {CASE_SUFFIX} file, the folder or "
        f"zip archive of a session, or a {', '.join(MESH_SUFFIXES)} file."
    )


def _sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
