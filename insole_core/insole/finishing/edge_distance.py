"""Where the nodes of a grid lie relative to the insole's edge."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.insole.finishing.edge import Edge, insole_edge
from insole_core.insole.finishing.thin_plate import Plate
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.primitives.height_field import Grid, HeightField

_BEYOND_STEPS = 1.6
"""How far the plate reaches beyond the edge, in steps of the grid: the edge's cells are whole."""
_OUTSIDE_STEPS = 3
LEAST_DEPTH_MM, DEPTH_PITCH_MM, _MOST_DEPTH_MM = 4.0, 0.5, 46.0
_NEAREST_MM = 1.5  # by which a node may lie nearer to another part of the edge


@dataclass(frozen=True, eq=False)
class InwardLines:
    """Lines from the points of an edge inwards, with a place every 0.5 mm.

    Parameters
    ----------
    depth_mm : (k,) float64
        Distances of the places from the edge, from 4 mm on.
    places_mm : (n, k, 2) float64
    room_mm : (n,) float64
        Up to which depth a line is nearest to its own point: half the local width.
    """

    depth_mm: FloatArray
    places_mm: FloatArray
    room_mm: FloatArray


@dataclass(frozen=True, eq=False)
class EdgeDistance:
    """The nodes of a grid seen from the edge, and the plate that joins them.

    Parameters
    ----------
    grid
        Position of the first node, step, and shape.
    inside_mm : (ny, nx) float64
        Distance from the edge; negative outside, -inf far outside.
    arc_mm : (ny, nx) float64
        Arc length of the nearest point of the edge.
    x_mm, y_mm : (ny, nx) float64
        Places of the nodes, insole frame.
    """

    edge: Edge
    grid: Grid
    inside_mm: FloatArray
    arc_mm: FloatArray
    x_mm: FloatArray
    y_mm: FloatArray
    plate: Plate

    @cached_property
    def lines_inward(self) -> InwardLines:
        """The lines normal to the edge."""
        points = self.edge.points_mm
        along = np.roll(points, -2, axis=0) - np.roll(points, 2, axis=0)
        inward = along[:, ::-1] * [-1.0, 1.0] / np.linalg.norm(along, axis=1, keepdims=True)
        depth_mm = np.arange(LEAST_DEPTH_MM, _MOST_DEPTH_MM, DEPTH_PITCH_MM)
        places = points[:, None] + depth_mm[:, None] * (inward * self.edge.turn)[:, None]
        far = self._inside_near(places) < depth_mm - _NEAREST_MM
        room_mm = np.where(far.any(axis=1), depth_mm[far.argmax(axis=1)], _MOST_DEPTH_MM)
        return InwardLines(depth_mm, places, room_mm)

    @cached_property
    def nearest_in_plate(self) -> tuple[IntArray, IntArray]:
        """Row and column, (ny, nx) each, of the plate's node nearest to each node.

        Of two equally near ones a mirrored insole takes the mirrored one.
        """
        flip = int(-self.edge.turn)
        row, column = scipy.ndimage.distance_transform_edt(
            ~self.plate.nodes[:, ::flip], return_distances=False, return_indices=True
        )
        if flip < 0:
            row, column = row[:, ::-1], self.plate.nodes.shape[1] - 1 - column[:, ::-1]
        return row, column

    def at_edge(self, values: FloatArray) -> FloatArray:
        """Interpolate values (n,) at the edge's points at the nodes' nearest ones, (ny, nx)."""
        return np.asarray(np.interp(self.arc_mm, *_closed(self.edge, values)))

    def _inside_near(self, places: FloatArray) -> FloatArray:
        """Return `inside_mm` at the nodes nearest to places (..., 2)."""
        x0, y0, step, (rows, columns) = self.grid
        at = np.rint((places - [x0, y0]) / step).astype(int)
        row, column = np.clip(at[..., 1], 0, rows - 1), np.clip(at[..., 0], 0, columns - 1)
        return np.asarray(self.inside_mm[row, column])


def edge_distance(foot: Foot, outline: Outline, field: HeightField) -> EdgeDistance:
    """Measure the nodes of a field from the edge of an outline; cached with the foot."""
    key = outline, field.grid
    return foot.derived.get(
        "edge distance", key, lambda: _measured(insole_edge(foot, outline), field)
    )


def _measured(edge: Edge, field: HeightField) -> EdgeDistance:
    near = field.nodes_about(edge.points_mm, _OUTSIDE_STEPS)
    x, y = (axis.reshape(near.shape) for axis in field.nodes.T[:2])
    inside_mm = np.full(near.shape, -np.inf)
    arc_mm = np.zeros(near.shape)
    inside_mm[near], arc_mm[near] = _from_edge(edge, np.column_stack([x[near], y[near]]))
    reaches = inside_mm > -_BEYOND_STEPS * field.step_mm
    plate = Plate.over(field, reaches, edge.points_mm)
    return EdgeDistance(edge, field.grid, inside_mm, arc_mm, x, y, plate)


def _from_edge(edge: Edge, places: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return how far places (k, 2) lie inside the edge, and the arc length of its nearest point."""
    points = edge.points_mm
    _, nearest = scipy.spatial.KDTree(points).query(places)
    best_mm = np.full(len(places), np.inf)
    arc_mm, side = np.zeros(len(places)), np.zeros(len(places))
    for start in (np.asarray(nearest) - 1, np.asarray(nearest)):
        way = points[(start + 1) % len(points)] - points[start]
        away = places - points[start]
        share = np.clip((away * way).sum(axis=1) / (way * way).sum(axis=1), 0, 1)
        off = away - share[:, None] * way
        away_mm = np.hypot(*off.T)
        nearer = away_mm < best_mm
        best_mm = np.where(nearer, away_mm, best_mm)
        arc_mm = np.where(nearer, (start + share) * edge.step_mm % edge.length_mm, arc_mm)
        side = side + way[:, 0] * away[:, 1] - way[:, 1] * away[:, 0]
    return best_mm * np.sign(side) * edge.turn, arc_mm


def _closed(edge: Edge, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    return np.append(edge.arc_mm, edge.length_mm), np.append(values, values[0])
