"""Posts below a shell: bodies that are level on the ground, with inclined walls, rounded below."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.build import Insole
from insole_core.insole.prescription.shell import Post
from insole_core.insole.primitives.height_field import HeightField, ahead_of_heads_mm

INSET_MM = 5.0
"""How far the foot of a post's wall lies inside the edge of the insole."""
POST_BAND_MM = 14.0
"""Beyond this distance from the edge of the insole the foot of every post's wall is reached."""
_WALL = np.radians(65.0)  # of the walls against the ground
_CORNER_MM = 8.0  # radius of the corners, seen from above
_AHEAD_OF_HEADS_MM = 8.0
_USUAL_LENGTH = {"rearfoot": 0.25, "forefoot": 0.12}  # shares of the foot's length


@dataclass(frozen=True, eq=False)
class PostPlan:
    """Where posts may stand: distances at the nodes of a field, mm.

    Parameters
    ----------
    inside : (ny, nx) float64
        From the edge of the insole.
    before_heel : (ny, 1) float64
        From the rear end of the insole.
    behind_front : (ny, nx) float64
        From the front end of a forefoot post.
    """

    inside: FloatArray
    before_heel: FloatArray
    behind_front: FloatArray


def post_length_mm(post: Post, foot_length_mm: float) -> float:
    """Return the length of a post: its own, or the usual one of its region."""
    if post.length_mm is not None:
        return post.length_mm
    return _USUAL_LENGTH[post.region] * foot_length_mm


def post_underside(post: Post, plan: PostPlan, foot_length_mm: float) -> FloatArray:
    """Return the height of a post's underside and walls over the ground, (ny, nx), mm.

    Its walls go on rising beside it, so that the lower one of this and of a shell's underside is
    the underside of both.
    """
    length_mm = post_length_mm(post, foot_length_mm)
    sides = [plan.inside - INSET_MM]
    if post.region == "rearfoot":
        sides.append(length_mm - plan.before_heel)
    else:
        sides += [plan.behind_front, length_mm - plan.behind_front]
    return _wall_mm(_rounded_inside(sides), post.edge_radius_mm)


def behind_heads_mm(insole: Insole, field: HeightField) -> FloatArray:
    """Return how far nodes lie behind a line ahead of the heads 1 and 5, (ny, nx), mm."""
    return np.asarray(_AHEAD_OF_HEADS_MM - ahead_of_heads_mm(insole.foot, field))


def _rounded_inside(sides: list[FloatArray]) -> FloatArray:
    """Return the distance inside an area, from those inside its sides; its corners are round."""
    short = [np.maximum(_CORNER_MM - side, 0) for side in sides]
    return np.asarray(_CORNER_MM - np.sqrt(sum(s * s for s in short)))


def _wall_mm(inside_mm: FloatArray, radius_mm: float) -> FloatArray:
    """Return the height of ground and wall at distances inside the foot of the wall."""
    begin = radius_mm * np.tan(_WALL / 2)
    end = begin - radius_mm * np.sin(_WALL)
    on_arc = np.clip(begin - inside_mm, 0, begin - end)
    arc = radius_mm - np.sqrt(np.maximum(radius_mm**2 - on_arc**2, 0))
    return np.asarray(arc + np.tan(_WALL) * np.maximum(end - inside_mm, 0))
