"""A solid between two height fields over one plan, closed by walls: valid by construction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray, IndexArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.surface.height_field import HeightField
from insole_core.solids.solid_outline import OutlineDistance
from insole_core.solids.trimmed_grid import Plan

_ROUNDS = 300
_FADE = 1.3  # above 1, so that the border, within a step of the outline, gets the full lean
_LEAST_SHARE = 0.05  # share of its area that a triangle keeps
_BAND_SHARE = 4.0
"""Width of the band in which the bottom makes way for an inward wall, relative to its lean."""


@dataclass(frozen=True, eq=False)
class Faces:
    """Top and bottom of a prism at the nodes of one lattice, and the centres of the plan's fans.

    Parameters
    ----------
    top_mm, bottom_mm : (ny, nx) float64
        The bottom is nowhere higher than the top.
    tips : (k, 4) float64, mm
        x, y, top and bottom, for each fan of the plan.
    """

    top_mm: FloatArray
    bottom_mm: FloatArray
    tips: FloatArray


def prism(
    plan: Plan, field: HeightField, faces: Faces, outline: OutlineDistance, draft_deg: float
) -> TriangleMesh:
    """Close the space between two faces by walls.

    Parameters
    ----------
    plan
        Plan of the top; its border becomes the upper rim.
    field
        Provides the positions of the lattice's nodes.
    outline
        Exact within `band_mm` of the draft.
    draft_deg
        Inclination of the walls from the vertical; positive: wider at the bottom. It is reduced
        where walls would cross, in tight concave corners.

    Returns
    -------
    TriangleMesh, mm, the field's frame
        Closed, facing outwards.
    """
    places = plan.carry(field.nodes[:, :2].reshape(*field.heights_mm.shape, 2))
    top, bottom = plan.carry(faces.top_mm), plan.carry(faces.bottom_mm)
    lean = _lean(plan, faces, outline, draft_deg)
    places, top, bottom = (
        np.concatenate([places, faces.tips[:, :2]]),
        np.concatenate([top, faces.tips[:, 2]]),
        np.concatenate([bottom, faces.tips[:, 3]]),
    )
    lean = np.concatenate([lean, np.zeros((len(faces.tips), 2))])
    foot_of_wall = places + _without_folds(plan.triangles, places, lean)
    vertices = np.concatenate(
        [np.column_stack([places, top]), np.column_stack([foot_of_wall, bottom])]
    )
    return TriangleMesh(vertices, _skin(plan, len(places)))


def band_mm(height_mm: float, draft_deg: float) -> float:
    """Return how far from the outline an inward-leaning wall of this height changes the bottom."""
    return float(_BAND_SHARE * height_mm * np.tan(np.radians(max(-draft_deg, 0.0))))


def _lean(plan: Plan, faces: Faces, outline: OutlineDistance, draft_deg: float) -> FloatArray:
    """Return the offset (n, 2) of each vertex from top to bottom, fading away from the outline."""
    wall = plan.carry(faces.top_mm - faces.bottom_mm)
    fade = np.clip(_FADE * (1 - np.abs(plan.carry(outline.inside_mm)) / outline.reach_mm), 0, 1)
    slope = np.tan(np.radians(draft_deg))
    return np.asarray((slope * wall * fade)[:, None] * plan.carry(outline.outward))


def _without_folds(triangles: IndexArray, places: FloatArray, lean: FloatArray) -> FloatArray:
    """Shorten the offsets around triangles that would turn over, until none does."""
    lean = lean.copy()
    leaning = (lean != 0).any(axis=1)
    moved = triangles[leaning[triangles].any(axis=1)]
    area = _areas(places[moved])
    for _ in range(_ROUNDS):
        folded = np.flatnonzero(_areas((places + lean)[moved]) < _LEAST_SHARE * area)
        if len(folded) == 0:
            return lean
        lean[moved[folded]] *= 0.7
    return np.zeros_like(lean)


def _areas(corners: FloatArray) -> FloatArray:
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def _skin(plan: Plan, count: int) -> IndexArray:
    """Return top, bottom and walls; vertex i of the top has the vertex i + count below it."""
    start, end = plan.border.T
    below = plan.triangles[:, ::-1] + np.int32(count)
    walls = [
        np.stack([start + count, end + count, end], axis=1),
        np.stack([start + count, end, start], axis=1),
    ]
    return np.concatenate([plan.triangles, below, *walls]).astype(np.int32, copy=False)
