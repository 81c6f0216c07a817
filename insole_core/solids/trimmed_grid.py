"""The part of a lattice inside an outline, triangulated so that bends along contours are smooth."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import numbered_edges

_ON_LINE_MM = 0.01
"""A vertex as near to a contour line as this counts as on it, so that no sliver arises."""
FULL = 15
"""The case of a cell with all corners inside."""
_NEAREST = 0.02
"""A crossing keeps this share of a cell's side away from the nodes: no triangle degenerates."""


@dataclass(frozen=True, eq=False)
class Split:
    """New vertices between two earlier ones each.

    Parameters
    ----------
    ends : (k, 2) int32
        Indices of the earlier vertices.
    share : (k,) float64
        Position between them, 0 at the first.
    """

    ends: IndexArray
    share: FloatArray

    def carry(self, values: FloatArray) -> FloatArray:
        """Append the new vertices' values to those of the earlier ones (n, ...)."""
        first, last = values[self.ends[:, 0]], values[self.ends[:, 1]]
        share = self.share.reshape(-1, *(1,) * (values.ndim - 1))
        return np.concatenate([values, first + share * (last - first)])


def _split_along(
    triangles: IndexArray, values: FloatArray, level: float
) -> tuple[Split, IndexArray]:
    """Split triangles where a value that is linear in each of them passes a level.

    Parameters
    ----------
    triangles : (m, 3) int32
        Counter-clockwise.
    values : (n,) float64, mm
        Of the vertices.

    Returns
    -------
    split : Split
        The new vertices, numbered from n on.
    triangles : (m + k, 3) int32
        Counter-clockwise; neighbours still share their edges.
    """
    over = values - level
    side = np.where(np.abs(over) <= _ON_LINE_MM, 0, np.sign(over)).astype(np.int8)
    first, second, third = (side[corner] for corner in triangles.T)
    is_cut = np.minimum(np.minimum(first, second), third) < 0
    is_cut &= np.maximum(np.maximum(first, second), third) > 0
    cut = triangles[is_cut]
    sides = side[cut]
    touched = (sides == 0).any(axis=1)
    crossed = ~touched
    alone = _rolled(cut[crossed], sides[crossed] == -sides[crossed].sum(axis=1)[:, None])
    on_line = _rolled(cut[touched], sides[touched] == 0)
    pairs = np.concatenate([alone[:, [0, 1]], alone[:, [0, 2]], on_line[:, [1, 2]]])
    ends, number = numbered_edges(np.sort(pairs, axis=1), len(values))
    new = (len(values) + number).astype(np.int32)
    count = len(alone)
    on_second, on_third, on_opposite = new[:count], new[count : 2 * count], new[2 * count :]
    (a, b, c), (d, e, f) = alone.T, on_line.T
    # From the nearer corner, whatever the order: a mirror image is cut in the same way.
    second_is_near = np.abs(over[b]) < np.abs(over[c])
    parts = [
        triangles[~is_cut],
        np.stack([a, on_second, on_third], axis=1),
        np.stack([b, c, np.where(second_is_near, on_third, on_second)], axis=1),
        np.stack([on_third, on_second, np.where(second_is_near, b, c)], axis=1),
        np.stack([d, e, on_opposite], axis=1),
        np.stack([d, on_opposite, f], axis=1),
    ]
    start, end = values[ends[:, 0]], values[ends[:, 1]]
    split = Split(ends.astype(np.int32), (level - start) / (end - start))
    return split, np.concatenate(parts).astype(np.int32, copy=False)


def _rolled(triangles: IndexArray, chosen: IntArray) -> IndexArray:
    """Turn triangles so that the chosen corner, one for each, comes first."""
    first = chosen.argmax(axis=1)
    return np.asarray(np.take_along_axis(triangles, (first[:, None] + np.arange(3)) % 3, axis=1))


