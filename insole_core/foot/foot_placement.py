"""Make a foot of a scanned surface: bring it to the insole frame and check its side."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from insole_core.errors import InputError, InsoleError
from insole_core.foot.clicked_pose import clicked_frames
from insole_core.foot.foot import Foot
from insole_core.foot.foot_candidate import (
    CLEAR,
    CLEAR_WITHOUT_TOES,
    NO_FOOT,
    FootCandidate,
    FoundFoot,
    PoseClicks,
)
from insole_core.foot.foot_doubts import HELD_DEG, differ, foot_doubts
from insole_core.foot.foot_proportions import check_length, check_proportions, proportions
from insole_core.foot.front_height import rated_pose
from insole_core.foot.leg import is_leg, leg_of, without_leg
from insole_core.foot.levelling import (
    OUTLINE_HEIGHT_MM,
    at_origin,
    is_cut_behind,
    level,
)
from insole_core.foot.missing_sole import closed_sole
from insole_core.foot.pose import (
    Pose,
    find_poses,
    poses_as_it_lies,
    surface_points,
    surface_samples,
    turned_poses,
)
from insole_core.foot.scraps import without_scraps
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.far_away import far_origin
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import noise_mm, without_noise
from insole_core.geometry.sampling import EvenSurface
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_about, rotation_angle_deg
from insole_core.imprints.form import Form
from insole_core.messages import Message
from insole_core.scans.cleaning import INSIDE_OUT

Frame = Literal["reference", "unknown"]

_TOE_YAWS_DEG = (4.0, -4.0)
_MOST_WAYS = 4
_NOISY_MM = 0.4  # noise of a surface from which on it is told


class DoubtfulScanError(InputError):
    """How a foot lies, or whether it is one, has to be decided by a user."""


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
    if frame == "unknown":
        return _checked_foot(find_foot(mesh), side, force=force)
    found = _held_foot(mesh)
    return placed_foot(found, _of_side(found, side), force=force)


def _checked_foot(found: FoundFoot, side: Side, *, force: bool = False) -> Foot:
    """Bring a foot that lay in any way to the insole frame, if it has a size and shape of one."""
    candidate = _of_side(found, side)
    foot = placed_foot(found, candidate, force=force)
    check_length(foot.length_mm, candidate.part_mm, force=force)
    if not force:
        check_proportions(proportions(foot.mesh, foot.length_mm))
    return foot


def _of_side(found: FoundFoot, side: Side) -> FootCandidate:
    return next(one for one in found.candidates if one.side is side)


def find_foot(
    mesh: TriangleMesh, side: Side | None = None, pose: PoseClicks | None = None
) -> FoundFoot:
    """Find how a surface that lies in any way can be a left or a right foot.

    Parameters
    ----------
    mesh : mm, any frame
    side
        Which foot it is, where that is known and need not be doubted.
    pose
        How it lies, where that is known by clicked points.

    Returns
    -------
    FoundFoot
        With a candidate of either side, and further ones where it may lie in other ways.

    Raises
    ------
    InputError
        When the surface does not look like a foot in any pose, or has no sole.
    """
    if (origin := far_origin(mesh.vertices)).any():
        near = mesh.transformed(rigid(np.eye(3), -origin))
        return find_foot(near, side, None if pose is None else pose.moved(-origin)).moved(origin)
    return _find(mesh, side, pose)


def _find(
    mesh: TriangleMesh,
    side: Side | None = None,
    pose: PoseClicks | None = None,
    known: FoundFoot | None = None,
) -> FoundFoot:
    """Find a foot near the origin; what is known of the same surface is not computed again."""
    mesh, scraps = without_scraps(mesh)
    standing = _standing_foot(mesh)
    if standing is not None:
        mesh = standing.mesh
    points, normals = surface_samples(mesh)
    if pose is not None:
        poses = _clicked_poses(points, normals, pose)
    elif standing is not None:
        poses = _like_a_foot(standing.poses)
    else:
        poses = _foot_poses(mesh, points)
    poses = sorted((rated_pose(one, points, normals) for one in poses), key=_dissimilarity)
    mesh, inside_out = _outside_out(mesh, poses[0].source2rough)
    notes = (_pose_note(pose), *_surface_notes(scraps, inside_out))
    shows_pulps = standing is None  # a plane has none
    found = _found(mesh, points, poses, notes, normals, shows_pulps=shows_pulps, known=known)
    if pose is None:
        found = _with_other_ways(found, points, normals, poses, shows_pulps)
    return replace(
        found,
        candidates=tuple(_with_leg(found, one) for one in found.candidates),
        doubts=tuple(foot_doubts(found, side)),
        warnings=() if standing is None else (_no_sole(),),
    )


def find_pressed_foot(mesh: TriangleMesh, dorsal: FloatArray) -> FoundFoot:
    """Find how the sole of an imprint can be a left or a right foot.

    Parameters
    ----------
    mesh : mm, any frame
        Its triangles face out of the foot.
    dorsal : (3,) float64
        Unit vector out of the foam, towards the back of the foot.

    Returns
    -------
    FoundFoot
        With a candidate of either side.

    Raises
    ------
    InputError
        When the surface does not look like a foot either way.
    """
    if (origin := far_origin(mesh.vertices)).any():
        near = mesh.transformed(rigid(np.eye(3), -origin))
        return find_pressed_foot(near, dorsal).moved(origin)
    points = surface_points(mesh)
    return _found(mesh, points, _foot_poses(mesh, points, dorsal))


def placed_foot(found: FoundFoot, candidate: FootCandidate, *, force: bool = False) -> Foot:
    """Bring a found foot to the insole frame as one of its candidates.

    Raises
    ------
    SideMismatchError
        When the shape is clearly that of the other foot, unless `force`.
    """
    other = found.best(candidate.side.other)
    is_other = other is not None and candidate.dissimilarity > other.clear * other.dissimilarity
    if other is not None and is_other and not force:
        raise SideMismatchError(candidate.side, _reason(other))
    source2insole = at_origin(found.steady, candidate.source2insole)
    placed = found.even.transformed(source2insole)
    notes = (
        *_side_notes(candidate, other),
        *_candidate_notes(candidate),
        *_rear_notes(placed),
        *_noise_notes(found),
        *found.notes,
    )
    mesh = found.mesh.transformed(source2insole)
    is_steady = found.steady is found.mesh
    measured = mesh if is_steady else found.steady.transformed(source2insole)
    if candidate.leg is not None:
        mesh, measured = (without_leg(one, candidate.leg) for one in (mesh, measured))
        placed = placed.part(~is_leg(placed.points, candidate.leg))
    foot = Foot(candidate.side, mesh, source2insole, candidate.length_mm, notes)
    foot.derived.get("even", (), lambda: placed)
    foot.derived.get("measured", (), lambda: measured)
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
    origin = far_origin(mesh.vertices)
    if origin.any():
        near = recognised_foot(mesh.transformed(rigid(np.eye(3), -origin)))
        back = rigid(np.eye(3), -origin)
        return None if near is None else replace(near, source2insole=near.source2insole @ back)
    whole, _ = without_scraps(mesh)
    points = surface_points(whole)
    try:
        poses = _foot_poses(whole, points)
        if _outside_out(whole, poses[0].source2rough)[1]:
            return None
        found = _found(whole, points, poses)
    except InputError:
        return None
    side = found.told_side
    if side is None:
        return None
    try:
        return _checked_foot(_find(mesh, known=found), side)
    except (InputError, SideMismatchError):  # of a size or proportions that no foot has
        return None


def is_of_other_side(foot: Foot) -> bool:
    """Return whether the shape of a foot is clearly that of the other one.

    Somebody insisted on its side, or exchanged the names of two scans. A form under load tells too
    little, and nothing is said of what lies like no foot.
    """
    if foot.form is not Form.FOOT:
        return False
    return foot.derived.get("other side", (), lambda: _shows_other_side(foot))


def _shows_other_side(foot: Foot) -> bool:
    points, other = surface_points(foot.mesh), foot.side.other
    ahead, back = (
        {pose.side: pose.side_dissimilarity for pose in turned_poses(points, rotation)}
        for rotation in (np.eye(3), np.diag([-1.0, -1.0, 1.0]))
    )
    ratio = ahead[foot.side] / ahead[other]
    # One that was turned by hand with its toes back looks like the other foot until it is mended.
    if ahead[other] > NO_FOOT or min(ahead[foot.side], back[foot.side]) <= ahead[other]:
        return False  # as nearly always
    if ratio > CLEAR_WITHOUT_TOES:
        return True
    poses = _as_it_lies(points, np.eye(4))
    try:
        own, opposite = (_best(foot.even, points, poses, side) for side in (foot.side, other))
    except InputError:  # nothing faces the ground: it was turned so
        return False
    return own.dissimilarity > opposite.clear * opposite.dissimilarity


def _held_foot(mesh: TriangleMesh) -> FoundFoot:
    """Find a foot that lies as its frame says."""
    mesh, scraps = without_scraps(mesh)
    points = surface_points(mesh)
    return _found(mesh, points, _near_frame(mesh, points), tuple(_surface_notes(scraps, False)))


def _found(
    mesh: TriangleMesh,
    points: FloatArray,
    poses: list[Pose],
    notes: tuple[str, ...] = (),
    normals: FloatArray | None = None,
    *,
    shows_pulps: bool = True,
    known: FoundFoot | None = None,
) -> FoundFoot:
    """Level the surface as a foot of either side."""
    if known is not None and known.mesh is mesh:
        steady, even = known.steady, known.even
    else:
        steady = without_noise(mesh)
        even = EvenSurface.of(steady)
    nearest, other = sorted(
        (_best(even, points, poses, side, normals, shows_pulps=shows_pulps) for side in Side),
        key=lambda one: one.dissimilarity,
    )
    if normals is not None:
        nearest = _by_second_toe(even, nearest, shows_pulps)
    if other.dissimilarity > CLEAR * nearest.dissimilarity:
        # The directions of ground and toes follow from the shape, whatever the side.
        poses = _as_it_lies(points, nearest.source2insole)
        again = _best(even, points, poses, other.side, shows_pulps=shows_pulps)
        other = replace(again, dissimilarity=other.dissimilarity)
    return FoundFoot(mesh, steady, even, (nearest, other), notes=notes)


def _foot_poses(
    mesh: TriangleMesh, points: FloatArray, dorsal: FloatArray | None = None
) -> list[Pose]:
    """Find the possible poses, the most likely first, which must look like a foot."""
    return _like_a_foot(find_poses(mesh, points, dorsal))


def _like_a_foot(poses: list[Pose]) -> list[Pose]:
    if poses[0].side_dissimilarity > NO_FOOT:
        raise InputError(
            "The surface looks like no foot, whichever way it is turned;"
            " check that the file holds a foot or its sole, and nothing else."
        )
    return poses


@dataclass(frozen=True, eq=False)
class _StandingFoot:
    """A foot without a sole, closed by a plane, and its possible poses, the most likely first."""

    mesh: TriangleMesh
    poses: list[Pose]


def _standing_foot(mesh: TriangleMesh) -> _StandingFoot | None:
    """Return a foot without a sole, closed; None for what looks more like a foot as it is."""
    closed = closed_sole(mesh)
    if closed is None:
        return None
    standing = find_poses(closed.mesh, surface_points(closed.mesh), closed.dorsal)
    as_it_is = find_poses(mesh, surface_points(mesh))
    if standing[0].side_dissimilarity >= as_it_is[0].side_dissimilarity:
        return None
    return _StandingFoot(closed.mesh, standing)


def _clicked_poses(points: FloatArray, normals: FloatArray, clicks: PoseClicks) -> list[Pose]:
    """Return the poses that agree with clicked points, the most likely first."""
    frames = clicked_frames(points, normals, clicks)
    return [pose for frame in frames for pose in turned_poses(points, frame[:3, :3])]


def _dissimilarity(pose: Pose) -> float:
    return pose.side_dissimilarity


def _with_other_ways(
    found: FoundFoot,
    points: FloatArray,
    normals: FloatArray,
    poses: list[Pose],
    shows_pulps: bool,
) -> FoundFoot:
    """Add candidates that lie in another way and look nearly as much like a foot."""
    nearest = found.candidates[0]
    limit = min(CLEAR * nearest.dissimilarity, NO_FOOT)
    ways = list(found.candidates)
    tried: list[FloatArray] = [way.source2insole for way in ways]
    for pose in poses:
        if len(tried) == _MOST_WAYS or pose.side_dissimilarity > limit:
            break
        if differ(pose.source2rough, tried):
            tried.append(pose.source2rough)
            try:
                way = _best(found.even, points, [pose], pose.side, normals, shows_pulps=shows_pulps)
            except InputError:  # nothing faces the ground: it cannot lie like this
                continue
            if way.dissimilarity <= limit:
                ways.append(way)
    return replace(found, candidates=tuple(sorted(ways, key=lambda one: one.dissimilarity)))


def _with_leg(found: FoundFoot, candidate: FootCandidate) -> FootCandidate:
    """Return a candidate with the leg that is to be cut off."""
    placed = found.even.transformed(at_origin(found.mesh, candidate.source2insole))
    return replace(candidate, leg=leg_of(placed, candidate.length_mm))


def _pose_note(clicks: PoseClicks | None) -> Message:
    if clicks is not None:
        return Message("The foot lies as heel, toe and sole were clicked.")
    return Message(
        "The file does not say how the foot lies: of all ways it could stand, the one that"
        " looks most like a foot was taken."
    )


def _no_sole() -> Message:
    return Message(
        "The scan shows no sole: the foot stood on something that was left out. A plane closes it, "
        "so the arch is not known; scan the foot from below as well, or design the arch by hand."
    )


def _outside_out(mesh: TriangleMesh, source2rough: FloatArray) -> tuple[TriangleMesh, bool]:
    """Flip an open surface whose sole faces into the foot, which only the pose can show."""
    up = source2rough[2, :3]
    height = mesh.vertices @ up - float((mesh.vertices @ up).min())
    low = mesh.part(height < min(OUTLINE_HEIGHT_MM, height.max() / 2))  # below the lid of a cast
    faces_up = bool(low.vertex_areas @ (low.vertex_normals @ up) > 0)
    return (mesh.flipped() if faces_up else mesh), faces_up


def _as_it_lies(points: FloatArray, source2rough: FloatArray) -> list[Pose]:
    """Return the poses of a surface whose directions are known, the most likely first."""
    poses = poses_as_it_lies(points, source2rough)
    return sorted(poses, key=lambda pose: pose.side_dissimilarity + pose.wrong_front)


def _near_frame(mesh: TriangleMesh, points: FloatArray) -> list[Pose]:
    """Return the poses of a surface that lies as its frame says, or up to `HELD_DEG` off."""
    poses = _as_it_lies(points, np.eye(4))
    if poses[0].side_dissimilarity <= NO_FOOT:
        return poses
    held = [
        pose
        for pose in find_poses(mesh, points)
        if rotation_angle_deg(pose.source2rough[:3, :3]) < HELD_DEG
    ]
    return held if held and held[0].side_dissimilarity < poses[0].side_dissimilarity else poses


def _best(
    surface: EvenSurface,
    points: FloatArray,
    poses: list[Pose],
    side: Side,
    normals: FloatArray | None = None,
    *,
    shows_pulps: bool = True,
) -> FootCandidate:
    """Level the surface as a foot of one side, and rate its similarity in the levelled pose."""
    rough = next(pose for pose in poses if pose.side is side)
    foot = level(surface, side, rough.source2rough, rough.covered, shows_pulps=shows_pulps)
    levelled = next(
        pose
        for pose in poses_as_it_lies(points, foot.source2insole)
        if (pose.side, pose.covered) == (side, rough.covered)
    )
    if normals is not None:
        levelled = rated_pose(levelled, points, normals)
    return FootCandidate(
        side,
        foot.source2insole,
        foot.length_mm,
        levelled.side_dissimilarity,
        rough.covered,
        foot.second_toe_found,
    )


def _by_second_toe(surface: EvenSurface, foot: FootCandidate, shows_pulps: bool) -> FootCandidate:
    """Look for the 2nd toe from either side of its usual place, so that chance does not decide."""
    if foot.second_toe_found or foot.covered < 1:
        return foot
    for yaw_deg in _TOE_YAWS_DEG:
        turned = rigid(rotation_about(np.array([0.0, 0.0, 1.0]), yaw_deg), np.zeros(3))
        try:
            other = level(surface, foot.side, turned @ foot.source2insole, shows_pulps=shows_pulps)
        except InputError:
            return foot
        if other.second_toe_found:
            return replace(
                foot,
                source2insole=other.source2insole,
                length_mm=other.length_mm,
                second_toe_found=True,
            )
    return foot


def _side_notes(asked: FootCandidate, other: FootCandidate | None) -> Iterator[str]:
    if other is None:
        return
    ratio = other.dissimilarity / asked.dissimilarity
    if ratio < 1 / other.clear:
        yield Message(
            "The shape looks like a {shape_side} foot ({reason}); taken as a {side} one by force.",
            shape_side=other.side,
            reason=_reason(other),
            side=asked.side,
        )
    elif ratio < asked.clear:
        yield Message(
            "The shape does not tell left from right; taken as a {side} foot as asked.",
            side=asked.side,
        )
    else:
        yield Message(
            "A {side} foot by its shape: {reason}.",
            side=asked.side,
            reason=_reason(asked),
        )


def _reason(shown: FootCandidate) -> Message:
    """Say by what a surface looks like a foot of the candidate's side."""
    if not shown.second_toe_found:  # where the big toe is, and whether there is one, is not seen
        return Message("seen from above, its outline is that of such a foot rather than another")
    direction = "right" if shown.side.medial_sign > 0 else "left"
    return Message(
        "seen from above with the toes ahead, the big toe and the high side of the arch "
        "lie on the {direction}",
        direction=direction,
    )


