"""How low the tip of a cutter may go on the lines of a raster, without touching the solids."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.milling.machine import Cutter
from insole_core.milling.surface import Surface

STEEPEST = np.tan(np.radians(75.0))
"""Of a path: beside a rim the cutter does not fall along the wall, which the contour cuts."""


def tip_heights(
    surface: Surface, cutter: Cutter, lines: IntArray, allowance_mm: float = 0.0
) -> FloatArray:
    """Compute the lowest tip of a cutter that keeps an allowance from the surface.

    It is the dilation of the surface by the cutter, enlarged by the allowance.

    Parameters
    ----------
    lines : (k,) int64
        Indices of the grid's lines along which the cutter goes.

    Returns
    -------
    (k, ny) float64, mm
        Above the bottom of the block, at the nodes of each line.
    """
    radius = cutter.radius_mm + allowance_mm
    reach = int(radius / surface.step_mm)
    ring = np.pad(surface.heights_mm, reach, constant_values=np.float32(surface.floor_mm))
    ny = surface.inside.shape[1]
    lift = np.float32(-np.inf)
    tips = np.full((len(lines), ny), lift)
    for i in range(-reach, reach + 1):
        row = ring[lines + i + reach]
        for j in range(reach + 1):
            distance2 = (i * i + j * j) * surface.step_mm**2
            if distance2 > radius**2:
                break
            cap = np.float32(_cap(cutter, radius, distance2))
            level = row[:, reach + j : reach + j + ny]
            if j:
                level = np.maximum(level, row[:, reach - j : reach - j + ny])
            np.maximum(tips, level + cap, out=tips)
    return np.asarray(tips, float)


def _cap(cutter: Cutter, radius_mm: float, distance2: FloatArray | float) -> FloatArray:
    """Return the tip above a point that the enlarged cutter touches at a horizontal distance."""
    if cutter.shape == "flat":
        return np.full_like(np.asarray(distance2, float), radius_mm - cutter.radius_mm)
    return np.asarray(np.sqrt(radius_mm**2 - distance2) - cutter.radius_mm)


def finishing_heights(surface: Surface, cutter: Cutter, lines: IntArray) -> FloatArray:
    """Compute the tips of a ball-nose cutter that leaves the surface, as `tip_heights`.

    Between its nodes the path neither cuts off the arcs that the ball describes round an edge, nor
    misses what rises between the nodes of the grid.
    """
    tips = tip_heights(_beside_walls(surface), cutter, lines)
    _touch_edges(surface, cutter, lines, tips)
    # The ball may touch half a diagonal beside a node; so much higher is what it would touch there.
    tips += surface.step_mm**2 / (4 * cutter.radius_mm)
    slope = STEEPEST * surface.step_mm * np.arange(tips.shape[1])
    falling = np.maximum.accumulate(tips + slope, axis=1) - slope
    rising = np.maximum.accumulate((tips - slope)[:, ::-1], axis=1)[:, ::-1] + slope
    return _over_arcs(np.maximum(falling, rising))


def _beside_walls(surface: Surface) -> Surface:
    """Return the surface with its walls one node farther out.

    A wall falls by much between two nodes, and the ball must keep off all of it.
    """
    highest = cv2.dilate(surface.heights_mm, np.ones((3, 3), np.uint8))
    steep = highest - surface.heights_mm > STEEPEST * np.sqrt(2) * surface.step_mm
    heights = np.where(steep, highest, surface.heights_mm)
    return replace(surface, heights_mm=heights)


def _touch_edges(surface: Surface, cutter: Cutter, lines: IntArray, tips: FloatArray) -> None:
    """Raise tips (k, ny) where the ball would cut into the edges; the lines are evenly spaced."""
    radius, step = cutter.radius_mm, surface.step_mm
    if len(lines) < 2:
        return
    spacing = float(lines[1] - lines[0]) * step
    place = surface.edges_mm[:, :2] - surface.first_mm
    first_line = np.ceil((place[:, 0] - lines[0] * step - radius) / spacing).astype(int)
    first_node = np.ceil((place[:, 1] - radius) / step).astype(int)
    for i in range(int(2 * radius / spacing) + 1):
        line = first_line + i
        across = (line * spacing + lines[0] * step - place[:, 0]) ** 2
        reached = np.flatnonzero((line >= 0) & (line < len(lines)) & (across <= radius**2))
        for j in range(int(2 * radius / step) + 1):
            node = first_node[reached] + j
            distance2 = across[reached] + (node * step - place[reached, 1]) ** 2
            near = (node >= 0) & (node < tips.shape[1]) & (distance2 <= radius**2)
            cap = _cap(cutter, radius, distance2[near]) + surface.edges_mm[reached[near], 2]
            np.maximum.at(tips, (line[reached[near]], node[near]), cap)


def _over_arcs(tips: FloatArray) -> FloatArray:
    """Raise a path so that its straight pieces stay above the arcs between its nodes."""
    sag = np.zeros_like(tips)
    sag[:, 1:-1] = np.maximum(2 * tips[:, 1:-1] - tips[:, 2:] - tips[:, :-2], 0) / 8
    raised = sag.copy()
    np.maximum(raised[:, 1:], sag[:, :-1], out=raised[:, 1:])
    np.maximum(raised[:, :-1], sag[:, 1:], out=raised[:, :-1])
    return np.asarray(tips + raised)
