"""Surface of a mould or a finished insole seen by one sensor, without a reference system.

Thesis 8.2: the replica lies on a table or the floor under the sensor. Its support is found as the
dominant plane of the picture and removed, with everything that stands apart from the replica.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.errors import ReconstructionError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import inverse, rigid
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct.views.coloring import color_points
from insole_core.reconstruct.views.measured_view import measure_view
from insole_core.reconstruct.views.range_mesh import (
    RangeMesh,
    join,
    longest_edges,
    triangulate,
    without_small_pieces,
)
from insole_core.recording.session import View

_FARTHEST_MM = 1600.0
_TRIALS = 400
_NEAR_PLANE_MM = 4.0
_LEAST_TABLE_SHARE = 0.15
_ABOVE_SPREADS, _LEAST_ABOVE_MM = 3.0, 2.0
_TALLEST_MM = 250.0
_LENGTH_MM = (60.0, 450.0)


@dataclass(frozen=True, eq=False)
class _Table:
    """A plane: unit normal (3,) towards the sensor, distance from the sensor, and noise, mm."""

    normal: FloatArray
    distance_mm: float
    spread_mm: float

    def heights(self, points: FloatArray) -> FloatArray:
        return np.asarray(points @ self.normal + self.distance_mm)


def one_view_surface(view: View, progress: Progress = SILENT) -> TriangleMesh:
    """Reconstruct the coloured surface of the single object in front of a sensor.

    Returns
    -------
    TriangleMesh, mm
        Open, facing the sensor. z is the height above its support, y runs along its length (in
        either direction), the origin is below its centre. Without a flat support, z points towards
        the sensor.

    Raises
    ------
    ReconstructionError
        If the frames differ, or nothing of the size of a foot is seen.
    """
    progress.step(0.0, "Averaging the frames")
    try:
        measured = measure_view(view)
    except ReconstructionError as error:
        raise ReconstructionError(
            "The view {view} cannot be used: {reason}; record it again.",
            view=view.name,
            reason=error.message,
        ) from error
    progress.step(0.6, "Taking the background away")
    points = measured.points
    valid = np.isfinite(points[..., 2]) & (points[..., 2] < _FARTHEST_MM)
    table = _find_table(points[valid])
    wanted = valid if table is None else _above(table, points, valid)
    edges = longest_edges(points[..., 2], view.sensor.depth_camera.fx)
    colors = color_points(points, wanted, measured.color, view.sensor)
    sheet = RangeMesh(
        points, triangulate(points, wanted, edges), colors, np.eye(4), view.sensor.depth_camera
    )
    if len(sheet.triangles) == 0:
        raise _nothing_seen(view)
    thing = _middle_piece(join([without_small_pieces(sheet)]), view)
    progress.step(1.0, "The surface is ready")
    return thing.transformed(_sensor2table(thing.vertices, table))


def _find_table(points: FloatArray) -> _Table | None:
    """Find the plane under most of the points (n, 3) by random trials; None if there is none."""
    if len(points) < 3:
        return None
    rng = np.random.default_rng(0)
    sample = points[rng.integers(0, len(points), 4000)]
    corners = sample[rng.integers(0, len(sample), (_TRIALS, 3))]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(normals, axis=1)
    normals, origins = normals[size > 0] / size[size > 0, None], corners[size > 0, 0]
    away = np.abs(sample @ normals.T - (origins * normals).sum(axis=1))
    best = int((away < _NEAR_PLANE_MM).sum(axis=0).argmax())
    table = _Table(normals[best], -float(origins[best] @ normals[best]), _NEAR_PLANE_MM)
    for _ in range(3):
        near = points[np.abs(table.heights(points)) < _NEAR_PLANE_MM]
        table = _fitted(near)
    share = len(near) / len(points)
    return table if share >= _LEAST_TABLE_SHARE else None


def _fitted(points: FloatArray) -> _Table:
    centre = points.mean(axis=0)
    normal = np.linalg.eigh(np.cov((points - centre).T))[1][:, 0]
    normal = normal if normal @ centre < 0 else -normal
    spread = float(((points - centre) @ normal).std())
    return _Table(normal, -float(centre @ normal), spread)


def _above(table: _Table, points: FloatArray, valid: BoolArray) -> BoolArray:
    height = table.heights(points)
    least = max(_ABOVE_SPREADS * table.spread_mm, _LEAST_ABOVE_MM)
    return valid & (height > least) & (height < _TALLEST_MM)


def _middle_piece(mesh: TriangleMesh, view: View) -> TriangleMesh:
    """Keep, of the components that may be a foot's replica, the one nearest the optical axis."""
    _, piece = scipy.sparse.csgraph.connected_components(mesh.links.adjacency, directed=False)
    fitting: list[tuple[float, int]] = []
    for number in np.flatnonzero(np.bincount(piece) >= 100):
        places = mesh.vertices[piece == number]
        length = float(np.linalg.norm(np.ptp(places, axis=0)))
        if _LENGTH_MM[0] <= length <= _LENGTH_MM[1]:
            centre = places.mean(axis=0)
            fitting.append((float(np.hypot(*centre[:2]) / centre[2]), int(number)))
    if not fitting:
        raise _nothing_seen(view)
    return mesh.part(np.asarray(piece == min(fitting)[1]))


def _nothing_seen(view: View) -> ReconstructionError:
    low, high = _LENGTH_MM
    return ReconstructionError(
        "In the view {view} nothing of {least_mm:g} to {most_mm:g} mm stands out from its "
        "background; lay the mould or insole alone on a flat table under the sensor, and record it "
        "again.",
        view=view.name,
        least_mm=low,
        most_mm=high,
    )


def _sensor2table(points: FloatArray, table: _Table | None) -> FloatArray:
    up = np.array([0.0, 0.0, -1.0]) if table is None else table.normal
    flat = points - points.mean(axis=0)
    flat = flat - np.outer(flat @ up, up)
    along = np.linalg.eigh(np.cov(flat.T))[1][:, 2]
    along = along - (along @ up) * up
    along /= np.linalg.norm(along)
    below = points.mean(axis=0)
    height = table.heights(below) if table is not None else float(((points - below) @ up).max())
    axes = np.stack([np.cross(along, up), along, up], axis=1)
    return inverse(rigid(axes, below - height * up))
