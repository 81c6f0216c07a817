"""A foot and the scan that it was made from, and the feet found in a scan that is no imprint."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.cases.scan_source import NOTHING_SAID, ImportChoice, ScanSource
from insole_core.errors import InsoleError
from insole_core.foot.foot import Foot
from insole_core.foot.foot_candidate import FoundFoot
from insole_core.foot.foot_placement import find_foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.given_file import sha256_of
from insole_core.imprints.form import Form
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.recording.session import CaptureCondition, Session
from insole_core.recording.store import MAX_ARCHIVE_BYTES
from insole_core.scans.mesh_file import ReadMesh
from insole_core.scans.surroundings import second_foot, without_surroundings
from insole_core.workflows.scan_doubts import (
    NO_WORD,
    FootSaid,
    at_known_length,
    with_name_doubts,
    with_unit_doubt,
)

if TYPE_CHECKING:
    from insole_core.cases.case_record import FootRecord

MANIFEST = "manifest.json"


def find_scanned_feet(
    read: ReadMesh, said: FootSaid = NO_WORD, is_foot: bool = False
) -> tuple[ReadMesh, tuple[str, ...], tuple[FoundFoot, ...]]:
    """Leave out what surrounds the feet in a scan, find them, and scale them to a known length.

    Parameters
    ----------
    is_foot
        Whether the user has said that it is a foot, and no imprint.

    Returns
    -------
    read : ReadMesh
        Of the first foot, or of both in one scan, at its final scale.
    left_out : tuple
        A sentence each.
    feet : tuple
        One, or two: of a folder, or that stand in one scan without touching; more of a folder
        where two stand in one of its scans.

    Raises
    ------
    InputError
        When it does not look like a foot.
    """
    if read.second is not None:
        return _in_both(read, read.second, said, is_foot)
    scan = without_surroundings(read.mesh, is_foot=is_foot)
    read, feet = at_known_length(
        replace(read, mesh=scan.mesh),
        said,
        lambda one, known: _feet_in(one.mesh, known),
        lambda feet: feet[0].candidates[0].length_mm,
    )
    return read, scan.left_out, feet


def _in_both(
    first: ReadMesh, second: ReadMesh, said: FootSaid, is_foot: bool
) -> tuple[ReadMesh, tuple[str, ...], tuple[FoundFoot, ...]]:
    """Find the feet in both scans of a folder or archive."""
    saids = said.for_each(first.mesh, second.mesh)
    alone = replace(first, second=None)
    read, left_out, feet = find_scanned_feet(alone, saids[0], is_foot)
    read2, left_out2, feet2 = find_scanned_feet(second, saids[1], is_foot)
    named = (*named_feet(feet, read, saids[0]), *named_feet(feet2, read2, saids[1]))
    return replace(read, second=read2), (*left_out, *left_out2), named


def _feet_in(mesh: TriangleMesh, said: FootSaid) -> tuple[FoundFoot, ...]:
    """Return the foot in a scan, or both where two stand in it without touching."""
    is_second = second_foot(mesh)
    if is_second is None:
        return (find_foot(mesh, said.side, said.pose),)
    parts = mesh.part(~is_second), mesh.part(is_second)
    poses = [one.pose for one in said.for_each(*parts)]
    first, second = (find_foot(part, pose=pose) for part, pose in zip(parts, poses, strict=True))
    if first.told_side is not None and first.told_side is second.told_side:
        doubt = Message(
            "Both feet in the scan look like a {side} one; say which foot is which.",
            side=first.told_side,
        )
        return tuple(replace(foot, doubts=(doubt, *foot.doubts)) for foot in (first, second))
    return first, second


def named_feet(feet: tuple[FoundFoot, ...], read: ReadMesh, said: FootSaid) -> Iterator[FoundFoot]:
    """Yield the feet in one of two scans, as `from_file`, and held against the name of the file."""
    for one in feet:
        found = replace(from_file(one, read, said), notes=(*read.notes, *one.notes))
        yield _by_name(found, read) if len(feet) == 1 else _beside_others(found, read)


def from_file(found: FoundFoot, read: ReadMesh, said: FootSaid) -> FoundFoot:
    """Return a foot with what its file has to be read with to find it once more."""
    path = read.part.path if read.part is not None and read.part.path.is_file() else None
    unit = read.unit if said.known_size is None else None
    warnings = (*found.warnings, *read.warnings)
    of_file = replace(found, path=path, unit=unit, clicks=said.pose, warnings=warnings)
    return with_unit_doubt(of_file, read)


def _by_name(found: FoundFoot, read: ReadMesh) -> FoundFoot:
    """Hold one of two feet against the name of its file, which decides where the shape does not."""
    found = with_name_doubts(found, read)
    if read.part is None or read.part.side is None or found.told_side is not None:
        return found
    side = read.part.side
    ordered = sorted(found.candidates, key=lambda candidate: candidate.side is not side)
    return replace(found, candidates=tuple(ordered))


def _beside_others(found: FoundFoot, read: ReadMesh) -> FoundFoot:
    """Doubt one of two feet in a file that has another scan beside it."""
    if read.part is None:
        return found
    doubt = Message(
        "{name} holds two feet, and there is another scan beside it; choose the feet that are "
        "meant.",
        name=read.part.path.name,
    )
    return replace(found, doubts=(doubt, *found.doubts))


@dataclass(frozen=True, eq=False)
class ScannedFoot:
    """A foot and its scan; `warnings` are sentences for the user.

    Parameters
    ----------
    is_alone
        Whether its scan is the recording of one foot, and so shows no other one.
    """

    foot: Foot
    source: ScanSource
    warnings: tuple[str, ...] = ()
    is_alone: bool = False


def session_source(path: Path, session: Session) -> ScanSource:
    """Return the scan record of a session that was read from `path`."""
    source = _source("session", path, session.manifest.recorded_at)
    condition = session.manifest.capture_condition or CaptureCondition()
    return replace(
        source,
        place=session.place,
        weight_bearing=condition.weight_bearing,
        choice=ImportChoice(side=session.edits.side),
    )


def mesh_source(path: Path, form: Form = Form.FOOT) -> ScanSource:
    """Return the scan record of a mesh file."""
    return replace(_source("mesh", path), form=form)


def feet_made_of(
    path: Path, feet: Sequence[FootRecord], progress: Progress = SILENT
) -> tuple[FootRecord, ...]:
    """Return those feet of a case that a mesh file shows, wherever it lay then.

    Raises
    ------
    Cancelled
    """
    if path.is_dir() or all(foot.source.kind != "mesh" for foot in feet):
        return ()
    try:
        digest = sha256_of(path, MAX_ARCHIVE_BYTES, progress)
    except OSError:  # whoever reads the scan says what is wrong
        return ()
    shown = (foot for foot in feet if not foot.source.mirrored)
    return tuple(foot for foot in shown if foot.source.sha256 == digest)


def choice_of(feet: Sequence[FootRecord]) -> ImportChoice:
    """Return with which choice a scan gives the feet that were made of it once more.

    Parameters
    ----------
    feet
        One, or both of one scan.
    """
    source = feet[0].source
    choice = source.choice
    if choice == NOTHING_SAID and source.form is not Form.FOOT:  # of a case that kept no choice
        choice = replace(choice, form=source.form)
    return replace(choice, side=feet[0].side if len(feet) == 1 else None)


def change_of_source(source: ScanSource, progress: Progress = SILENT) -> str:
    """Return a sentence on how a scan changed since it was read; empty when it did not.

    Raises
    ------
    Cancelled
    """
    path = Path(source.path)
    if not path.is_absolute():
        return ""  # a case made on another machine, such as the example
    try:
        if sha256_of(_signed_file(path), MAX_ARCHIVE_BYTES, progress) == source.sha256:
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


def digest_of_scan(path: Path) -> str:
    """Return the SHA-256 by which a case names a scan; empty for what cannot be read."""
    try:
        return sha256_of(_signed_file(path), MAX_ARCHIVE_BYTES)
    except (OSError, InsoleError):  # such as too large
        return ""


def _source(kind: str, path: Path, recorded_at: str = "") -> ScanSource:
    digest = sha256_of(_signed_file(path), MAX_ARCHIVE_BYTES)
    return ScanSource(kind, str(path.resolve()), digest, recorded_at)


def _signed_file(path: Path) -> Path:
    """Return the file whose hash identifies a scan."""
    return path / MANIFEST if path.is_dir() else path
