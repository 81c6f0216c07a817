"""Where the rim of a heel cup can rise: between the measured sole and the edge of the insole."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.outline.insole_outline import full_outline
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.primitives.outline_curve import evenly_spread

_GAP_MM = 16.0  # narrower gaps and bays of a scan belong to the sole
_EVEN_MM = 1.5  # standard deviation by which the border of the sole is evened
_PITCH_MM = 0.25  # of the points along the edge for finding the nearest


@dataclass(frozen=True, eq=False)
class RimBand:
    """The nodes of a heel's rows, between the measured sole and the edge of the insole.

    Parameters
    ----------
    beside_mm : (n, nx) float64
        Distance from the measured sole; 0 on it, in its holes and in its narrow gaps.
    room_mm : (n, nx) float64
        From the measured sole to the edge; may be negative where the edge cuts the sole.
    """

    beside_mm: FloatArray
    room_mm: FloatArray


def rim_band(
    foot: Foot, field: HeightField, measured: BoolArray, outline: Outline, rows: int
) -> RimBand:
    """Measure how far the first rows of a sole lie from what was measured, and from the edge.

    Parameters
    ----------
    field, measured
        The foot's sole on its grid, and where it was measured.
    outline
        Its extent is ignored, since only the front of a short insole differs.
    rows
        Number of rows, counted from the heel.
    """
    covered = _without_gaps(measured[: rows + round(_GAP_MM / field.step_mm)], field.step_mm)
    beside = np.zeros((rows, measured.shape[1]))
    if covered.any():
        beside = _beside_mm(covered, field.step_mm)[:rows]
    room = np.zeros_like(beside)
    row, column = np.nonzero(beside)
    places = np.column_stack([field.x_mm[column], field.y_mm[row]])
    room[row, column] = beside[row, column] + _inside_mm(full_outline(foot, outline), places)
    return RimBand(beside, room)


def _without_gaps(measured: BoolArray, step_mm: float) -> BoolArray:
    """Close gaps and fill holes: only what lies beside the whole sole can become a wall."""
    margin, radius_mm = round(_GAP_MM / step_mm), _GAP_MM / 2
    grown = (
        scipy.ndimage.distance_transform_edt(~np.pad(measured, margin), sampling=step_mm)
        <= radius_mm
    )
    closed = scipy.ndimage.distance_transform_edt(grown, sampling=step_mm) > radius_mm
    inner = (slice(margin, -margin), slice(margin, -margin))
    return np.asarray(scipy.ndimage.binary_fill_holes(closed[inner]))


def _beside_mm(covered: BoolArray, step_mm: float) -> FloatArray:
    """Return the distance from what is covered, evened: its border runs in steps of the grid."""
    outer, inner = (
        scipy.ndimage.distance_transform_edt(a, sampling=step_mm) for a in (~covered, covered)
    )
    from_border = np.where(covered, step_mm - inner, outer)
    even = scipy.ndimage.gaussian_filter(from_border, _EVEN_MM / step_mm, mode="nearest")
    return np.where(covered, 0.0, np.maximum(even, 0.0))


def _inside_mm(curve: FloatArray, places: FloatArray) -> FloatArray:
    """Return how far places (n, 2) lie inside a counter-clockwise curve; < 0 outside."""
    length_mm = np.hypot(*(np.roll(curve, -1, axis=0) - curve).T).sum()
    points = evenly_spread(curve, int(length_mm / _PITCH_MM))
    along = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    inward = along[:, ::-1] * [-1, 1] / np.linalg.norm(along, axis=1, keepdims=True)
    _, nearest = scipy.spatial.KDTree(points).query(places)
    return np.asarray(((places - points[nearest]) * inward[nearest]).sum(axis=1))
