"""A rocker: the underside rises ahead of a line along the heads."""

from __future__ import annotations

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import HEADS, find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.elements import Rocker
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.blending import smooth_hinge
from insole_core.insole.primitives.height_field import HeightField

LEAST_LEFT_MM = 1.5
"""Thickness that a rocker leaves; ahead of there the underside follows the upper side."""
_BEND_MM = 6.0  # distance from the line over which the underside bends


def rocker_heights_mm(design: InsoleDesign, foot: Foot, field: HeightField) -> FloatArray:
    """Return by how much the rockers of a design ask the underside to rise, (ny, nx), mm."""
    ahead = ahead_of_heads_mm(foot, field)
    asked = [
        np.tan(np.radians(rocker.slope_deg))
        * smooth_hinge(ahead + rocker.behind_heads_mm, _BEND_MM)
        for rocker in design.of(Rocker)
    ]
    return np.asarray(np.max([np.zeros_like(ahead), *asked], axis=0))


def eased(bottom_mm: FloatArray, top_mm: FloatArray, rise_mm: FloatArray) -> FloatArray:
    """Return an underside raised by a rocker, as far as the thickness allows.

    Parameters
    ----------
    bottom_mm, top_mm, rise_mm : (ny, nx) float64, mm
    """
    highest = np.maximum(top_mm - LEAST_LEFT_MM, bottom_mm)
    return np.minimum(bottom_mm + rise_mm, highest)


def ahead_of_heads_mm(foot: Foot, field: HeightField) -> FloatArray:
    """Return how far the nodes of a field lie ahead of the line of heads 1 and 5, (ny, nx), mm."""
    ahead, (medial, _) = heads_ahead(foot), _heads(foot)
    return np.asarray(ahead[0] * field.x_mm + ahead[1] * field.y_mm[:, None] - ahead @ medial)


def heads_ahead(foot: Foot) -> FloatArray:
    """Return the unit vector (2,) that points ahead, normal to the line of heads 1 and 5."""
    medial, lateral = _heads(foot)
    along = (medial - lateral) / np.hypot(*(medial - lateral))
    return np.array([-along[1], along[0]]) * foot.side.medial_sign


def rocker_line(foot: Foot, rocker: Rocker) -> FloatArray:
    """Return the ends (2, 2), mm, insole frame, of a rocker's line: behind heads 1 and 5."""
    return _heads(foot) - rocker.behind_heads_mm * heads_ahead(foot)


def _heads(foot: Foot) -> FloatArray:
    """Return the places (2, 2) of heads 1 and 5, mm, insole frame."""
    marks = find_landmarks(foot)
    return np.array([marks[name].point[:2] for name in (HEADS[0], HEADS[-1])])
