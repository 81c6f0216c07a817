"""The line of the 1st and 5th metatarsal heads, over which the foot rolls."""

from __future__ import annotations

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import HEADS, find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.primitives.height_field import HeightField


def heads_mm(foot: Foot) -> FloatArray:
    """Return the places (2, 2) of heads 1 and 5, mm, insole frame."""
    marks = find_landmarks(foot)
    return np.array([marks[name].point[:2] for name in (HEADS[0], HEADS[-1])])


def heads_ahead(foot: Foot) -> FloatArray:
    """Return the unit vector (2,) that points ahead, normal to the line of heads 1 and 5."""
    medial, lateral = heads_mm(foot)
    along = (medial - lateral) / np.hypot(*(medial - lateral))
    return np.array([-along[1], along[0]]) * foot.side.medial_sign


def ahead_of_heads_mm(foot: Foot, field: HeightField) -> FloatArray:
    """Return how far the nodes of a field lie ahead of the line of heads 1 and 5, (ny, nx), mm."""
    ahead, (medial, _) = heads_ahead(foot), heads_mm(foot)
    return np.asarray(ahead[0] * field.x_mm + ahead[1] * field.y_mm[:, None] - ahead @ medial)
