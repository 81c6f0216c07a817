"""A scanned surface becomes a foot: brought to the insole frame, its side checked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from insole_core.errors import InputError, InsoleError
from insole_core.foot.foot import Foot
from insole_core.foot.levelling import LevelFoot, level
from insole_core.foot.pose import find_poses, surface_points, unlikenesses
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import transform

Frame = Literal["reference", "unknown"]

_CLEAR = 1.25
"""From this ratio of the two unlikenesses on, the shape tells the side."""
_NO_FOOT = 0.6
"""From this unlikeness on, it is no foot at all."""


class SideMismatchError(InsoleError):
    """The shape is that of the other foot."""


@dataclass(frozen=True, eq=False)
class _Candidate:
    """The surface as a foot of one side, in its best pose."""

    side: Side
    foot: LevelFoot
    unlikeness: float


def place_foot(mesh: TriangleMesh, side: Side, *, frame: Frame, force: bool = False) -> Foot:
    """Bring a surface to the insole frame.

    Parameters
    ----------
    mesh : mm
    side
    frame
        "reference": toes towards +y and dorsal +z are known, and only the last degrees are found;
        "unknown": the surface may lie in any way.
    force
        Go on although the shape looks like the other foot.

    Raises
    ------
    SideMismatchError
        When the shape is clearly that of the other foot, unless `force`.
    InputError
        When the surface looks like no foot in any pose.
    """
    asked, other = _candidates(mesh, side, frame)
    if frame == "unknown" and min(asked.unlikeness, other.unlikeness) > _NO_FOOT:
        raise InputError(
            "the surface looks like no foot, whichever way it is turned;"
            " check that the file holds a foot or its sole, and nothing else."
        )
    if asked.unlikeness > _CLEAR * other.unlikeness:
        if not force:
            raise SideMismatchError(
                f"the shape looks like a {other.side} foot ({_reason(other)});"
                f" give --side {other.side}, or --force to go on with {side}."
            )
        # The ways of ground and toes are those of the shape, whatever the side.
        pose = other.foot.source2insole
        asked = _candidate(mesh, surface_points(mesh), side, pose)
    found = asked.foot
    notes = (_side_note(asked, other), *_pose_notes(found, frame))
    return Foot(
        side, mesh.transformed(found.source2insole), found.source2insole, found.length_mm, notes
    )


def _candidates(mesh: TriangleMesh, side: Side, frame: Frame) -> tuple[_Candidate, _Candidate]:
    """The surface as a foot of the asked side, and of the other."""
    rough = {s: np.eye(4) for s in Side}
    if frame == "unknown":
        for pose in reversed(find_poses(mesh)):
            rough[pose.side] = pose.source2rough
    points = surface_points(mesh)
    asked, other = (_candidate(mesh, points, s, rough[s]) for s in (side, side.other))
    return asked, other


def _candidate(
    mesh: TriangleMesh, points: FloatArray, side: Side, source2rough: FloatArray
) -> _Candidate:
    foot = level(mesh, side, source2rough)
    return _Candidate(side, foot, unlikenesses(transform(foot.source2insole, points))[side])


def _side_note(asked: _Candidate, other: _Candidate) -> str:
    ratio = other.unlikeness / asked.unlikeness
    if ratio < 1 / _CLEAR:
        return (
            f"The shape looks like a {other.side} foot ({_reason(other)});"
            f" taken as a {asked.side} one by force."
        )
    if ratio < _CLEAR:
        return f"The shape does not tell left from right; taken as a {asked.side} foot as asked."
    return f"A {asked.side} foot by its shape: {_reason(asked)} (margin {ratio:.1f} to 1)."


def _reason(candidate: _Candidate) -> str:
    direction = "right" if candidate.side.medial_sign > 0 else "left"
    return (
        "seen from above with the toes ahead, the big toe and the high side of the arch"
        f" lie on the {direction}"
    )


def _pose_notes(found: LevelFoot, frame: Frame) -> tuple[str, ...]:
    """How the pose was decided, and what was missing for it."""
    notes: list[str] = []
    if frame == "unknown":
        up, ahead = (_direction(found.source2insole[row, :3]) for row in (2, 1))
        notes.append(
            f"The sole faces {_direction(-found.source2insole[2, :3])} and the toes point along"
            f" {ahead} of the file (the back of the foot along {up}): of all ways the surface"
            " could stand, this one looks most like a foot."
        )
    if not found.toes_told_apart:
        notes.append(
            "The tip of the 2nd toe does not stand out; the foot axis runs to its usual place."
        )
    return tuple(notes)


def _direction(vector: FloatArray) -> str:
    """The axis nearest to a direction, for example "-z"."""
    axis = int(np.abs(vector).argmax())
    return ("-" if vector[axis] < 0 else "+") + "xyz"[axis]