@dataclass(frozen=True, eq=False)
class Plan:
    """Triangles over a lattice of (ny, nx) nodes.

    Parameters
    ----------
    ends : (k, 2) int64
        Flat indices of the two lattice nodes between which each of the first vertices lies.
    share : (k,) float64
        Its position between them, 0 at the first; a vertex on a node has 0 and that node twice.
    inside_mm : (n,) float64
        Distance of every vertex from the outline; 0 on the border.
    triangles : (m, 3) int32
        Counter-clockwise. Index n + k is the centre of the k-th cell of `fans`.
    border : (k, 2) int32
        Edges of the border, the inside on their left.
    fans
        Cells (row, column) with an additional vertex, in the order of their indices.
    splits
        The other vertices, between earlier ones, in the order in which they were added.
    """

    ends: IntArray
    share: FloatArray
    inside_mm: FloatArray
    triangles: IndexArray
    border: IndexArray
    fans: tuple[tuple[int, int], ...] = ()
    splits: tuple[Split, ...] = ()

    def carry(self, values: FloatArray) -> FloatArray:
        """Interpolate values at the lattice's nodes (ny, nx, ...) to the vertices (n, ...)."""
        flat = values.reshape(-1, *values.shape[2:])
        first, last = flat[self.ends[:, 0]], flat[self.ends[:, 1]]
        share = self.share.reshape(-1, *(1,) * (values.ndim - 2))
        carried = first + share * (last - first)
        for split in self.splits:
            carried = split.carry(carried)
        return np.asarray(carried)

    def split_along(self, contour_mm: float) -> Plan:
        """Return the plan with edges where the distance from the outline has a value.

        No fan may lie there.
        """
        count, fans = len(self.inside_mm), len(self.fans)
        known_mm = np.concatenate([self.inside_mm, np.full(fans, np.inf)])
        split, triangles = _split_along(self.triangles, known_mm, contour_mm)
        added = len(split.ends)
        # The centres of the fans stay the last.
        number = np.concatenate(
            [np.arange(count), count + added + np.arange(fans), count + np.arange(added)]
        ).astype(np.int32)
        return replace(
            self,
            inside_mm=split.carry(self.inside_mm),
            triangles=number[triangles],
            splits=(*self.splits, split),
        )


def trim(
    inside_mm: FloatArray,
    fans: tuple[tuple[int, int], ...] = (),
    contours_mm: tuple[float, ...] = (),
) -> Plan:
    """Triangulate where a signed distance to an outline is positive.

    Parameters
    ----------
    inside_mm : (ny, nx) float64
        Positive inside; where the outline leaves the lattice, the plan ends at its edge.
    fans
        Cells (row, column) that get an additional vertex, if they lie wholly inside.
    contours_mm
        Distances from the outline along which the plan has edges, nearer to it than all fans.
    """
    inside_mm = _closed_at_the_rim(inside_mm)
    cells = _Cells(inside_mm > 0)
    crossing_at, ends, share = _crossings(inside_mm)
    tips = tuple(cell for cell in fans if cells.case[cell] == FULL)
    first_tip = inside_mm.size + len(ends)
    known_mm = np.concatenate([inside_mm.ravel(), np.zeros(len(ends))])
    farthest_mm = max(contours_mm, default=-np.inf)
    triangles, border = cells.triangulate(crossing_at, tips, known_mm, farthest_mm)
    used = np.zeros(first_tip + len(tips), dtype=bool)
    used[triangles] = True
    number = np.cumsum(used, dtype=np.int32) - 1
    nodes = np.flatnonzero(used[: inside_mm.size])
    crossing = used[inside_mm.size : first_tip]
    plan = Plan(
        np.concatenate([np.stack([nodes, nodes], axis=1), ends[crossing]]),
        np.concatenate([np.zeros(len(nodes)), share[crossing]]),
        known_mm[used[:first_tip]],
        number[triangles],
        number[border],
        tips,
    )
    for contour_mm in contours_mm:
        plan = plan.split_along(contour_mm)
    return plan


def _closed_at_the_rim(inside_mm: FloatArray) -> FloatArray:
    """Make the outline pass inside the outermost nodes."""
    closed = np.full_like(inside_mm, -1.0)
    closed[1:-1, 1:-1] = inside_mm[1:-1, 1:-1]
    return closed


