"""Find the foot, or both feet, in a scan that is no imprint."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from insole_core.foot.foot_candidate import FoundFoot
from insole_core.foot.foot_placement import find_foot
from insole_core.foot.foot_proportions import USUAL_LENGTH_MM
from insole_core.geometry.mesh import TriangleMesh
from insole_core.messages import Message
from insole_core.scans.mesh_file import ReadMesh
from insole_core.scans.scan_folder import ScanPart
from insole_core.scans.surroundings import second_foot, without_surroundings
from insole_core.scans.units import MM_PER_UNIT, UNIT_NAMES
from insole_core.workflows.foot_said import NOTHING_SAID, FootSaid, at_known_length


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
    doubts = (*_unit_doubts(found, read), *found.doubts)
    return replace(found, path=path, unit=unit, clicks=said.pose, doubts=doubts)


def _unit_doubts(found: FoundFoot, read: ReadMesh) -> Iterator[Message]:
    """Doubt a unit that was concluded from the size where the foot has a usual one in another."""
    length_mm = found.candidates[0].length_mm
    least_mm, most_mm = USUAL_LENGTH_MM
    if not read.is_unit_concluded or not least_mm <= length_mm <= most_mm:
        return
    for unit, mm_per_unit in MM_PER_UNIT.items():
        other_mm = length_mm * mm_per_unit / read.mm_per_unit
        if unit != read.unit and least_mm <= other_mm <= most_mm:
            yield Message(
                "The size does not tell the unit: the foot is {length_mm:.0f} mm long in {unit}, "
                "and about {other_mm:.0f} mm in {other_unit}; say in which unit the file is.",
                length_mm=length_mm,
                unit=UNIT_NAMES[read.unit],
                other_mm=other_mm,
                other_unit=UNIT_NAMES[unit],
            )


def with_name_doubts(found: FoundFoot, read: ReadMesh, said: FootSaid = NOTHING_SAID) -> FoundFoot:
    """Return the only foot of a file, in doubt if the file's name tells the other side."""
    if read.part is None:
        return found
    return replace(found, doubts=(*_name_doubts(found, read.part, said), *found.doubts))


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


def _name_doubts(found: FoundFoot, part: ScanPart, said: FootSaid) -> Iterator[Message]:
    if part.side is None:
        return
    told = found.told_side
    if told not in (None, part.side):
        yield Message(
            "{name} is named as a {side} foot, but looks like a {told} one; say which foot it is.",
            name=part.path.name,
            side=part.side,
            told=told,
        )
    elif said.side not in (None, part.side):
        yield Message(
            "{name} is named as a {side} foot, but is opened as a {said} one; say which foot it "
            "is.",
            name=part.path.name,
            side=part.side,
            said=said.side,
        )
