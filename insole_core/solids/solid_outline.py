"""The outline of an insole, and the distance of every grid node to it."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
import scipy

from insole_core.errors import DesignError
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.polygon import signed_area_mm2
from insole_core.insole.build import Insole
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.primitives.height_field import HeightField

_LEAST_AREA_MM2 = 400.0
_PITCH_MM = 0.5  # of the points along an outline for finding its nearest side
_SUBPIXEL_BITS = 8
_ON_OUTLINE_MM = 1e-6  # below this, the offset from the outline has no direction


@dataclass(frozen=True, eq=False)
class OutlineDistance:
    """The signed distance to an outline, at every node of a height field.

    Parameters
    ----------
    inside_mm : (ny, nx) float64
        Positive inside; exact up to `reach_mm`, approximate beyond it.
    outward : (ny, nx, 2) float64
        Unit vector away from the inside, within reach; zero elsewhere.
    """

    inside_mm: FloatArray
    outward: FloatArray
    reach_mm: float


def outline_of(insole: Insole) -> FloatArray:
    """Return the outline of the insole's design, (n, 2), mm, insole frame.

    Raises
    ------
    DesignError
        If it encloses too little for an insole.
    """
    design = insole.design
    # Only a shortened insole needs landmarks, and finding them takes as long as all the rest.
    shortened = design.outline.extent == "three_quarter"
    landmarks = find_landmarks(insole.foot) if shortened else {}
    return checked_outline(insole_outline(insole.foot, design, landmarks))


def checked_outline(polygon: FloatArray) -> FloatArray:
    """Return an outline (n, 2), mm, in counter-clockwise order.

    Raises
    ------
    DesignError
        If it encloses too little for an insole.
    """
    area = signed_area_mm2(polygon) if len(polygon) > 2 else 0.0
    if abs(area) < _LEAST_AREA_MM2:
        raise DesignError(
            "The outline encloses only {area_mm2:.0f} mm², which leaves no insole; draw it round "
            "the foot.",
            area_mm2=abs(area),
        )
    return polygon if area > 0 else np.ascontiguousarray(polygon[::-1])


def outline_distance(polygon: FloatArray, field: HeightField, reach_mm: float) -> OutlineDistance:
    """Compute the signed distance of a field's nodes to an outline.

    Parameters
    ----------
    polygon : (n, 2) float64, mm, frame of `field`
        Counter-clockwise; the first point is not repeated.
    reach_mm
        Up to which the distance is exact.
    """
    sign, coarse = _coarse_distance(polygon, field)
    near = coarse < reach_mm + 2 * field.step_mm
    nodes = field.nodes[near.ravel(), :2]
    away, normal = _away_from(polygon, nodes)
    distance = np.linalg.norm(away, axis=1)
    # Rounding must not decide on which side a node on the outline is.
    apart = distance > _ON_OUTLINE_MM
    distance = np.where(apart, distance, 0.0)
    # The painted mask errs by up to a pixel; the normal of the nearest point gives the exact side.
    sign[near] = np.where((away * normal).sum(axis=1) > 0, -1.0, 1.0)
    inside = sign * coarse
    inside[near] = sign[near] * distance
    outward = np.zeros((*near.shape, 2))
    length = np.where(apart, distance, 1.0)
    outward[near] = np.where(apart[:, None], -(sign[near] / length)[:, None] * away, normal)
    return OutlineDistance(inside, outward, reach_mm)


def _coarse_distance(polygon: FloatArray, field: HeightField) -> tuple[FloatArray, FloatArray]:
    """Return the sign (positive inside) and the distance to the other sign, in whole steps."""
    corner = np.array([field.x0_mm, field.y0_mm])
    pixels = np.rint((polygon - corner) / field.step_mm * 2**_SUBPIXEL_BITS).astype(np.int32)
    mask = np.zeros(field.heights_mm.shape, np.uint8)
    cv2.fillPoly(mask, [pixels], 1, shift=_SUBPIXEL_BITS)
    inner = cv2.distanceTransform(mask, cv2.DIST_L2, 5)
    outer = cv2.distanceTransform(1 - mask, cv2.DIST_L2, 5)
    return np.where(mask > 0, 1.0, -1.0), np.asarray((inner + outer) * field.step_mm, float)


def _away_from(polygon: FloatArray, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the offset (n, 2) from the nearest point of a polygon, and its unit normal there.

    At a corner the normal is the mean of both sides' (Baerentzen and Aanaes 2005).
    """
    dense = _densified(polygon)
    along = np.roll(dense, -1, axis=0) - dense
    normals = along[:, ::-1] * [1, -1] / np.linalg.norm(along, axis=1, keepdims=True)
    _, nearest = scipy.spatial.KDTree(dense).query(places)
    before, after = np.asarray(nearest) - 1, np.asarray(nearest)
    share = [_share(places - dense[side], along[side]) for side in (before, after)]
    ways = [
        places - dense[side] - part[:, None] * along[side]
        for side, part in zip((before, after), share, strict=True)
    ]
    sizes = [(way**2).sum(axis=1) for way in ways]
    # Both are equally near but for rounding: one side's normal may be perpendicular to the offset.
    corner = np.isclose(sizes[0], sizes[1], rtol=1e-9, atol=_ON_OUTLINE_MM**2)
    normal = np.where((sizes[0] < sizes[1])[:, None], normals[before], normals[after])
    normal[corner] = normals[before[corner]] + normals[after[corner]]
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    return np.where((sizes[0] < sizes[1])[:, None], *ways), normal


def _densified(polygon: FloatArray) -> FloatArray:
    following = np.roll(polygon, -1, axis=0)
    pieces = np.ceil(np.linalg.norm(following - polygon, axis=1) / _PITCH_MM).astype(int)
    side = np.repeat(np.arange(len(polygon)), pieces)
    share = (np.arange(pieces.sum()) - np.repeat(np.cumsum(pieces) - pieces, pieces)) / pieces[side]
    return np.asarray(polygon[side] + share[:, None] * (following - polygon)[side])


def _share(place: FloatArray, along: FloatArray) -> FloatArray:
    """Return where on a side (n, 2) its nearest point to a given point lies, 0 to 1."""
    return np.asarray(np.clip((place * along).sum(axis=1) / (along**2).sum(axis=1), 0, 1))
