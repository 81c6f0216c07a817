"""The lower part of a foot, asked for its borders: medial is +x for either side."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import find_peaks
from scipy.spatial import cKDTree

from insole_core.foot.foot import Foot
from insole_core.foot.levelling import OUTLINE_HEIGHT_MM
from insole_core.geometry.arrays import BoolArray, FloatArray, IndexArray
from insole_core.geometry.mesh import TriangleMesh

_END_DEPTH_MM = 12.0
_TURNED = 0.25  # cosine against the direction from which on a normal tells where the end lies
_LEAST_POINTS = 12
_TURNS = 24
_SPREAD_MM = 2.0  # residual at which an end is not to be trusted
_PATCH_MM = 4.0
_FACING = -0.5
_SURE, _GUESS = 0.95, 0.3
_STRIP_MM = 1.5
_TOES = (0.72, 1.05)
_TOE_ACROSS = (0.16, 0.42, 0.58, 0.73, 0.88)  # of the way from the ball's medial to lateral border
_TOE_REACH = (1.0, 0.99, 0.955, 0.905, 0.85)  # of the length
_TOE_SEARCH, _TOE_DEPTH_MM = 0.12, 1.0


@dataclass(frozen=True, eq=False)
class End:
    """The outermost place in a direction.

    Parameters
    ----------
    point : (3,) float64, mm
        Medial = +x.
    confidence
        0 to 1.
    """

    point: FloatArray
    confidence: float


class SoleSurface:
    """What of a foot lies below `OUTLINE_HEIGHT_MM`, its frayed borders left out.

    Parameters
    ----------
    foot
    """

    def __init__(self, foot: Foot) -> None:
        self._medial = np.array([foot.side.medial_sign, 1.0, 1.0])
        self.length_mm = foot.length_mm
        low = foot.mesh.vertices[:, 2] < OUTLINE_HEIGHT_MM
        keep = low & ~_near_border(foot.mesh)
        keep = keep if keep.sum() > low.sum() / 2 else low
        self.points = foot.mesh.vertices[keep] * self._medial
        self.normals = foot.mesh.vertex_normals[keep] * self._medial
        facing = self.normals[:, 2] < _FACING
        facing = facing if facing.any() else np.ones(len(facing), dtype=bool)
        self._sole = self.points[facing]
        self._tree = cKDTree(self._sole[:, :2])

    def to_insole(self, point: FloatArray) -> FloatArray:
        """Bring a point with medial = +x to the insole frame."""
        return np.asarray(point * self._medial)

    def on_sole(self, xy: FloatArray) -> FloatArray:
        """(3,) the sole above a place: the mean about it, or the nearest of it."""
        near = self._tree.query_ball_point(xy, _PATCH_MM)
        z = self._sole[near, 2] if near else self._sole[self._tree.query(xy)[1]][2:]
        return np.array([xy[0], xy[1], float(np.median(z))])

    def support(self, direction: FloatArray, shares: tuple[float, float]) -> End:
        """The outermost place towards a horizontal direction, between shares of the length.

        On a round border the way along the direction grows linearly with the normal's part in it,
        and the end is where that part is 1. The line is fitted to the border's last
        `_END_DEPTH_MM`, so the end is found although the surface stops short of it.
        """
        share = self.points[:, 1] / self.length_mm
        region = (share >= shares[0]) & (share <= shares[1])
        region = region if region.any() else np.ones(len(share), dtype=bool)
        points, normals = self.points[region], self.normals[region, :2] @ direction
        along = points[:, :2] @ direction
        ends = (along > along.max() - _END_DEPTH_MM) & (normals > _TURNED)
        if ends.sum() < _LEAST_POINTS:
            return End(points[along.argmax()], _GUESS)
        return _fitted_end(points[ends], along[ends], normals[ends], direction)

    def toe_tips(self) -> list[tuple[FloatArray, bool]]:
        """Five tips (3,), medial to lateral, and whether each was seen as one."""
        front = self.points[
            (self.points[:, 1] > _TOES[0] * self.length_mm)
            & (self.points[:, 1] < _TOES[1] * self.length_mm)
        ]
        ball = self.points[np.abs(self.points[:, 1] / self.length_mm - 0.68) < 0.03]
        ball = ball if len(ball) else self.points
        lateral, medial = float(ball[:, 0].min()), float(ball[:, 0].max())
        width = medial - lateral
        peaks = _peaks(front) if len(front) else np.empty((0, 3))
        tips: list[tuple[FloatArray, bool]] = []
        for across, reach in zip(_TOE_ACROSS, _TOE_REACH, strict=True):
            x = medial - across * width
            away = np.abs(peaks[:, 0] - x) / width
            if len(peaks) and away.min() < _TOE_SEARCH:
                tips.append((peaks[away.argmin()], True))
                peaks = np.delete(peaks, away.argmin(), axis=0)
            else:
                tips.append((np.array([x, reach * self.length_mm, 12.0]), False))
        return tips


def _fitted_end(
    points: FloatArray, along: FloatArray, normals: FloatArray, direction: FloatArray
) -> End:
    keep = np.ones(len(along), dtype=bool)
    for _ in range(3):
        slope, start = np.polyfit(normals[keep], along[keep], 1)
        off = along - (start + slope * normals)
        spread = 1.4826 * float(np.median(np.abs(off[keep])))
        keep = np.abs(off) < max(3 * spread, 0.1)
    reach = start + max(slope, 0.0)
    # The place across: where the border itself is nearest to its end.
    near = along > np.quantile(along, 0.9)
    place = np.average(points[near], axis=0, weights=along[near] - along[near].min() + 1e-9)
    place[:2] += (reach - place[:2] @ direction) * direction
    confidence = _SURE * float(np.clip(1 - spread / _SPREAD_MM, 0, 1))
    return End(place, max(confidence, _GUESS))


def _peaks(front: FloatArray) -> FloatArray:
    """(n, 3) foremost places of the toes: peaks of the front's profile."""
    strip = np.floor(front[:, 0] / _STRIP_MM).astype(int)
    order = np.lexsort((front[:, 1], strip))
    last = np.append(np.flatnonzero(np.diff(strip[order])), len(order) - 1)
    profile = front[order[last]]
    y = np.concatenate([[0.0], profile[:, 1], [0.0]])
    found, _ = find_peaks(y, prominence=_TOE_DEPTH_MM)
    return np.asarray(profile[found - 1])


def _near_border(mesh: TriangleMesh) -> BoolArray:
    """(n,) whether a vertex touches, over at most one edge, the border of an open surface."""
    edges = np.sort(np.concatenate([mesh.triangles[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1)
    key = edges[:, 0].astype(np.int64) * len(mesh.vertices) + edges[:, 1]
    unique, count = np.unique(key, return_counts=True)
    single = unique[count == 1]
    border = np.zeros(len(mesh.vertices), dtype=bool)
    border[np.concatenate([single // len(border), single % len(border)])] = True
    return _grown(border, mesh.triangles)


def _grown(chosen: BoolArray, triangles: IndexArray) -> BoolArray:
    """With the vertices of all triangles that touch a chosen one."""
    grown = chosen.copy()
    grown[triangles[chosen[triangles].any(axis=1)]] = True
    return grown
