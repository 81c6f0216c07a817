"""Ways of the contour's cutter along the edges of undersides."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view

from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.milling.contours import Loop, outermost
from insole_core.milling.surface import Surface
from insole_core.milling.tabs import Tabs
from insole_core.milling.tool_path import densified

EDGE_STEP_MM = 0.125
_EDGE_HEIGHT_MM = 1.5
"""Between the ways along an edge, and how high above it they begin."""
_LINK_MM = 0.5
"""A way goes on to a point that is nearer: a straight line of this length cuts no corner."""
_ALONG_MM = 0.1
_EVEN_MM = 2.0
"""Between points of the edge, and how far to either side its height is evened."""


def ways_along_edge(
    loops: Sequence[Loop], surface: Surface, edge_mm: Float32Array, tabs: Tabs
) -> list[FloatArray]:
    """Put the points of loops together to ways that keep their heights above an edge.

    Where a surface falls steeply to an edge that rises and sinks, lines of the ball across it and
    levels of the contour leave steps; a level follows it only for a short way.

    Parameters
    ----------
    loops
        Round one solid, `EDGE_STEP_MM` apart.
    surface
    edge_mm : (nx, ny) float32
        Heights of the edge, beside the solids as at the nearest point.
    tabs
        Which the ways leave out.

    Returns
    -------
    (n, 3) float64 each, mm
        Of the cutter's axis, from above.
    """
    around = densified(outermost(loops), _ALONG_MM)[:-1]
    height = _evened(edge_mm[surface.index_of(around)])
    points = np.concatenate([_points(loop) for loop in loops])
    node = surface.index_of(points[:, :2])
    place = np.asarray(scipy.spatial.cKDTree(around).query(points[:, :2])[1])
    step = np.rint((points[:, 2] - height[place]) / EDGE_STEP_MM).astype(int)
    kept = (step >= 0) & (step <= _EDGE_HEIGHT_MM / EDGE_STEP_MM)
    kept &= (points[:, 2] >= tabs.axis_heights(surface)[node]) & (surface.beside_mm[node] > 0)
    points, step, place = points[kept], step[kept], place[kept]
    order = np.lexsort((place, -step))
    points, step = points[order], step[order]
    apart = np.linalg.norm(np.diff(points[:, :2], axis=0), axis=1) > _LINK_MM
    ends = np.flatnonzero(apart | (np.diff(step) != 0)) + 1
    return [_in_steps(way) for way in np.split(points, ends) if len(way) > 1]


def _points(loop: Loop) -> FloatArray:
    line = densified(loop.line_mm, _LINK_MM / 2)
    return np.column_stack([line, np.full(len(line), loop.level_mm)])


def _in_steps(way: FloatArray) -> FloatArray:
    """Let a way (n, 3) change its height only where the lower one of two points is free."""
    at = np.flatnonzero(np.diff(way[:, 2])) + 1
    before, after = way[at - 1], way[at]
    corners = np.where(before[:, 2:] < after[:, 2:], before, after)
    corners[:, 2] = np.maximum(before[:, 2], after[:, 2])
    return np.insert(way, at, corners, axis=0)


def _evened(heights_mm: FloatArray) -> FloatArray:
    """Even the heights (n,) along a closed edge, of nodes that lie more or less inside of it."""
    reach = round(_EVEN_MM / _ALONG_MM)
    for even in (np.min, np.mean):
        windows = sliding_window_view(np.pad(heights_mm, reach, mode="wrap"), 2 * reach + 1)
        heights_mm = even(windows, axis=1)
    return heights_mm