class _Cells:
    """The cells between the nodes; bit k of a cell's case: corner k (counter-clockwise) inside."""

    def __init__(self, inside: BoolArray) -> None:
        self.shape = inside.shape
        self.size = inside.size
        bit = inside.astype(np.uint8)
        self.case = bit[:-1, :-1] + 2 * bit[:-1, 1:] + 4 * bit[1:, 1:] + 8 * bit[1:, :-1]
        self.node = np.arange(self.size, dtype=np.int32).reshape(self.shape)

    def triangulate(
        self,
        crossing_at: tuple[IndexArray, IndexArray],
        tips: tuple[tuple[int, int], ...],
        known_mm: FloatArray,
        farthest_mm: float,
    ) -> tuple[IndexArray, IndexArray]:
        """Return triangles and border edges: nodes first, then crossings, then centres of fans.

        Parameters
        ----------
        known_mm : (n,) float64
            Distances of nodes and crossings from the outline.
        farthest_mm
            Up to which cells are halved along the outline rather than all in one direction.
        """
        case = self.case.copy()
        fans = [np.zeros((0, 3), np.int32)]
        for number, cell in enumerate(tips):
            case[cell] = 0
            a, b, c, d = self._corners_of(cell)
            tip = len(known_mm) + number
            fans.append(np.array([[a, b, tip], [b, c, tip], [c, d, tip], [d, a, tip]], np.int32))
        triangles, border = fans, [np.zeros((0, 2), np.int32)]
        for kind in range(1, FULL + 1):
            corners = self._corners(case == kind, crossing_at)
            polygon, cuts = _TEMPLATES[kind]
            ring = corners[:, polygon]
            if len(polygon) == 4:
                ring = _turned_along(ring, known_mm[ring], farthest_mm)
            triangles += [ring[:, [0, k, k + 1]] for k in range(1, len(polygon) - 1)]
            border += [corners[:, cut] for cut in cuts]
        return np.concatenate(triangles), np.concatenate(border)

    def _corners_of(self, cell: tuple[int, int]) -> list[int]:
        row, column = cell
        ring = [(row, column), (row, column + 1), (row + 1, column + 1), (row + 1, column)]
        return [int(self.node[place]) for place in ring]

    def _corners(self, chosen: BoolArray, crossing_at: tuple[IndexArray, IndexArray]) -> IndexArray:
        """Return (k, 8) corners a, b, c, d of chosen cells, then crossings of ab, bc, cd, da."""
        node, (flat, steep) = self.node, crossing_at
        columns = [
            node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1],
            flat[:-1], steep[:, 1:], flat[1:], steep[:, :-1],
        ]  # fmt: skip
        return np.stack([column[chosen] for column in columns], axis=1)


def _turned_along(ring: IndexArray, inside_mm: FloatArray, farthest_mm: float) -> IndexArray:
    """Turn quadrilaterals (n, 4) near the outline to be halved where it changes least."""
    apart = np.abs(inside_mm[:, :2] - inside_mm[:, 2:])
    turn = (apart[:, 1] < apart[:, 0]) & (inside_mm.min(axis=1) <= farthest_mm)
    return np.where(turn[:, None], np.roll(ring, -1, axis=1), ring)


def _crossings(
    inside_mm: FloatArray,
) -> tuple[tuple[IndexArray, IndexArray], IntArray, FloatArray]:
    """Number the crossings of the edges along x, then along y, after the nodes; locate them."""
    first = inside_mm.size
    node = np.arange(inside_mm.size).reshape(inside_mm.shape)
    numbers, ends, share = [], [], []
    for axis in (1, 0):
        start, end = (np.s_[:, :-1], np.s_[:, 1:]) if axis else (np.s_[:-1], np.s_[1:])
        cut = (inside_mm[start] > 0) != (inside_mm[end] > 0)
        number = np.full(cut.shape, -1, dtype=np.int32)
        number[cut] = first + np.arange(cut.sum(), dtype=np.int32)
        first += int(cut.sum())
        a, b = inside_mm[start][cut], inside_mm[end][cut]
        numbers.append(number)
        ends.append(np.stack([node[start][cut], node[end][cut]], axis=1))
        share.append(np.clip(a / (a - b), _NEAREST, 1 - _NEAREST))
    return (numbers[0], numbers[1]), np.concatenate(ends), np.concatenate(share)


def _template(case: int) -> tuple[list[int], list[list[int]]]:
    """Return the polygon of a case (corners 0 to 3, crossings 4 to 7), and its border sides."""
    inside = [bool(case >> corner & 1) for corner in range(4)]
    polygon: list[int] = []
    for corner in range(4):
        if inside[corner]:
            polygon.append(corner)
        if inside[corner] != inside[(corner + 1) % 4]:
            polygon.append(4 + corner)
    sides = zip(polygon, polygon[1:] + polygon[:1], strict=True)
    cuts = [[a, b] for a, b in sides if a >= 4 and b >= 4 and inside[a - 4]]
    if len(polygon) == 5:  # from the node opposite the cut: a mirror image is divided alike
        first = polygon.index((inside.index(False) + 2) % 4)
        polygon = polygon[first:] + polygon[:first]
    return polygon, cuts


_TEMPLATES = {case: _template(case) for case in range(1, FULL + 1)}
