"""A solid between two height fields over one plan, closed by walls: valid by construction."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.primitives.height_field import HeightField
from insole_core.messages import Message
from insole_core.solids.rounded_edge import EdgeArcs, EdgePlaces, RoundedEdge
from insole_core.solids.solid_outline import OutlineDistance
from insole_core.solids.trimmed_grid import Plan

LEAST_WALL_MM = 0.3
"""Least height of a wall, so that top and bottom never meet."""
_ROUNDS = 300
_FADE = 1.3  # above 1, so that the border, within a step of the outline, gets the full lean
_LEAST_SHARE = 0.05  # share of its area that a triangle keeps
_BAND_SHARE = 4.0
"""Width of the band in which the bottom makes way for an inward wall, relative to its lean."""


@dataclass(frozen=True, eq=False)
class Walls:
    """Sides of a prism that differ from place to place; they end on its underside, which stays.

    Parameters
    ----------
    draft_deg : (ny, nx) float64
        Inclination of the wall that is nearest to each node, from the vertical; positive: wider at
        the bottom.
    chamfer_mm
        Width of the bevel along the upper edge; the wall keeps at least half of its height.
    edge
        The rounding of the upper edge; None for a sharp one.
    """

    draft_deg: FloatArray
    chamfer_mm: float
    edge: RoundedEdge | None


@dataclass(frozen=True, eq=False)
class Faces:
    """Top and bottom of a prism at the nodes of one lattice, and the centres of the plan's fans.

    Parameters
    ----------
    top_mm, bottom_mm : (ny, nx) float64
        Where they lie nearer than `LEAST_WALL_MM`, the top is raised.
    tips : (k, 4) float64, mm
        x, y, top and bottom, for each fan of the plan.
    """

    top_mm: FloatArray
    bottom_mm: FloatArray
    tips: FloatArray = field(default_factory=lambda: np.zeros((0, 4)))


@dataclass(frozen=True, eq=False)
class Prism:
    """A solid of one plan between any two faces, closed by walls.

    Parameters
    ----------
    plan
        Plan of the top; its border becomes the upper rim.
    lattice
        Provides the positions of its nodes.
    outline
        Exact within `band_mm` of the draft.
    walls
        Or the draft of plain ones: their inclination from the vertical in degrees; positive: wider
        at the bottom. It is reduced where walls would cross, in tight concave corners.
    """

    plan: Plan
    lattice: HeightField
    outline: OutlineDistance
    walls: Walls | float

    def between(self, faces: Faces) -> TriangleMesh:
        """Close the space between two faces.

        Returns
        -------
        TriangleMesh, mm, frame of the lattice
            Closed, facing outwards.
        """
        vertices = self.vertices(faces)
        return TriangleMesh(vertices, _skin(self.plan, len(vertices) // 2))

    def vertices(self, faces: Faces) -> FloatArray:
        """Return the vertices (2 n, 3) between two faces, mm: of the top, and those below them."""
        plan, lattice = self.plan, self.lattice
        faces = replace(faces, top_mm=np.maximum(faces.top_mm, faces.bottom_mm + LEAST_WALL_MM))
        places = plan.carry(lattice.nodes[:, :2].reshape(*lattice.heights_mm.shape, 2))
        top, bottom = plan.carry(faces.top_mm), plan.carry(faces.bottom_mm)
        shaped = self.walls if isinstance(self.walls, Walls) else None
        draft = np.asarray(self.walls) if shaped is None else plan.carry(shaped.draft_deg)
        lean, out = _lean(plan, faces, self.outline, draft), np.zeros_like(places)
        if shaped is not None:
            lean[_inner(plan, draft > 0)] = 0
            top, out = self._edged(shaped, faces, top, bottom)
        fans = _Fans.of(plan, places, faces.tips[:, :2], lattice.step_mm)
        lean = fans.with_tips(_without_folds(fans.halved, places, lean))
        places, top, bottom = (
            np.concatenate([places, faces.tips[:, :2]]),
            np.concatenate([top, faces.tips[:, 2]]),
            np.concatenate([bottom, faces.tips[:, 3]]),
        )
        if len(faces.tips):
            lean = _without_folds(plan.triangles, places, lean)
        if shaped is not None:
            draft = fans.with_tips(draft)
            moved = np.flatnonzero((lean != 0).any(axis=1))
            below = replace(lattice, heights_mm=faces.bottom_mm).height_at((places + lean)[moved])
            most = np.where(draft[moved] > 0, bottom[moved], top[moved] - LEAST_WALL_MM)
            bottom[moved] = np.fmin(below, most)
        out = _without_folds(plan.triangles, places, fans.with_tips(out))
        return np.concatenate(
            [np.column_stack([places + out, top]), np.column_stack([places + lean, bottom])]
        )

    def edge_notes(self, faces: Faces) -> tuple[Message, ...]:
        """Say where the edge between two faces is not rounded as asked for."""
        if not isinstance(self.walls, Walls) or self.walls.edge is None:
            return ()
        return self.walls.edge.notes(self._arcs(self.walls, self.walls.edge, faces))

    def _arcs(self, walls: Walls, edge: RoundedEdge, faces: Faces) -> EdgeArcs:
        return edge.arcs(self.lattice, faces.top_mm, faces.bottom_mm, walls.draft_deg)

    def _edged(
        self, walls: Walls, faces: Faces, top: FloatArray, bottom: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the heights (n,) of the top with its edge, and by how much it moves (n, 2)."""
        inside, edged, out = self.plan.inside_mm, top.copy(), np.zeros((len(top), 2))
        if walls.edge is not None and self._beside_edge is not None:
            band, outward, at = self._beside_edge
            arcs = self._arcs(walls, walls.edge, faces)
            edged[band], out_mm = arcs.on_arc(at, inside[band], top[band])
            out[band] = out_mm[:, None] * outward
        bevel = np.maximum(walls.chamfer_mm - inside, 0)
        edged = np.minimum(edged, top - np.minimum(bevel, (top - bottom) / 2))
        return np.maximum(edged, np.minimum(top, bottom + LEAST_WALL_MM)), out

    @cached_property
    def _beside_edge(self) -> tuple[IntArray, FloatArray, EdgePlaces] | None:
        """The vertices (n,) of the rounded edge, outwards (n, 2), and where along it they lie."""
        if not isinstance(self.walls, Walls) or self.walls.edge is None:
            return None
        plan, edge = self.plan, self.walls.edge
        band = np.flatnonzero(plan.inside_mm < edge.reach_mm)
        nodes = self.lattice.nodes[:, :2].reshape(*self.lattice.heights_mm.shape, 2)
        outward = plan.carry(self.outline.outward)[band]
        points = plan.carry(nodes)[band] + plan.inside_mm[band, None] * outward
        return band, outward, edge.beside(points)


