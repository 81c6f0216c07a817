"""Find the foot, or both feet, in a scan that is no imprint."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from insole_core.foot.foot_candidate import FoundFoot
from insole_core.foot.foot_placement import find_foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.messages import Message
from insole_core.scans.mesh_file import ReadMesh
from insole_core.scans.surroundings import second_foot, without_surroundings
from insole_core.workflows.foot_said import NOTHING_SAID, FootSaid, at_known_length
from insole_core.workflows.scan_doubts import with_name_doubts, with_unit_doubt


def find_scanned_feet(
    read: ReadMesh, said: FootSaid = NOTHING_SAID, is_foot: bool = False
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
