"""Make a foot of a scanned surface: bring it to the insole frame and check its side."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from insole_core.errors import InputError, InsoleError
from insole_core.foot.foot import Foot
from insole_core.foot.foot_proportions import check_length, check_proportions
from insole_core.foot.levelling import OUTLINE_HEIGHT_MM, LevelFoot, at_origin, is_cut_behind, level
from insole_core.foot.pose import Pose, find_poses, poses_as_it_lies, surface_points
from insole_core.foot.scraps import without_scraps
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.even_surface import EvenSurface
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rotation_angle_deg, transform
from insole_core.messages import Message

Frame = Literal["reference", "unknown"]

_CLEAR = 1.25
"""Least ratio of the two dissimilarities at which the shape determines the side."""
_NO_FOOT = 0.6
"""Dissimilarity from which on the surface is not a foot."""

_HELD_DEG = 45.0
"""Largest rotation of a foot in a frame whose directions are known."""


class SideMismatchError(InsoleError):
    """The shape is that of the other foot.

    Parameters
    ----------
    asked
        The side that was asked for.
    reason
        What the shape shows.
    """

    def __init__(self, asked: Side, reason: str) -> None:
        super().__init__(
            "The shape looks like a {shape_side} foot ({reason}); take it as a {shape_side} one, "
            "or insist on {side}.",
            shape_side=asked.other,
            reason=reason,
            side=asked,
        )
        self.asked = asked


@dataclass(frozen=True, eq=False)
class _Candidate:
    """The surface as a foot of one side, levelled from its best pose."""

    pose: Pose
    foot: LevelFoot

    @property
    def side(self) -> Side:
        return self.pose.side


def place_foot(mesh: TriangleMesh, side: Side, *, frame: Frame, force: bool = False) -> Foot:
    """Bring a surface to the insole frame, without small pieces that float beside it.

    Parameters
    ----------
    mesh : mm, any frame
    side
        Which foot it is.
    frame
        "reference": toes towards +y and dorsal +z are known, and only the last degrees are found;
        "unknown": the surface may lie in any way.
    force
        Continue even if the shape looks like the other foot, or has unusual proportions.

    Returns
    -------
    Foot
        With notes on how pose and side were decided.

    Raises
    ------
    SideMismatchError
        When the shape is clearly that of the other foot, unless `force`.
    InputError
        When the surface does not look like a foot in any pose, has no sole, or, in an unknown
        frame, has a size that no foot has or, without `force`, proportions that none has.
    """
    mesh, scraps = without_scraps(mesh)
    points = surface_points(mesh)
    if frame == "unknown":
        poses = _foot_poses(mesh, points)
        mesh, inside_out = _outside_out(mesh, poses[0].source2rough)
    else:
        poses, inside_out = _near_frame(mesh, points), False
    even = EvenSurface.of(mesh)
    asked, other = (_best(even, points, poses, s) for s in (side, side.other))
    if asked.pose.side_dissimilarity > _CLEAR * other.pose.side_dissimilarity:
        if not force:
            raise SideMismatchError(side, _reason(other))
        # The directions of ground and toes follow from the shape, whatever the side.
        asked = _best(even, points, _as_it_lies(points, other.foot.source2insole), side)
    found = asked.foot
    source2insole = at_origin(mesh, found.source2insole)
    placed = even.transformed(source2insole)
    standing = mesh.transformed(source2insole)
    if frame == "unknown":
        check_length(found.length_mm)
        if not force:
            check_proportions(standing, transform(source2insole, points), found.length_mm)
    notes = (
        _side_note(asked, other),
        *_pose_notes(asked, frame),
        *_rear_notes(placed),
        *_surface_notes(scraps, inside_out),
    )
    foot = Foot(side, standing, source2insole, found.length_mm, notes)
    foot.derived.get("even", (), lambda: placed)
    return foot


def recognised_foot(mesh: TriangleMesh) -> Foot | None:
    """Place a surface of which nothing is known, if it is clearly a left or a right foot.

    Parameters
    ----------
    mesh : mm, any frame

    Returns
    -------
    Foot or None
        None for what looks like no foot or has no size of one, tells no side, or faces into the
        foot as an insole does.
    """
    whole, _ = without_scraps(mesh)
    points = surface_points(whole)
    try:
        poses = _foot_poses(whole, points)
    except InputError:
        return None
    if _outside_out(whole, poses[0].source2rough)[1]:
        return None
    even = EvenSurface.of(whole)
    try:
        found = sorted(
            (_best(even, points, poses, side) for side in Side),
            key=lambda candidate: candidate.pose.side_dissimilarity,
        )
    except InputError:
        return None
    nearest, other = (candidate.pose.side_dissimilarity for candidate in found)
    if other < _CLEAR * nearest:
        return None
    try:
        return place_foot(mesh, found[0].side, frame="unknown")
    except (InputError, SideMismatchError):  # of a size or proportions that no foot has
        return None


def _foot_poses(mesh: TriangleMesh, points: FloatArray) -> list[Pose]:
    """Find the possible poses, the most likely first, which must look like a foot."""
    poses = find_poses(mesh, points)
    if poses[0].side_dissimilarity > _NO_FOOT:
        raise InputError(
            "The surface looks like no foot, whichever way it is turned;"
            " check that the file holds a foot or its sole, and nothing else."
        )
    return poses


def _outside_out(mesh: TriangleMesh, source2rough: FloatArray) -> tuple[TriangleMesh, bool]:
    """Flip an open surface whose sole faces into the foot, which only the pose can show."""
    up = source2rough[2, :3]
    height = mesh.vertices @ up
    low = mesh.part(height < height.min() + OUTLINE_HEIGHT_MM)
    faces_up = bool(low.vertex_areas @ (low.vertex_normals @ up) > 0)
    return (mesh.flipped() if faces_up else mesh), faces_up


def _as_it_lies(points: FloatArray, source2rough: FloatArray) -> list[Pose]:
    """Return the poses of a surface whose directions are known, the most likely first."""
    return sorted(poses_as_it_lies(points, source2rough), key=lambda pose: pose.side_dissimilarity)


def _near_frame(mesh: TriangleMesh, points: FloatArray) -> list[Pose]:
    """Return the poses of a surface that lies as its frame says, or up to `_HELD_DEG` off."""
    poses = _as_it_lies(points, np.eye(4))
    if poses[0].side_dissimilarity <= _NO_FOOT:
        return poses
    held = [
        pose
        for pose in find_poses(mesh, points)
        if rotation_angle_deg(pose.source2rough[:3, :3]) < _HELD_DEG
    ]
    return held if held and held[0].side_dissimilarity < poses[0].side_dissimilarity else poses


def _best(surface: EvenSurface, points: FloatArray, poses: list[Pose], side: Side) -> _Candidate:
    """Level the surface as a foot of one side, and rate its similarity in the levelled pose."""
    rough = next(pose for pose in poses if pose.side is side)
    foot = level(surface, side, rough.source2rough, rough.covered)
    levelled = next(
        pose
        for pose in poses_as_it_lies(points, foot.source2insole)
        if (pose.side, pose.covered) == (side, rough.covered)
    )
    return _Candidate(levelled, foot)


def _side_note(asked: _Candidate, other: _Candidate) -> str:
    ratio = other.pose.side_dissimilarity / asked.pose.side_dissimilarity
    if ratio < 1 / _CLEAR:
        return Message(
            "The shape looks like a {shape_side} foot ({reason}); taken as a {side} one by force.",
            shape_side=other.side,
            reason=_reason(other),
            side=asked.side,
        )
    if ratio < _CLEAR:
        return Message(
            "The shape does not tell left from right; taken as a {side} foot as asked.",
            side=asked.side,
        )
    return Message(
        "A {side} foot by its shape: {reason} (margin {ratio:.1f} to 1).",
        side=asked.side,
        reason=_reason(asked),
        ratio=ratio,
    )


def _reason(candidate: _Candidate) -> str:
    direction = "right" if candidate.side.medial_sign > 0 else "left"
    return Message(
        "seen from above with the toes ahead, the big toe and the high side of the arch "
        "lie on the {direction}",
        direction=direction,
    )


def _pose_notes(found: _Candidate, frame: Frame) -> Iterator[str]:
    """Say how the pose was decided, and what was missing for it."""
    if frame == "unknown":
        yield (
            "The file does not say how the foot lies: of all ways it could stand, the one that"
            " looks most like a foot was taken."
        )
    if found.pose.covered < 1:
        yield (
            Message(
                "The toes are missing; the foot's length was estimated as {length_mm:.0f} mm "
                "from the rest.",
                length_mm=found.foot.length_mm,
            )
        )
    elif not found.foot.second_toe_found:
        yield "The tip of the 2nd toe does not stand out; the foot axis runs to its usual place."


def _rear_notes(surface: EvenSurface) -> Iterator[str]:
    if is_cut_behind(surface.points):
        yield (
            "The heel is missing, or cut off behind; lengths and everything placed from the heel"
            " are guesses. Scan the foot again with its heel."
        )


def _surface_notes(scraps: int, inside_out: bool) -> Iterator[str]:
    if inside_out:
        yield "The surface was inside out and has been turned."
    if scraps:
        what = "piece that floats" if scraps == 1 else "pieces that float"
        yield Message("{count} small {scraps} beside the foot left out.", count=scraps, scraps=what)
