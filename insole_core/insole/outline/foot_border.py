"""The border of a foot seen from above, smoothed against the noise of the scan."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh_graph import relaxed
from insole_core.geometry.sampling import sample_triangles

_BORDER_HEIGHT_MM = 30.0  # higher parts do not widen the outline
_ABOVE_MM = 8.0
_PITCH_MM = 1.0
_ROUNDS = 10
_EVENING_MM = 5.0
_GAP_MM = 24.0  # gaps between toes up to this width are bridged
_CELL_MM = 4.0  # of the flank; the mean of a cell counts, not its outermost point
_DEPTH_MM = 3.0  # thickness of the outer layer of a cell
_LEAST_POINTS = 3
_ROUND = 0.15  # radius of the half circles of the track, as a share of the foot's length


@dataclass(frozen=True, eq=False)
class Border:
    """Points around a foot, counter-clockwise from the rear of the heel; medial = +x.

    Parameters
    ----------
    places, outward : (n, 2) float64, mm
        Outermost points of the foot, and the unit direction in which each was sought.
    """

    places: FloatArray
    outward: FloatArray


def foot_border(foot: Foot) -> Border:
    """Find the border of the foot below 30 mm above the ground; cached with the foot."""
    return foot.derived.get("border", (), lambda: _find(foot))


def _find(foot: Foot) -> Border:
    points = _low_points(foot)
    track = _Track(_ROUND * foot.length_mm, foot.length_mm)
    way, distance = track.of(points[:, :2])
    count = round(track.round_mm / _CELL_MM)
    column = np.floor(way / track.round_mm * count).astype(int) % count
    level = np.floor(np.clip(points[:, 2], 0, None) / _CELL_MM).astype(int)
    reach = _outside(column, level, distance, count)
    known = np.flatnonzero(np.isfinite(reach))
    reach = np.interp(np.arange(count), known, reach[known], period=count)
    gap = round(_GAP_MM / _CELL_MM) + 1
    reach = scipy.ndimage.grey_closing(reach, size=(gap,), mode="wrap")
    reach = scipy.ndimage.gaussian_filter1d(reach, _EVENING_MM / _CELL_MM, mode="wrap")
    base, outward = track.at((np.arange(count) + 0.5) / count * track.round_mm)
    return Border(base + reach[:, None] * outward, outward)


def _low_points(foot: Foot) -> FloatArray:
    """Sample points (n, 3) evenly over the lower foot, medial = +x."""
    part = foot.mesh.part(foot.mesh.vertices[:, 2] < _BORDER_HEIGHT_MM + _ABOVE_MM)
    even = replace(part, vertices=relaxed(part, _ROUNDS))
    points = sample_triangles(even, _PITCH_MM).points
    low = points[points[:, 2] < _BORDER_HEIGHT_MM]
    return np.asarray(low * [foot.side.medial_sign, 1.0, 1.0])


def _outside(column: IntArray, level: IntArray, distance: FloatArray, count: int) -> FloatArray:
    """Return how far out each column reaches, (count,): as far as its outermost cell.

    A cell reaches to the mean plus the standard deviation of its outer layer: a vertical flank
    ends at its mean, a sloping surface beyond it.
    """
    levels = int(level.max()) + 1
    cell, cells = column * levels + level, count * levels
    outermost = np.full(cells, -np.inf)
    np.maximum.at(outermost, cell, distance)
    near = distance > outermost[cell] - _DEPTH_MM
    cell, distance = cell[near], distance[near]
    number = np.bincount(cell, minlength=cells)
    mean, square = (
        np.bincount(cell, distance**power, minlength=cells) / np.maximum(number, 1)
        for power in (1, 2)
    )
    std = np.sqrt(np.maximum(square - mean**2, 0.0))
    reach = np.where(number >= _LEAST_POINTS, mean + std, -np.inf)
    return np.asarray(reach.reshape(count, levels).max(axis=1))


@dataclass(frozen=True)
class _Track:
    """A closed track around the middle line of a foot: two straights and two half circles."""

    radius_mm: float
    length_mm: float

    @property
    def _quarter_mm(self) -> float:
        return np.pi / 2 * self.radius_mm

    @property
    def _straight_mm(self) -> float:
        return self.length_mm - 2 * self.radius_mm

    @property
    def round_mm(self) -> float:
        """Length of the track."""
        return 2 * (2 * self._quarter_mm + self._straight_mm)

    def of(self, xy: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the arc length (n,) along the track and the distance (n,) from the middle line.

        The arc length starts at the rear and runs over +x.
        """
        x, y = xy.T
        along = np.clip(y - self.radius_mm, 0, self._straight_mm)
        ahead = y - self.radius_mm - along
        angle = np.arctan2(np.abs(x), -ahead)
        way = along + angle * self.radius_mm
        return np.where(x < 0, self.round_mm - way, way), np.hypot(x, ahead)

    def at(self, way: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return points (n, 2) of the middle line, and the unit outward directions there."""
        half = np.minimum(way, self.round_mm - way)
        along = np.clip(half - self._quarter_mm, 0, self._straight_mm)
        angle = (half - along) / self.radius_mm
        side = np.where(way > self.round_mm / 2, -1.0, 1.0)
        base = np.column_stack([np.zeros_like(along), self.radius_mm + along])
        return base, np.column_stack([side * np.sin(angle), -np.cos(angle)])
