"""What is in doubt about a foot that was found in a surface: its size, its pose, its side."""

from __future__ import annotations

from collections.abc import Iterator

from insole_core.foot.foot_candidate import CLEAR, FootCandidate, FoundFoot
from insole_core.foot.foot_proportions import Proportions, is_within, proportions
from insole_core.foot.levelling import at_origin, is_cut_before
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rotation_angle_deg
from insole_core.messages import Message, joined

USUAL_LENGTH_MM = (110.0, 320.0)
"""EU 17 to 49."""
HELD_DEG = 45.0
"""Largest rotation of a foot in a frame whose directions are known."""
_USUAL_BALL_TO_LENGTH, _USUAL_HEEL_TO_BALL = (0.31, 0.47), (0.52, 0.84)
_MOST_MIDFOOT_TO_BALL = 1.0


def foot_doubts(found: FoundFoot, side: Side | None) -> Iterator[Message]:
    """Say what has to be asked before the most likely candidate is taken, a sentence each.

    Parameters
    ----------
    found
    side
        Which foot it is, where that is known.
    """
    nearest = found.candidates[0]
    likely = nearest if side is None else found.best(side) or nearest
    if _lacks_toes(found, nearest) or (likely is not nearest and _lacks_toes(found, likely)):
        yield Message(
            "The toes seem to be missing, so that the length of the foot is not known: "
            "{surface_mm:.0f} mm of it were scanned. Scan the foot with its toes, or give its "
            "length.",
            surface_mm=likely.surface_mm,
        )
    yield from _size_doubts(proportions(_placed(found, likely), likely.length_mm), likely)
    yield from _pose_doubts(found, likely, side)
    if side is None and found.told_side is None:
        yield _side_doubt(found)


def _placed(found: FoundFoot, candidate: FootCandidate) -> TriangleMesh:
    return found.mesh.transformed(at_origin(found.mesh, candidate.source2insole))


def _lacks_toes(found: FoundFoot, candidate: FootCandidate) -> bool:
    if not candidate.is_length_known:
        return True
    placed = found.even.transformed(at_origin(found.mesh, candidate.source2insole))
    return is_cut_before(placed.points)


def _size_doubts(sizes: Proportions, candidate: FootCandidate) -> Iterator[Message]:
    """Say what is unusual for a foot."""
    length_mm = sizes.length_mm
    if candidate.is_length_known and not is_within(length_mm, USUAL_LENGTH_MM):
        yield Message(
            "The foot would be {length_mm:.0f} mm long, which few feet are; check the unit.",
            length_mm=length_mm,
        )
    ball, heel = sizes.ball_mm / length_mm, sizes.heel_mm / max(sizes.ball_mm, 1e-9)
    narrow_waist = sizes.midfoot_mm <= _MOST_MIDFOOT_TO_BALL * sizes.ball_mm
    usual = is_within(ball, _USUAL_BALL_TO_LENGTH) and is_within(heel, _USUAL_HEEL_TO_BALL)
    if not (usual and narrow_waist):
        yield Message(
            "The proportions are unusual for a foot: {scanned_mm:.0f} mm long, {ball_mm:.0f} mm "
            "wide at the ball, {midfoot_mm:.0f} mm in the middle, {heel_mm:.0f} mm at the heel; "
            "see that it is one whole foot.",
            scanned_mm=sizes.scanned_mm,
            ball_mm=sizes.ball_mm,
            midfoot_mm=sizes.midfoot_mm,
            heel_mm=sizes.heel_mm,
        )


def _pose_doubts(found: FoundFoot, likely: FootCandidate, side: Side | None) -> Iterator[Message]:
    limit = CLEAR * likely.dissimilarity
    others = [
        Message("a {side} one, {length}", side=other.side, length=other.length_text)
        for other in found.candidates
        if side in (None, other.side)
        and other.dissimilarity < limit
        and differ(other.source2insole, [likely.source2insole])
    ]
    if others:
        yield Message(
            "The foot may lie in another way as well: taken is a {side} foot, {length}, turned "
            "otherwise it is {others}; see that heel, toes and sole are right.",
            side=likely.side,
            length=likely.length_text,
            others=joined(dict.fromkeys(others), " / "),  # ways that read alike are said once
        )


def _side_doubt(found: FoundFoot) -> Message:
    left, right = (found.best(side) for side in Side)
    return Message(
        "The shape does not tell left from right (a left foot, {left}, or a right one, {right}); "
        "say which foot it is.",
        left="" if left is None else left.length_text,
        right="" if right is None else right.length_text,
    )


def differ(source2rough: FloatArray, frames: list[FloatArray]) -> bool:
    """Return whether a frame (4, 4) is turned far from all of some others."""
    turns = (source2rough[:3, :3] @ frame[:3, :3].T for frame in frames)
    return all(rotation_angle_deg(turn) > HELD_DEG for turn in turns)
