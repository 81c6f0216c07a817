"""Where lines of a raster leave more than their ridges, so that others are needed between them."""

from __future__ import annotations

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.milling.machine import Finishing
from insole_core.milling.surface import Surface

_GAP_MM = 0.02
"""By which the cutter may be farther from the surface between two lines than on them."""
_RIDGES = 2.0
"""Height of ridges on a slope, of those on the level."""
_JOINED_MM = 6.0
_LONGER_MM = 0.75
"""By which pieces begin before the place that needs them."""
_RIM_MM = 0.4


def added_lines(surface: Surface, tips: FloatArray, how: Finishing) -> BoolArray:
    """Find the nodes (nx, ny) between the lines of a raster to which the cutter must go too.

    Parameters
    ----------
    tips : (nx, ny) float64, mm
        Lowest tips of the cutter at all nodes. The raster takes every few lines.
    """
    every = surface.steps_in(how.step_over_mm)
    needed = np.zeros(tips.shape, bool)
    touched = _touches(surface, tips, how.cutter.radius_mm)
    spans = [(0, every)]
    while spans:
        first, last = spans.pop()
        middle = (first + last) // 2
        if middle == first:
            continue
        spans += [(first, middle), (middle, last)]
        lines = np.arange(0, tips.shape[0] - last, every)
        share = (middle - first) / (last - first)
        below, above = tips[lines + first], tips[lines + last]
        across = (above - below) / ((last - first) * surface.step_mm)
        along = np.gradient(tips[lines + middle], surface.step_mm, axis=1)
        gap = below * (1 - share) + above * share - tips[lines + middle]
        too_far = gap > _GAP_MM * np.sqrt(1 + across**2 + along**2)
        wide = ((last - first) / every) ** 2 * (1 + across**2) > _RIDGES
        needed[lines + middle] = (too_far | wide) & touched[lines + middle]
    return _joined(needed, surface.step_mm)


def _touches(surface: Surface, tips: FloatArray, radius_mm: float) -> BoolArray:
    """Find the nodes at which the ball touches the solids off their rim."""
    size = 2 * int(np.ceil(_RIM_MM / surface.step_mm)) + 1
    within = cv2.erode(surface.inside.astype(np.uint8), np.ones((size, size), np.uint8)) > 0
    slopes = np.gradient(tips, surface.step_mm)
    steep = radius_mm / surface.step_mm / np.sqrt(1 + slopes[0] ** 2 + slopes[1] ** 2)
    nodes = np.indices(tips.shape)
    places = [
        np.clip(np.rint(node + slope * steep).astype(int), 0, size - 1)
        for node, slope, size in zip(nodes, slopes, tips.shape, strict=True)
    ]
    return np.asarray(within[places[0], places[1]])


def _joined(needed: BoolArray, step_mm: float) -> BoolArray:
    """Return pieces along the lines that are longer, and joined where little is between them."""
    longer, gap = (2 * int(size / step_mm) + 1 for size in (_LONGER_MM, _JOINED_MM / 2))
    grown = cv2.dilate(needed.astype(np.uint8), np.ones((1, longer), np.uint8))
    closed = cv2.morphologyEx(grown, cv2.MORPH_CLOSE, np.ones((1, gap), np.uint8))
    return np.asarray(closed > 0)
