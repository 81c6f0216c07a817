"""What a finish changes in the contact surface itself: expansion, arch fill, folds of the skin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.fields import Place
from insole_core.insole.finishing.edge import Edge
from insole_core.insole.primitives.blending import smoother_step
from insole_core.insole.primitives.height_field import HeightField

# Shares of the foot's length, from the heel.
_HEEL_CENTRE, _HEEL_END = 0.15, 0.2
_MEDIAL_EXPANSION, _LATERAL_EXPANSION = (0.25, 0.40), (0.60, 0.72)
_STILL = 0.25
"""Share of the half width about the middle that an expansion leaves as it is."""
_LEAST_HALF_MM = 5.0


@dataclass(frozen=True, eq=False)
class Middle:
    """The line midway between the borders of an insole, in sections across.

    Parameters
    ----------
    middle_mm, half_mm : (ny, 1) float64
        Its x with medial = +x, and half the width there.
    medial_mm : (ny, nx) float64
        Distance of the nodes from it; positive medially.
    """

    middle_mm: FloatArray
    half_mm: FloatArray
    medial_mm: FloatArray

    @classmethod
    def of(cls, edge: Edge, field: HeightField, medial_sign: int) -> Middle:
        """Return the middle line of an edge in the rows of a field."""
        points = edge.points_mm * [medial_sign, 1.0]
        medial, lateral = points[edge.is_medial][::-1], points[~edge.is_medial]
        x = [
            np.interp(field.y_mm, np.maximum.accumulate(border[:, 1]), border[:, 0])
            for border in (medial, lateral)
        ]
        middle = (x[0] + x[1])[:, None] / 2
        half = np.maximum((x[0] - x[1])[:, None] / 2, _LEAST_HALF_MM)
        return cls(middle, half, medial_sign * field.x_mm - middle)


def expanded(
    field: HeightField, middle: Middle, expansion_mm: float, medial_sign: int, length_mm: float
) -> FloatArray:
    """Widen the heel, and the lateral border up to the heads, by moving the surface outwards.

    The surface is moved by `expansion_mm` at the borders, less towards the middle line, and not at
    all in front; the shift is twice continuously differentiable.

    Returns
    -------
    (ny, nx) float64, mm
    """
    share = field.y_mm[:, None] / length_mm
    across = middle.medial_mm / middle.half_mm
    outward = smoother_step(np.abs(across), _STILL, 1.0)
    fades = (1 - smoother_step(share, *zone) for zone in (_MEDIAL_EXPANSION, _LATERAL_EXPANSION))
    medial, lateral = fades
    sideways = expansion_mm * outward * np.where(across > 0, medial, -lateral)
    backwards = expansion_mm * (1 - smoother_step(share, 0.0, _HEEL_CENTRE))
    rows, columns = np.indices(field.heights_mm.shape, dtype=np.float64)
    places = rows + backwards / field.step_mm, columns - medial_sign * sideways / field.step_mm
    return np.asarray(
        scipy.ndimage.map_coordinates(field.heights_mm, places, order=3, mode="nearest")
    )


@dataclass(frozen=True)
class Arch:
    """The medial arch of a surface.

    Parameters
    ----------
    apex_mm
        Its highest place (x, y), insole frame.
    height_mm
        Of the surface at the apex, over the line from the heel to the 1st head; not negative.
    heel_mm, head_mm
        The y of its ends.
    """

    apex_mm: Place
    height_mm: float
    heel_mm: float
    head_mm: float

    @classmethod
    def of(cls, foot: Foot, surface: HeightField, apex_mm: Place) -> Arch:
        """Measure the arch of a foot's contact surface."""
        landmarks = find_landmarks(foot)
        heel, head = (landmarks[k].point[:2] for k in ("heel_centre", "metatarsal_head_1"))
        heights = surface.height_at(np.array([heel, apex_mm, head]))
        share = float(np.clip((apex_mm[1] - heel[1]) / (head[1] - heel[1]), 0, 1))
        rise = heights[1] - (1 - share) * heights[0] - share * heights[2]
        start = min(_HEEL_END * foot.length_mm, apex_mm[1] - _LEAST_HALF_MM)
        return cls(
            apex_mm,
            max(float(np.nan_to_num(rise)), 0.0),
            start,
            max(float(head[1]), apex_mm[1] + _LEAST_HALF_MM),
        )


def arch_filled(
    field: HeightField, middle: Middle, arch: Arch, fill_mm: float, medial_sign: int
) -> FloatArray:
    """Lower the medial arch by `fill_mm` at its apex and medially of it.

    The change vanishes at the heel, at the 1st head and at the middle line; it is twice
    continuously differentiable.

    Returns
    -------
    (ny, nx) float64, mm
    """
    x, y = arch.apex_mm
    rows = field.y_mm[:, None]
    along = smoother_step(rows, arch.heel_mm, y) * (1 - smoother_step(rows, y, arch.head_mm))
    middle_mm = float(np.interp(y, field.y_mm, middle.middle_mm[:, 0]))
    aside_mm = max(medial_sign * x - middle_mm, _LEAST_HALF_MM)
    across = smoother_step(middle.medial_mm, 0.0, aside_mm)
    return np.asarray(field.heights_mm - fill_mm * along * across)


def without_folds(field: HeightField, level_over: BoolArray, sigma_mm: float) -> FloatArray:
    """Even out folds of the skin by a Gaussian that keeps the mean level.

    Parameters
    ----------
    level_over : (ny, nx) bool
        Nodes whose mean height stays.
    sigma_mm
        0 for none.

    Returns
    -------
    (ny, nx) float64, mm
    """
    heights = field.heights_mm
    if sigma_mm <= 0:
        return heights
    even = scipy.ndimage.gaussian_filter(heights, sigma_mm / field.step_mm, mode="nearest")
    if level_over.any():
        even += (heights - even)[level_over].mean()
    return np.asarray(even)
