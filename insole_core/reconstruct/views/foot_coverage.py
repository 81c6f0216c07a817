"""How much of each part of the foot was measured, by how many views, and how far they differ."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.messages import Message, joined
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.prepared_view import smooth_depth

REGIONS = ("toes", "forefoot", "arch", "heel", "achilles")
_SOLE_SHARES = {
    "heel": (0.0, 0.3),
    "arch": (0.3, 0.58),
    "forefoot": (0.58, 0.8),
    "toes": (0.8, 1.0),
}
"""From the heel, as shares of the foot's length."""
_CELL_MM = 4.0
_GROUND_FACING = -0.3
_HIGHEST_SOLE_MM = 60.0
_LEAST_SOLE_MM2 = 2000.0
_USUAL_LENGTH_MM = 140.0
"""Foot length of a three-year-old; a shorter surface is only part of a foot."""
_BACK_FACING = -0.4
_ACHILLES_MM = (25.0, 125.0)
_ACHILLES_WIDTH_CELLS = 4
ENOUGH = 0.8
"""Share above which a region counts as measured; toes with their gaps cover more than this."""
_LEAST_COSINE = 0.2
_FARTHEST_MM = 10.0


def coverage_of(mesh: TriangleMesh) -> dict[str, float]:
    """Compute the measured share of every region of the foot, 0 to 1.

    For the sole this is the share of the cells between the medial and the lateral border that
    hold a surface facing the ground; for the Achilles tendon the share of the heights from 25 to
    125 mm above the ground at which the back of the leg was measured.

    Parameters
    ----------
    mesh : mm, reference frame

    Returns
    -------
    dict
        Share by name of the region, in the order of `REGIONS`.
    """
    normals = mesh.vertex_normals
    height_mm = mesh.vertices[:, 2] - mesh.vertices[:, 2].min()
    sole = (normals[:, 2] < _GROUND_FACING) & (height_mm < _HIGHEST_SOLE_MM)
    back = (normals[:, 1] < _BACK_FACING) & (height_mm > _ACHILLES_MM[0])
    found = _sole_coverage(mesh, sole)
    achilles = _heights_covered(mesh.vertices[back], height_mm[back])
    return {region: found.get(region, achilles) for region in REGIONS}


def _sole_coverage(mesh: TriangleMesh, sole: BoolArray) -> dict[str, float]:
    places = mesh.vertices[sole]
    if mesh.vertex_areas[sole].sum() < _LEAST_SOLE_MM2:
        return dict.fromkeys(_SOLE_SHARES, 0.0)
    heel_mm, toe_mm = np.percentile(places[:, 1], [0.2, 99.8])
    length_mm = max(float(toe_mm - heel_mm), _USUAL_LENGTH_MM)
    cells = np.floor((places[:, :2] - places[:, :2].min(0)) / _CELL_MM).astype(np.int64)
    occupied = np.zeros(cells.max(0) + 1, dtype=bool)
    occupied[tuple(cells.T)] = True
    span = np.logical_or.accumulate(occupied, 0) & np.logical_or.accumulate(occupied[::-1], 0)[::-1]
    row_mm = places[:, 1].min() + _CELL_MM * (np.arange(occupied.shape[1]) + 0.5)
    share = (row_mm - heel_mm) / length_mm
    return {
        region: _filled(occupied, span, (share >= low) & (share < high))
        for region, (low, high) in _SOLE_SHARES.items()
    }


def _filled(occupied: BoolArray, span: BoolArray, rows: BoolArray) -> float:
    """Compute the occupied share of the cells between the borders; an empty row has usual width."""
    usual = np.median(span.sum(0)[span.any(0)])
    expected = np.maximum(span[:, rows].sum(0), np.where(span[:, rows].any(0), 0, usual)).sum()
    return float(occupied[:, rows].sum() / expected) if expected else 0.0