def _candidate_notes(found: FootCandidate) -> Iterator[str]:
    """Say what was missing to decide the pose."""
    if not found.is_length_known:
        yield "The toes are missing; the foot's length is a guess from the rest."
    elif not found.second_toe_found:
        yield "The tip of the 2nd toe does not stand out; the foot axis runs to its usual place."
    if found.leg is not None:
        yield Message(
            "The leg was cut off {height_mm:.0f} mm over the sole.", height_mm=found.leg.height_mm
        )


def _rear_notes(surface: EvenSurface) -> Iterator[str]:
    if is_cut_behind(surface.points):
        yield (
            "The heel is missing, or cut off behind; lengths and everything placed from the heel"
            " are guesses. Scan the foot again with its heel."
        )


def _noise_notes(found: FoundFoot) -> Iterator[str]:
    if found.steady is not found.mesh and (noise := noise_mm(found.mesh)) > _NOISY_MM:
        yield Message(
            "The surface is noisy, by about {noise_mm:.1f} mm; it was smoothed to be measured, and "
            "its measures are uncertain by as much.",
            noise_mm=noise,
        )


def _surface_notes(scraps: int, inside_out: bool) -> Iterator[str]:
    if inside_out:
        yield Message(INSIDE_OUT)
    if scraps:
        what = "piece that floats" if scraps == 1 else "pieces that float"
        yield Message("{count} small {scraps} beside the foot left out.", count=scraps, scraps=what)