@dataclass(frozen=True, eq=False)
class _Fans:
    """The cells of a plan that have a vertex in their middle, which follows their corners.

    So it does not matter for the walls whether there are pads.

    Parameters
    ----------
    halved : (m, 3)
        The plan's triangles with these cells halved, as all others are.
    corners : (k, 4)
        Counter-clockwise.
    weights : (k, 4) float64
        Bilinear ones of the corners at the tip.
    """

    halved: IndexArray
    corners: IndexArray
    weights: FloatArray

    @classmethod
    def of(cls, plan: Plan, places: FloatArray, tips: FloatArray, step_mm: float) -> _Fans:
        """Return the fans of a plan with its other vertices at places (n, 2), tips (k, 2)."""
        is_fan = (plan.triangles >= len(places)).any(axis=1)
        fans = plan.triangles[is_fan]
        fans = fans[np.argsort(fans[:, 2], kind="stable")]
        corners = fans[:, 0].reshape(len(tips), 4)
        halves = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
        off = 1 - np.abs(places[corners] - tips[:, None]) / step_mm
        return cls(np.concatenate([plan.triangles[~is_fan], halves]), corners, off.prod(axis=2))

    def with_tips(self, values: FloatArray) -> FloatArray:
        """Return values at the vertices (n, ...), followed by those at the tips."""
        at_corners = np.moveaxis(values[self.corners], 1, -1)
        weights = self.weights.reshape(len(self.weights), *(1,) * (values.ndim - 1), 4)
        return np.concatenate([values, (at_corners * weights).sum(axis=-1)])


def _inner(plan: Plan, chosen: BoolArray) -> BoolArray:
    """Return which of the chosen vertices (n,) are not on the border of the plan."""
    inner = chosen.copy()
    inner[plan.border.ravel()] = False
    return inner


def band_mm(height_mm: float, draft_deg: float) -> float:
    """Return how far from the outline an inward-leaning wall of this height changes the bottom."""
    return float(_BAND_SHARE * height_mm * np.tan(np.radians(max(-draft_deg, 0.0))))


def _lean(plan: Plan, faces: Faces, outline: OutlineDistance, draft_deg: FloatArray) -> FloatArray:
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
