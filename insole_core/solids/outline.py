"""Where an insole ends: its outline, and the distance of every place to it."""

from __future__ import annotations

from dataclasses import dataclass

import contourpy
import cv2
import numpy as np
from scipy.ndimage import distance_transform_edt, gaussian_filter
from scipy.spatial import KDTree

from insole_core.errors import DesignError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.build import Insole
from insole_core.insole.height_field import HeightField
from insole_core.insole.outline_curve import inside_curve

_ALLOWANCE_MM = 2.0  # of the outline beyond the foot
_GAP_MM = 12.0  # gaps between toes and under a high arch are bridged up to twice this
_SMOOTHING_MM = 2.5
_VERTEX_PITCH_MM = 1.5
_LEAST_AREA_MM2 = 400.0
_PITCH_MM = 0.5  # of the points along an outline that find the nearest part of it
_SUBPIXEL_BITS = 8
_DOUBTFUL = 1.0  # steps from the outline, where a painted mask may err
_ON_OUTLINE_MM = 1e-6  # nearer, the way from the outline has no direction


@dataclass(frozen=True, eq=False)
class OutlineDistance:
    """The signed distance to an outline, at every node of a height field.

    Parameters
    ----------
    inside_mm : (ny, nx) float64
        Positive inside; exact up to `reach_mm`, beyond it only about right.
    outward : (ny, nx, 2) float64
        Unit vector away from the inside, within reach; zero elsewhere.
    reach_mm
    """

    inside_mm: FloatArray
    outward: FloatArray
    reach_mm: float


def automatic_outline(insole: Insole) -> FloatArray:
    """Draw the outline round the foot's plantar side with an allowance.

    Returns
    -------
    (n, 2) float64, mm, insole frame
        Counter-clockwise; the last point is not the first.

    Raises
    ------
    DesignError
        When too little of the foot was measured.
    """
    field = insole.contact
    step, pad = field.step_mm, int(np.ceil((_GAP_MM + _ALLOWANCE_MM) / field.step_mm)) + 2
    outside = np.pad(~insole.measured, pad, constant_values=True)
    reach = distance_transform_edt(outside) * step
    inside = distance_transform_edt(reach <= _GAP_MM) * step - _GAP_MM
    signed = np.where(inside > 0, inside, -reach) + _ALLOWANCE_MM
    smooth = gaussian_filter(np.clip(signed, -_GAP_MM, _GAP_MM), _SMOOTHING_MM / step)
    first = np.array([field.x0_mm, field.y0_mm]) - pad * step
    lines = contourpy.contour_generator(z=smooth).lines(0.0)
    polygons = [np.asarray(line)[:-1] * step + first for line in lines]
    largest = max(polygons, key=lambda p: abs(_area(p)), default=np.zeros((0, 2)))
    return checked_outline(largest[:: max(1, int(_VERTEX_PITCH_MM / step))])


def checked_outline(polygon: FloatArray) -> FloatArray:
    """Give an outline (n, 2) counter-clockwise.

    Raises
    ------
    DesignError
        When it encloses too little for an insole.
    """
    area = _area(polygon) if len(polygon) > 2 else 0.0
    if abs(area) < _LEAST_AREA_MM2:
        raise DesignError(
            f"The outline encloses only {abs(area):.0f} mm², which leaves no insole;"
            " draw it round the foot."
        )
    return polygon if area > 0 else np.ascontiguousarray(polygon[::-1])


def outline_distance(polygon: FloatArray, field: HeightField, reach_mm: float) -> OutlineDistance:
    """Measure the distance of a field's nodes to an outline (n, 2), mm, insole frame."""
    sign, coarse = _coarse_distance(polygon, field)
    near = coarse < reach_mm + 2 * field.step_mm
    nodes = field.nodes[near.ravel(), :2]
    away, normal = _away_from(polygon, nodes)
    distance = np.linalg.norm(away, axis=1)
    sign[near] = _exact_sign(polygon, nodes, sign[near], distance < _DOUBTFUL * field.step_mm)
    inside = sign * coarse
    inside[near] = sign[near] * distance
    outward = np.zeros((*near.shape, 2))
    apart = distance > _ON_OUTLINE_MM
    length = np.where(apart, distance, 1.0)
    outward[near] = np.where(apart[:, None], -(sign[near] / length)[:, None] * away, normal)
    return OutlineDistance(inside, outward, reach_mm)


def _exact_sign(
    polygon: FloatArray, nodes: FloatArray, sign: FloatArray, doubtful: BoolArray
) -> FloatArray:
    """Decide anew on which side the doubtful nodes lie."""
    exact = sign.copy()
    exact[doubtful] = np.where(inside_curve(polygon, nodes[doubtful]), 1.0, -1.0)
    return exact


def _coarse_distance(polygon: FloatArray, field: HeightField) -> tuple[FloatArray, FloatArray]:
    """Sign (positive inside) and distance to the nearest node of the other sign, in whole steps."""
    corner = np.array([field.x0_mm, field.y0_mm])
    pixels = np.rint((polygon - corner) / field.step_mm * 2**_SUBPIXEL_BITS).astype(np.int32)
    mask = np.zeros(field.heights_mm.shape, np.uint8)
    cv2.fillPoly(mask, [pixels], 1, shift=_SUBPIXEL_BITS)
    inner = cv2.distanceTransform(mask, cv2.DIST_L2, 5)
    outer = cv2.distanceTransform(1 - mask, cv2.DIST_L2, 5)
    return np.where(mask > 0, 1.0, -1.0), np.asarray((inner + outer) * field.step_mm, float)


def _away_from(polygon: FloatArray, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Way (n, 2) from the nearest point of a polygon to each place, and its normal (n, 2) there."""
    dense = _densified(polygon)
    _, nearest = KDTree(dense).query(places)
    following = np.roll(dense, -1, axis=0)
    ways = [
        places - _on_segment(dense[nearest + k], following[nearest + k], places) for k in (-1, 0)
    ]
    second = np.linalg.norm(ways[1], axis=1) < np.linalg.norm(ways[0], axis=1)
    along = (following - dense)[nearest - 1 + second]
    normal = along[:, ::-1] * [1, -1] / np.linalg.norm(along, axis=1, keepdims=True)
    return np.where(second[:, None], ways[1], ways[0]), normal


def _densified(polygon: FloatArray) -> FloatArray:
    following = np.roll(polygon, -1, axis=0)
    pieces = np.ceil(np.linalg.norm(following - polygon, axis=1) / _PITCH_MM).astype(int)
    side = np.repeat(np.arange(len(polygon)), pieces)
    share = (np.arange(pieces.sum()) - np.repeat(np.cumsum(pieces) - pieces, pieces)) / pieces[side]
    return np.asarray(polygon[side] + share[:, None] * (following - polygon)[side])


def _on_segment(start: FloatArray, end: FloatArray, places: FloatArray) -> FloatArray:
    along = end - start
    length2 = np.maximum((along**2).sum(axis=1), 1e-18)
    share = np.clip(((places - start) * along).sum(axis=1) / length2, 0, 1)
    return np.asarray(start + share[:, None] * along)


def _area(polygon: FloatArray) -> float:
    """Signed area of a closed polygon, positive counter-clockwise."""
    x, y = polygon.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)
