"""Whether a reconstructed foot is of the side that was recorded."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from insole_core.errors import InputError
from insole_core.foot.foot_candidate import CLEAR, CLEAR_WITHOUT_TOES, NO_FOOT
from insole_core.foot.levelling import level
from insole_core.foot.pose import poses_as_it_lies, surface_points
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.sampling import EvenSurface
from insole_core.geometry.side import Side
from insole_core.messages import Message

_LEAST_SOLE_MM2 = 5000.0
_GROUND_FACING = -0.5


def side_doubt(mesh: TriangleMesh, side: Side, *, is_by_hand: bool = False) -> str:
    """Return a warning when the shape is not that of the recorded foot.

    Parameters
    ----------
    mesh : mm, reference frame
    side
        As the session says.
    is_by_hand
        Whether its corrections say so, and no longer its manifest.

    Returns
    -------
    str
        A sentence; empty when the shape agrees or has no sole.
    """
    dissimilarity = _dissimilarity(mesh)
    if not dissimilarity:
        return ""
    if min(dissimilarity.values()) > NO_FOOT:
        return (
            "What was measured in the volume of interest does not look like a foot; see that a "
            "foot was in place, and that the volume holds nothing else."
        )
    if _tells(mesh, dissimilarity, side.other):
        return Message(
            "The session says that it is a {side} foot, but the shape looks like a "
            '{shape_side} one; ask which foot it is, and correct "side" in {file} if need be.',
            side=side,
            shape_side=side.other,
            file="marker_edits.json" if is_by_hand else "manifest.json",
        )
    return ""


def seen_side(mesh: TriangleMesh) -> Side | None:
    """Return which foot the shape clearly is; None when it does not tell.

    Parameters
    ----------
    mesh : mm, reference frame
    """
    dissimilarity = _dissimilarity(mesh)
    if not dissimilarity or min(dissimilarity.values()) > NO_FOOT:
        return None
    return next((side for side in Side if _tells(mesh, dissimilarity, side)), None)


def _tells(mesh: TriangleMesh, dissimilarity: Mapping[Side, float], side: Side) -> bool:
    """Return whether the shape is clearly that of a side; without toes it must be so by far."""
    ratio = dissimilarity[side.other] / dissimilarity[side]
    return ratio > CLEAR_WITHOUT_TOES or (ratio > CLEAR and _shows_toes(mesh, side))


def _shows_toes(mesh: TriangleMesh, side: Side) -> bool:
    try:
        return level(EvenSurface.of(mesh), side, np.eye(4)).second_toe_found
    except InputError:
        return False


def _dissimilarity(mesh: TriangleMesh) -> dict[Side, float]:
    """Return how unlike a foot of each side the shape is; empty when it has no sole."""
    facing_ground = mesh.vertex_normals[:, 2] < _GROUND_FACING
    if mesh.vertex_areas[facing_ground].sum() < _LEAST_SOLE_MM2:
        return {}
    poses = list(poses_as_it_lies(surface_points(mesh), np.eye(4)))
    return {
        side: min(pose.side_dissimilarity for pose in poses if pose.side is side) for side in Side
    }
