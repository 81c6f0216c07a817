"""Find the foot, or both feet, in a scan that is no imprint."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from insole_core.foot.foot_candidate import FootCandidate, FoundFoot, PoseClicks
from insole_core.foot.foot_placement import find_foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.messages import Message
from insole_core.scans.mesh_file import ReadMesh
from insole_core.scans.scale import KnownDistance, KnownSize, known_length_mm
from insole_core.scans.scan_folder import ScanPart
from insole_core.scans.surroundings import second_foot, without_surroundings

_SCALE_ROUNDS, _SCALE_ERROR = 4, 0.002


@dataclass(frozen=True)
class FootSaid:
    """What a user has said of a foot; None where it is to be concluded.

    Parameters
    ----------
    side
    pose
        As it was clicked, or as found before.
    known_size
    """

    side: Side | None = None
    pose: PoseClicks | FootCandidate | None = None
    known_size: KnownSize | None = None

    @property
    def is_decided(self) -> bool:
        """Whether it is said which foot it is."""
        return self.side is not None or isinstance(self.pose, FootCandidate)

    @property
    def length_mm(self) -> float | None:
        """Length of the foot, by which a scan without a scale is scaled."""
        if self.known_size is None or isinstance(self.known_size, KnownDistance):
            return None
        return known_length_mm(self.known_size)

    def scaled(self, factor: float) -> FootSaid:
        """Return what still holds of a scan that was scaled: a candidate does at one scale only."""
        pose = self.pose.scaled(factor) if isinstance(self.pose, PoseClicks) else None
        return replace(self, pose=pose)


NOTHING_SAID = FootSaid()


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
        One, or two: of a folder, or that stand in one scan without touching.

    Raises
    ------
    InputError
        When it does not look like a foot.
    """
    saids = [said] if read.second is None else _for_each(said, (read.mesh, read.second.mesh))
    scan = without_surroundings(read.mesh, is_foot=is_foot)
    read, feet = _in_scale(replace(read, mesh=scan.mesh), saids[0])
    if read.second is None:
        return read, scan.left_out, feet
    second, others, more = find_scanned_feet(read.second, saids[1], is_foot)
    named = (named_foot(feet[0], read), named_foot(more[0], second))
    return read, (*scan.left_out, *others), named


def _in_scale(read: ReadMesh, said: FootSaid) -> tuple[ReadMesh, tuple[FoundFoot, ...]]:
    """Return the scan at the scale at which the first foot has its known length, and the feet."""
    feet = _feet_in(read.mesh, said)
    length_mm = said.length_mm
    if length_mm is None:
        return read, feet
    for _ in range(_SCALE_ROUNDS):
        factor = length_mm / feet[0].candidates[0].length_mm
        if abs(factor - 1) < _SCALE_ERROR:
            break
        read, said = read.scaled(factor), said.scaled(factor)
        feet = _feet_in(read.mesh, said)
    return read, feet


def _feet_in(mesh: TriangleMesh, said: FootSaid) -> tuple[FoundFoot, ...]:
    """Return the foot in a scan, or both where two stand in it without touching."""
    is_second = second_foot(mesh)
    if is_second is None:
        return (find_foot(mesh, said.side, said.pose),)
    parts = mesh.part(~is_second), mesh.part(is_second)
    poses = [one.pose for one in _for_each(said, parts)]
    first, second = (find_foot(part, pose=pose) for part, pose in zip(parts, poses, strict=True))
    if first.told_side is not None and first.told_side is second.told_side:
        doubt = Message(
            "Both feet in the scan look like a {side} one; say which foot is which.",
            side=first.told_side,
        )
        return tuple(replace(foot, doubts=(doubt, *foot.doubts)) for foot in (first, second))
    return first, second


def _for_each(said: FootSaid, meshes: tuple[TriangleMesh, TriangleMesh]) -> list[FootSaid]:
    """Return what was said of each of two feet: the points were clicked on one of them."""
    from scipy.spatial import cKDTree

    if not isinstance(said.pose, PoseClicks):
        return [said, said]
    clicks = np.array([said.pose.heel, said.pose.toe, said.pose.sole])
    far_mm = [float(np.sum(cKDTree(mesh.vertices).query(clicks)[0])) for mesh in meshes]
    other = replace(said, pose=None)
    return [said, other] if far_mm[0] <= far_mm[1] else [other, said]


def named_foot(found: FoundFoot, read: ReadMesh) -> FoundFoot:
    """Hold one of two feet against the name of its file, which decides where the shape does not."""
    found = replace(with_name(found, read), notes=(*read.notes, *found.notes))
    if read.part is None or read.part.side is None or found.told_side is not None:
        return found
    side = read.part.side
    ordered = sorted(found.candidates, key=lambda candidate: candidate.side is not side)
    return replace(found, candidates=tuple(ordered))


def with_name(found: FoundFoot, read: ReadMesh, said: FootSaid = NOTHING_SAID) -> FoundFoot:
    """Return a foot with the path of its file, in doubt if its name tells the other side."""
    part = read.part
    if part is None:
        return found
    path = part.path if part.path.is_file() else None
    return replace(found, path=path, doubts=(*_name_doubts(found, part, said), *found.doubts))


def _name_doubts(found: FoundFoot, part: ScanPart, said: FootSaid) -> Iterator[Message]:
    if part.side is None or isinstance(said.pose, FootCandidate):
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
