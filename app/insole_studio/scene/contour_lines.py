"""Contour lines of the contact surface, thinned out so that they show its form."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.sections import level_lines
from insole_studio.texts import localised

STEP_MM = 1.0
STRONG = 5
"""Every fifth line is drawn stronger, and labelled."""
_STEEPEST_DEG, _STEEPEST_STRONG_DEG = 25.0, 50.0
"""Steeper than this, lines 1 mm and 5 mm apart would merge to a dark band."""
_STEEPEST_LABEL_DEG = 25.0
_LABEL_ROOM_MM, _LABEL_GAP_MM = 5.0, 22.0
"""Least distance of a label from the rim and the lines of other levels, and from other labels."""


@dataclass(frozen=True, eq=False)
class ContourLines:
    """Lines of equal height, ready to be drawn.

    Parameters
    ----------
    thin, strong : (k, 2, 3) float64, mm, insole frame
        Segments of the lines.
    labels
        Places (3,) on strong lines, mm, and the heights there as text.
    """

    thin: FloatArray
    strong: FloatArray
    labels: tuple[tuple[FloatArray, str], ...]


def contour_lines(
    vertices: FloatArray, normals: FloatArray, triangles: IndexArray, rim: BoolArray
) -> ContourLines:
    """Draw a line every millimetre of height where the surface is not steep, numbers included.

    Parameters
    ----------
    vertices : (n, 3) float64, mm, insole frame
    normals : (n, 3) float64
        Unit normals.
    triangles : (m, 3) int32
        Of the contact surface.
    rim : (n,) bool
        Whether a vertex lies at its edge.
    """
    lines = level_lines(vertices, triangles, STEP_MM)
    upward = normals[triangles[lines.triangle], 2].mean(axis=1)
    is_strong = lines.number % STRONG == 0
    thin = ~is_strong & (upward > _cos(_STEEPEST_DEG))
    strong = is_strong & (upward > _cos(_STEEPEST_STRONG_DEG))
    gentle = upward[strong] > _cos(_STEEPEST_LABEL_DEG)
    labels = _labels(
        lines.segments[strong].mean(axis=1), lines.number[strong], gentle, vertices[rim]
    )
    return ContourLines(lines.segments[thin], lines.segments[strong], labels)


def _labels(
    places: FloatArray, number: IntArray, gentle: BoolArray, rim: FloatArray
) -> tuple[tuple[FloatArray, str], ...]:
    """Put a label where a line is furthest from rim and other levels, if there is room."""
    labels: list[tuple[FloatArray, str]] = []
    for level in np.unique(number[gentle]):
        here = places[gentle & (number == level)]
        others = places[number != level]
        around = np.concatenate([others, rim])[:, :2]
        room = np.asarray(scipy.spatial.cKDTree(around).query(here[:, :2])[0])
        for place, _ in labels:
            near = np.linalg.norm(here[:, :2] - place[:2], axis=1) < _LABEL_GAP_MM
            room[near] = 0.0
        best = int(room.argmax())
        if room[best] >= _LABEL_ROOM_MM:
            labels.append((here[best], localised(level * STEP_MM, "g")))
    return tuple(labels)


def _cos(angle_deg: float) -> float:
    return float(np.cos(np.radians(angle_deg)))
