"""What a milled height field has too much or too little, measured along the normals of the piece.

Asked is what of the piece is seen from above and what the ball can reach: the closing of the
heights by the ball, on the pixels of the removal. Where the heights are level enough for it, what
stays is measured along the vertical times the cosine of the slope; on walls, at edges and beside
the piece it is the distance of the milled point from the piece itself. So the pitch of the pixels
is where it is looked, and not how exactly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy

from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.milling.machine import Machine
from tests.insole_core.milling.removal import Removal

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
IntArray = npt.NDArray[np.int64]
_SAMPLE_MM = 0.8
"""Between points within the triangles of the piece, from which the nearest ones are found."""
_HOLLOW_MM = 0.003
_STEEPEST = np.sqrt(0.5)
"""Cosine of the steepest slope to which ridges may grow: they stay below twice those of a level."""
_FAR_MM = 1e3
_THIN_MM = 0.05
_JOINT_MM = 0.4
"""Thickness of the weakest bridge that is counted: of a tab at an edge of half a millimetre."""


@dataclass(frozen=True)
class Judgement:
    """Worst places of a side, mm along the normal; maps are (x, y) on the removal's pixels.

    Parameters
    ----------
    gouge_mm
        Depth of the deepest milled point inside the piece.
    surplus_mm
        Greatest material over the ridges and over what the ball can reach.
    usual_surplus_mm
        The same for all but one pixel of ten thousand of the piece.
    beside_mm
        Greatest distance from the piece, of material beside it that is higher than a tab.
    """

    gouge_mm: float
    surplus_mm: float
    usual_surplus_mm: float
    beside_mm: float
    gouges: FloatArray
    surpluses: FloatArray
    besides: FloatArray


def judge(
    mesh: TriangleMesh,
    left: FloatArray,
    removal: Removal,
    how: Machine,
    floor_mm: float | FloatArray,
) -> Judgement:
    """Compare what is left of a block with the piece in it, seen from above.

    Parameters
    ----------
    floor_mm : number, or (x, y) of the removal's pixels
        Height of what may stay beside the piece: the tabs.
    """
    asked, _ = seen_from_above(mesh, removal)
    inside = np.isfinite(asked)
    distance = _Distance(mesh)
    gouges = np.zeros_like(left)
    low = inside & (left < asked - 0.005)
    gouges[low] = _depth(mesh, distance, _points(removal, left, low), asked[low])
    closed, cosine = _closed(asked, removal.pitch_mm, how.finishing.cutter.radius_mm)
    surpluses = np.zeros_like(left)
    high = inside & (left > asked + 0.01)
    surpluses[high] = distance(_points(removal, left, high))
    hollow = high & (closed > asked + _HOLLOW_MM)
    over = np.maximum(left - closed, 0) * cosine
    surpluses[hollow] = np.minimum(surpluses, over)[hollow]
    surpluses[high] -= np.minimum(cusp_mm(cosine, how), surpluses)[high]
    besides = np.zeros_like(left)
    # Beside the piece the contour clears what its cutter reaches: all but the narrow corners.
    radius = how.contour.cutter.radius_mm
    reach = scipy.ndimage.distance_transform_edt(~inside) * removal.pitch_mm
    clear = scipy.ndimage.distance_transform_edt(reach <= radius) * removal.pitch_mm
    near = ~inside & (reach < radius) & (clear < radius - removal.pitch_mm)
    near &= left > floor_mm + how.roughing.allowance_mm
    besides[near] = distance(_points(removal, left, near))
    return Judgement(
        float(gouges.max()), float(surpluses.max()),
        float(np.quantile(surpluses[inside], 0.9999)), float(besides.max()),
        gouges, surpluses, besides,
    )  # fmt: skip


def seen_from_above(mesh: TriangleMesh, removal: Removal) -> tuple[FloatArray, FloatArray]:
    """Return heights and cosines of the slope at the pixels; NaN beside the mesh."""
    places = np.stack(np.meshgrid(removal.x_mm, removal.y_mm, indexing="ij"), -1).reshape(-1, 2)
    origins = np.column_stack([places + 1e-5, np.full(len(places), 100.0)])
    hits = RayCaster(mesh).cast(origins, np.broadcast_to([0.0, 0, -1], origins.shape))
    heights, cosine = np.full(len(places), np.nan), np.full(len(places), np.nan)
    heights[hits.ray] = (hits.weights * mesh.vertices[mesh.triangles[hits.triangle], 2]).sum(axis=1)
    cosine[hits.ray] = np.abs(mesh.triangle_normals[hits.triangle, 2])
    shape = removal.heights.shape
    return heights.reshape(shape), cosine.reshape(shape)


def edge_round(mesh: TriangleMesh, removal: Removal) -> FloatArray:
    """Return the heights (x, y) of a mesh seen from above, beside it that of its nearest pixel."""
    heights, _ = seen_from_above(mesh, removal)
    nearest = scipy.ndimage.distance_transform_edt(
        np.isnan(heights), return_distances=False, return_indices=True
    )
    return np.asarray(heights[tuple(nearest)])


def tabs_that_hold(removal: Removal, inside: BoolArray, cutter_mm: float) -> int:
    """Count the bridges of material from the piece, over the gap of the contour, to the block.

    Two pixels are joined where they have `_JOINT_MM` of their heights in common.
    """
    beside = scipy.ndimage.distance_transform_edt(~inside) * removal.pitch_mm
    zone = np.where(inside, 0, np.where(beside < cutter_mm - 1, 1, 2)).ravel()
    first, second = _joined(removal.from_below, removal.heights)
    gap = (zone[first] == 1) & (zone[second] == 1)
    links = scipy.sparse.coo_matrix(
        (np.ones(gap.sum()), (first[gap], second[gap])), shape=(len(zone), len(zone))
    )
    _, part = scipy.sparse.csgraph.connected_components(links, directed=False)
    ends = np.concatenate([np.stack([first, second], -1), np.stack([second, first], -1)])
    of_gap = ends[zone[ends[:, 0]] == 1]
    at_piece, at_block = (set(part[of_gap[zone[of_gap[:, 1]] == end, 0]]) for end in (0, 2))
    return len(at_piece & at_block)


def tab_thicknesses(removal: Removal, inside: BoolArray, cutter_mm: float) -> FloatArray:
    """Return how thick each tab is where it is thinnest on the way over the gap of the contour."""
    beside = scipy.ndimage.distance_transform_edt(~inside) * removal.pitch_mm
    thick = np.where(beside > 0, np.clip(removal.heights - removal.from_below, 0, None), 0)
    gap = (beside > removal.pitch_mm) & (beside < cutter_mm - 1)
    parts, count = scipy.ndimage.label(gap & (thick > _THIN_MM))
    ring = np.floor(beside / (2 * removal.pitch_mm)).astype(int)
    found = []
    for part in range(1, count + 1):
        within = parts == part
        most = np.zeros(ring[gap].max() + 1)
        np.maximum.at(most, ring[within], thick[within])
        found.append(most[np.unique(ring[gap])[1:-1]].min())
    return np.array([one for one in found if one > 0])


def _joined(low: FloatArray, high: FloatArray) -> tuple[IntArray, IntArray]:
    """Return the pairs of neighbouring pixels whose material touches."""
    number = np.arange(low.size).reshape(low.shape)
    pairs = []
    for a, b in (np.s_[1:], np.s_[:-1]), (np.s_[:, 1:], np.s_[:, :-1]):
        common = np.minimum(high[a], high[b]) - np.maximum(low[a], low[b])
        touching = common >= _JOINT_MM
        pairs.append(np.stack([number[a][touching], number[b][touching]]))
    first, second = np.concatenate(pairs, axis=1)
    return first, second


def cusp_mm(cosine: FloatArray, how: Machine) -> FloatArray:
    """Return the height of the ridges that a ball leaves between its lines on a slope."""
    radius = how.finishing.cutter.radius_mm
    half = how.finishing.step_over_mm / 2 / np.maximum(cosine, _STEEPEST)
    return np.asarray(radius - np.sqrt(radius**2 - half**2))


def _depth(
    mesh: TriangleMesh, distance: _Distance, points: FloatArray, asked: FloatArray
) -> FloatArray:
    """Return the depth in the piece of what was cut off above points (n, 3), up to its top."""
    origins = np.column_stack([points[:, :2], asked - 1e-3])
    downward = np.broadcast_to([0.0, 0, -1], origins.shape)
    hits = RayCaster(mesh).cast(origins + np.array([1e-5, 0, 0]), downward)
    below = asked.copy()
    below[hits.ray] = (hits.weights * mesh.vertices[mesh.triangles[hits.triangle], 2]).sum(axis=1)
    bottom = np.maximum(points[:, 2], below)
    deepest = np.zeros(len(points))
    for share in np.linspace(0, 1, 9):
        heights = bottom * (1 - share) + asked * share
        deepest = np.maximum(deepest, distance(np.column_stack([points[:, :2], heights])))
    return deepest


def _points(removal: Removal, heights: FloatArray, at: BoolArray) -> FloatArray:
    i, j = np.nonzero(at)
    return np.column_stack([removal.x_mm[i], removal.y_mm[j], heights[at]])


def _closed(asked: FloatArray, pitch_mm: float, radius_mm: float) -> tuple[FloatArray, FloatArray]:
    """Return the closing of heights by a ball, and the cosine of its slope."""
    reach = int(radius_mm / pitch_mm)
    i, j = np.mgrid[-reach : reach + 1, -reach : reach + 1] * pitch_mm
    within = i**2 + j**2 <= radius_mm**2
    ball = np.where(within, np.sqrt(np.maximum(radius_mm**2 - i**2 - j**2, 0)), 0)
    heights = np.where(np.isfinite(asked), asked, -_FAR_MM)
    centres = scipy.ndimage.grey_dilation(heights, footprint=within, structure=ball)
    closed = -scipy.ndimage.grey_dilation(-centres, footprint=within, structure=ball)
    closed = np.maximum(closed, heights)
    along, across = np.gradient(closed, pitch_mm)
    return closed, 1 / np.sqrt(1 + along**2 + across**2)


class _Distance:
    """Distances of points from a mesh."""

    def __init__(self, mesh: TriangleMesh) -> None:
        corners = mesh.vertices[mesh.triangles]
        edges = corners - np.roll(corners, 1, axis=1)
        longest = np.linalg.norm(edges, axis=2).max(axis=1)
        counts = np.ceil(longest / _SAMPLE_MM).astype(int)
        points, owners = [], []
        for count in np.unique(counts):
            of = np.flatnonzero(counts == count)
            u, v = (np.mgrid[:count, :count] + 1 / 3) / count
            keep = u + v < 1
            weights = np.column_stack([1 - u[keep] - v[keep], u[keep], v[keep]])
            points.append(np.einsum("wc,tcx->twx", weights, corners[of]).reshape(-1, 3))
            owners.append(np.repeat(of, len(weights)))
        self._corners = corners
        self._owners = np.concatenate(owners)
        self._tree = scipy.spatial.cKDTree(np.concatenate(points))

    def __call__(self, points: FloatArray) -> FloatArray:
        if not len(points):
            return np.empty(0)
        _, near = self._tree.query(points, k=12)
        nearest = np.full(len(points), np.inf)
        for k in range(near.shape[1]):
            corners = self._corners[self._owners[near[:, k]]]
            nearest = np.minimum(nearest, _distance(points, corners))
        return nearest


def _distance(points: FloatArray, corners: FloatArray) -> FloatArray:
    """Return the distances of points (n, 3) from triangles (n, 3, 3)."""
    a, b, c = np.moveaxis(corners, 1, 0)
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    unit = normal / np.maximum(length, 1e-12)[:, None]
    within = length > 1e-12
    edges = np.full(len(points), np.inf)
    for start, end in ((a, b), (b, c), (c, a)):
        along = end - start
        share = ((points - start) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-12)
        foot = start + np.clip(share, 0, 1)[:, None] * along
        edges = np.minimum(edges, np.linalg.norm(points - foot, axis=1))
        within &= (np.cross(along, points - start) * unit).sum(axis=1) >= 0
    plane = np.abs(((points - a) * unit).sum(axis=1))
    return np.where(within, plane, edges)
