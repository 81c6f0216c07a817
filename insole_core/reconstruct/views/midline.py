"""The thesis's merging of the views: cut them where they overlap (6.2.4)."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.reconstruct.views.range_mesh import RangeMesh

_SOLE_HEIGHT_MM = 50.0
_SLICE_MM = 10.0
_SEAM_MM = 20.0
"""Overlap of each half across the line, where the other view measures poorly."""


def cut_at_midline(sheets: list[RangeMesh]) -> list[RangeMesh]:
    """Cut the sheets so that each part of the foot comes from the view that faces it.

    Of the views that face the sole, those at the left (x < 0) keep what lies left of the foot's
    mid-line and those at the right the rest, as long as there are both; at the seam they overlap.
    A view that faces the Achilles tendon keeps what lies behind and above the lower rear edge of
    the foot.

    Returns
    -------
    list of RangeMesh
        First the views that face the sole, then the others.
    """
    sole = [sheet for sheet in sheets if _faces_sole(sheet)]
    back = [sheet for sheet in sheets if not _faces_sole(sheet)]
    if not sole:
        return back
    return [*_cut_left_and_right(sole), *(_cut_below_heel(sheet, sole) for sheet in back)]


def fit_midline(points: FloatArray) -> tuple[float, float]:
    """Fit the line x = offset + slope * y halfway between the sides of the sole.

    Parameters
    ----------
    points : (n, 3) float64, mm, reference frame

    Returns
    -------
    offset : float, mm
    slope : float
    """
    low = points[points[:, 2] < points[:, 2].min() + _SOLE_HEIGHT_MM]
    piece = np.floor((low[:, 1] - low[:, 1].min()) / _SLICE_MM).astype(np.int64)
    leftmost, rightmost = np.full(piece.max() + 1, np.inf), np.full(piece.max() + 1, -np.inf)
    np.minimum.at(leftmost, piece, low[:, 0])
    np.maximum.at(rightmost, piece, low[:, 0])
    full = np.flatnonzero(np.isfinite(leftmost))
    y = low[:, 1].min() + (full + 0.5) * _SLICE_MM
    middle = (leftmost[full] + rightmost[full]) / 2
    if len(full) == 1:
        return float(middle[0]), 0.0
    slope, offset = np.polyfit(y, middle, 1)
    return float(offset), float(slope)


def _faces_sole(sheet: RangeMesh) -> bool:
    axis = sheet.sensor2reference[:3, 2]
    return bool(axis[2] > axis[1])


def _cut_left_and_right(sheets: list[RangeMesh]) -> list[RangeMesh]:
    at_left = [bool(sheet.sensor2reference[0, 3] < 0) for sheet in sheets]
    if all(at_left) or not any(at_left):
        return sheets
    corners = np.concatenate([sheet.corners.reshape(-1, 3) for sheet in sheets])
    offset, slope = fit_midline(corners)
    cut = []
    for sheet, left in zip(sheets, at_left, strict=True):
        centers = sheet.corners.mean(1)
        across = centers[:, 0] - (offset + slope * centers[:, 1])
        cut.append(sheet.keeping((across if left else -across) < _SEAM_MM))
    return cut


def _cut_below_heel(sheet: RangeMesh, sole: list[RangeMesh]) -> RangeMesh:
    """Drop the sole from a view from behind, which sees it at a grazing angle.

    What remains lies above the plane that rises by 45 degrees from the foot's lower rear edge.
    """
    corners = np.concatenate([part.corners.reshape(-1, 3) for part in sole])
    height = sheet.corners.mean(1)[:, 2] - corners[:, 2].min()
    forward = sheet.corners.mean(1)[:, 1] - corners[:, 1].min()
    return sheet.keeping(height > forward)