def _heights_covered(places: FloatArray, height_mm: FloatArray) -> float:
    low, high = _ACHILLES_MM
    count = int((high - low) / _CELL_MM)
    level: IntArray = np.floor((height_mm - low) / _CELL_MM).astype(np.int64)
    column: IntArray = np.floor(places[:, 0] / _CELL_MM).astype(np.int64)
    cells = np.unique(np.stack([level, column], axis=1)[level < count], axis=0)
    width = np.bincount(cells[:, 0], minlength=count)
    return float((width >= _ACHILLES_WIDTH_CELLS).mean())


def coverage_warnings(coverage: dict[str, float], *, absence_is_reported: bool) -> list[str]:
    """Return warnings that name the regions of the foot not measured, or only in part.

    Parameters
    ----------
    coverage
        Share by region, from `coverage_of`.
    absence_is_reported
        Whether another warning already says that no view faces a side of the foot; regions that
        are less than half covered are then not named again.

    Returns
    -------
    list of str
        At most two sentences; empty when every region is covered.
    """
    known = {r: share for r, share in coverage.items() if share >= 0.5 or not absence_is_reported}
    absent = [region for region, share in known.items() if share < 0.05]
    partial = [
        Message("{region} {percent:.0f} %", region=region, percent=100 * share)
        for region, share in known.items()
        if 0.05 <= share < ENOUGH
    ]
    sentences: list[str] = []
    if absent:
        sentences.append(
            Message(
                "Not measured: {regions}; no view that is used shows it.", regions=joined(absent)
            )
        )
    if partial:
        sentences.append(
            Message(
                "Only partly measured: {regions}; see the holes there before designing.",
                regions=joined(partial),
            )
        )
    return sentences


@dataclass(frozen=True, eq=False)
class ViewConsistency:
    """Number of views at every vertex of a mesh, and their disagreement.

    Parameters
    ----------
    views : (n,) int64
        Number of views that see each vertex.
    spread_mm : (n,) float64
        Distance between the lowest and the highest of their surfaces along the normal; NaN where
        fewer than two views see the vertex.
    """

    views: IntArray
    spread_mm: FloatArray


def view_consistency(mesh: TriangleMesh, readings: Iterable[DepthView]) -> ViewConsistency:
    """Compare the views with each other at the vertices of a mesh.

    Parameters
    ----------
    mesh : mm, reference frame
    readings
        Depth views whose poses are known.

    Returns
    -------
    ViewConsistency
    """
    count = np.zeros(len(mesh.vertices), dtype=np.int64)
    low, high = np.full(len(count), np.inf), np.full(len(count), -np.inf)
    for reading in readings:
        above_mm = _heights(mesh, reading)
        seen = np.isfinite(above_mm)
        count += seen
        low[seen] = np.minimum(low, above_mm)[seen]
        high[seen] = np.maximum(high, above_mm)[seen]
    return ViewConsistency(count, np.where(count > 1, high - low, np.nan))


def _heights(mesh: TriangleMesh, reading: DepthView) -> FloatArray:
    """Compute a view's height above each vertex along the normal, mm; NaN = not seen."""
    depth_mm = smooth_depth(reading).depth_mm
    way = reading.origin_mm - mesh.vertices
    cosine = np.einsum("nc,nc->n", mesh.vertex_normals, way) / np.linalg.norm(way, axis=1)
    u, v = np.rint(reading.project(mesh.vertices)).astype(np.int64).T
    height, width = depth_mm.shape
    inside = (u >= 0) & (u < width) & (v >= 0) & (v < height)
    measured = depth_mm[np.clip(v, 0, height - 1), np.clip(u, 0, width - 1)]
    above_mm = (reading.depth_along(mesh.vertices) - measured) * cosine
    seen = inside & (cosine > _LEAST_COSINE) & (np.abs(above_mm) < _FARTHEST_MM)
    return np.where(seen, above_mm, np.nan)
