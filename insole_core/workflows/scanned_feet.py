"""Find the foot, or both feet, in a scan that is no imprint."""

from __future__ import annotations

from dataclasses import replace

from insole_core.foot.foot_candidate import FootCandidate, FoundFoot, PoseClicks
from insole_core.foot.foot_placement import find_foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.messages import Message
from insole_core.scans.mesh_file import ReadMesh
from insole_core.scans.scale import KnownDistance, KnownSize, known_length_mm
from insole_core.scans.surroundings import second_foot, without_surroundings

_SCALE_ROUNDS, _SCALE_ERROR = 4, 0.002


def find_scanned_feet(
    read: ReadMesh,
    known_size: KnownSize | None = None,
    is_foot: bool = False,
    side: Side | None = None,
    pose: PoseClicks | FootCandidate | None = None,
) -> tuple[ReadMesh, tuple[str, ...], tuple[FoundFoot, ...]]:
    """Leave out what surrounds the feet in a scan, find them, and scale them to a known length.

    Parameters
    ----------
    is_foot
        Whether the user has said that it is a foot, and no imprint.
    side, pose
        As the user has said; they do not count where there are two feet.

    Returns
    -------
    read : ReadMesh
        Of the first foot, or of both in one scan, at its final scale.
    left_out : tuple
        A sentence each.
    feet : tuple
        One, or two: of a folder, or that stand in one scan without touching.

    Raises
    ------
    InputError
        When it does not look like a foot.
    """
    scan = without_surroundings(read.mesh, is_foot=is_foot)
    read, feet = _in_scale(replace(read, mesh=scan.mesh), known_size, side, pose)
    if read.second is None:
        return read, scan.left_out, feet
    second, others, more = find_scanned_feet(read.second, known_size, is_foot)
    named = (named_foot(feet[0], read), named_foot(more[0], second))
    return read, (*scan.left_out, *others), named


def _in_scale(
    read: ReadMesh,
    known: KnownSize | None,
    side: Side | None,
    pose: PoseClicks | FootCandidate | None,
) -> tuple[ReadMesh, tuple[FoundFoot, ...]]:
    """Return the scan at the scale at which the first foot has its known length, and the feet."""
    if known is None or isinstance(known, KnownDistance):
        return read, _feet_in(read.mesh, side, pose)
    clicks = pose if isinstance(pose, PoseClicks) else None  # a candidate holds for one scale only
    feet = _feet_in(read.mesh, side, clicks)
    length_mm = known_length_mm(known)
    for _ in range(_SCALE_ROUNDS):
        factor = length_mm / feet[0].candidates[0].length_mm
        if abs(factor - 1) < _SCALE_ERROR:
            break
        read = read.scaled(factor)
        clicks = None if clicks is None else clicks.scaled(factor)
        feet = _feet_in(read.mesh, side, clicks)
    return read, feet


def _feet_in(
    mesh: TriangleMesh, side: Side | None, pose: PoseClicks | FootCandidate | None
) -> tuple[FoundFoot, ...]:
    """Return the foot in a scan, or both where two stand in it without touching."""
    is_second = second_foot(mesh)
    if is_second is None:
        return (find_foot(mesh, side, pose),)
    first, second = find_foot(mesh.part(~is_second)), find_foot(mesh.part(is_second))
    if first.told_side is not None and first.told_side is second.told_side:
        doubt = Message(
            "Both feet in the scan look like a {side} one; say which foot is which.",
            side=first.told_side,
        )
        return tuple(replace(foot, doubts=(doubt, *foot.doubts)) for foot in (first, second))
    return first, second


def named_foot(found: FoundFoot, read: ReadMesh) -> FoundFoot:
    """Hold a foot against the name of its file, which decides where the shape does not."""
    if read.part is None:
        return found
    path = read.part.path if read.part.path.is_file() else None
    side, told = read.part.side, found.told_side
    found = replace(found, path=path, notes=(*read.notes, *found.notes))
    if side is None or told is side:
        return found
    if told is None:
        ordered = sorted(found.candidates, key=lambda candidate: candidate.side is not side)
        return replace(found, candidates=tuple(ordered))
    doubt = Message(
        "{name} is named as a {side} foot, but looks like a {told} one; say which foot it is.",
        name=read.part.path.name,
        side=side,
        told=told,
    )
    return replace(found, doubts=(doubt, *found.doubts))
