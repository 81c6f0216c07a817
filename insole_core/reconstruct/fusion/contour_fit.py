"""Fit a mesh to occluding contours: extend it to them, move it onto them, find where they touch."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import ContourConstraints, TriangleMesh
from insole_core.geometry.mesh_boundary import Boundary
from insole_core.geometry.mesh_graph import smoothed_normals
from insole_core.geometry.point_tree import point_tree
from insole_core.reconstruct.fusion.occluding_contour import Beyond, OccludingContour
from insole_core.reconstruct.parallel import for_views

_SHORT_MM = (0.4, 9.0)
_LEAST_AHEAD = 0.3  # cosine between the direction off the border and that to the contour
_RADIUS_MM = (4.0, 25.0)
_NEAR_MM = (-1.5, 2.5)
"""A mesh that ends farther inside a contour, or beyond it, does not belong to it."""
_LEAST_FACING = 0.7
_ROUNDS, _SPREADING_ROUNDS, _DECAY = 3, 5, 0.75
_TOUCHING_MM, _TOUCHING_FACING = 0.4, 0.75
_LEAST_TOWARDS = -0.15
_TOUCHED_MM, _TOUCHED_FACING = 2.5, 0.2


def bend_to(
    rims: list[OccludingContour], everywhere: bool, border: Boundary
) -> tuple[BoolArray, FloatArray]:
    """Find where a border ends short of a contour, and the curvature that leads it there.

    An arc that leaves the border tangentially touches the plane of the rays when its radius is the
    distance to the plane, divided by 1 - cosine of the angle between the two normals.

    Parameters
    ----------
    rims
        The contours of all views.
    everywhere
        Whether the border is also extended, straight, where no contour lies ahead.
    border
        Boundary vertices of the mesh, mm, reference frame.

    Returns
    -------
    extended : (n,) bool
        Whether the mesh is extended at each vertex of the border.
    curvature : (n,) float64, 1/mm
    """
    count = len(border.vertices)
    wanted, curvature = np.full(count, everywhere), np.zeros(count)
    for rim in rims:
        beyond = rim.against(border.vertices)
        short_mm, vertex = -beyond.beyond_mm, beyond.vertex
        ahead = beyond.facing(border.outwards)
        there = (short_mm > _SHORT_MM[0]) & (short_mm < _SHORT_MM[1]) & (ahead > _LEAST_AHEAD)
        turn = np.maximum(1 - beyond.facing(border.normals), 1e-3)
        bend = 1 / np.clip(short_mm / turn, *_RADIUS_MM)
        wanted[vertex[there]] = True
        np.maximum.at(curvature, vertex[there], bend[there])
    return wanted, curvature


def drawn_to(mesh: TriangleMesh, rims: list[OccludingContour]) -> TriangleMesh:
    """Move the vertices next to the contours onto them, and their neighbours less and less.

    Parameters
    ----------
    mesh : mm, reference frame
    rims
        The contours of all views.

    Returns
    -------
    TriangleMesh, mm, reference frame
    """
    mean = mesh.links.laplacian
    for _ in range(_ROUNDS):
        held, way = _ways(mesh, rims)
        step = np.zeros_like(mesh.vertices)
        for _ in range(_SPREADING_ROUNDS):
            step[held] = way
            step = _DECAY * (step + mean @ step)
        step[held] = way
        mesh = mesh.moved(mesh.vertices + step)
    return mesh


def _ways(mesh: TriangleMesh, rims: list[OccludingContour]) -> tuple[BoolArray, FloatArray]:
    """Find the vertices (n,) beyond a contour or that should touch it, and their ways (m, 3)."""
    normals = smoothed_normals(mesh, 2)
    total, count = np.zeros_like(mesh.vertices), np.zeros(len(mesh.vertices))
    for beyond in for_views(lambda rim: rim.against(mesh.vertices), rims):
        chosen = beyond.beyond_mm >= 0
        chosen[beyond.outermost] = True
        chosen &= (beyond.beyond_mm > _NEAR_MM[0]) & (beyond.beyond_mm < _NEAR_MM[1])
        chosen &= beyond.facing(normals) > _LEAST_FACING
        vertex = beyond.vertex[chosen]
        np.add.at(total, vertex, -beyond.beyond_mm[chosen, None] * beyond.outward[chosen])
        np.add.at(count, vertex, 1.0)
    held = count > 0
    return held, total[held] / count[held, None]


def lies_before(mesh: TriangleMesh, rims: list[OccludingContour], reach_mm: float) -> BoolArray:
    """Find the vertices near a place where the mesh touches a contour, on the visible side.

    Parameters
    ----------
    mesh : mm, reference frame
    rims
        The contours of all views.
    reach_mm
        Largest distance from such a place.

    Returns
    -------
    (n,) bool
    """
    normals = smoothed_normals(mesh, 1)
    proved = np.zeros(len(mesh.vertices), dtype=bool)
    for proved_by in for_views(lambda rim: _lies_before(mesh, rim, normals, reach_mm), rims):
        proved |= proved_by
    return proved


def _lies_before(
    mesh: TriangleMesh, rim: OccludingContour, normals: FloatArray, reach_mm: float
) -> BoolArray:
    beyond = rim.against(mesh.vertices)
    touching = _touching(beyond, normals, _TOUCHING_MM, _TOUCHING_FACING)
    if len(touching) == 0:
        return np.zeros(len(normals), dtype=bool)
    touched = point_tree(mesh.vertices[beyond.vertex[touching]])
    away, _ = touched.query(mesh.vertices, distance_upper_bound=reach_mm)
    sight = rim.eye_mm - mesh.vertices
    towards = np.einsum("nc,nc->n", normals, sight) / np.linalg.norm(sight, axis=1)
    return np.asarray(np.isfinite(away) & (towards > _LEAST_TOWARDS))


def touches_of(mesh: TriangleMesh, rims: list[OccludingContour]) -> ContourConstraints:
    """Find the rays that touch a mesh and the points where they do.

    Parameters
    ----------
    mesh : mm, reference frame
    rims
        The contours of all views.

    Returns
    -------
    ContourConstraints
        Points (k, 3), mm, and outward unit vectors (k, 3), reference frame.
    """
    normals = smoothed_normals(mesh, 2)
    points, outwards = [np.zeros((0, 3))], [np.zeros((0, 3))]
    for beyond in for_views(lambda rim: rim.against(mesh.vertices), rims):
        touching = _touching(beyond, normals, _TOUCHED_MM, _TOUCHED_FACING)
        points.append(beyond.on_ray(touching, mesh.vertices))
        outwards.append(beyond.outward[touching])
    return ContourConstraints(np.concatenate(points), np.concatenate(outwards))


def _touching(beyond: Beyond, normals: FloatArray, within_mm: float, facing: float) -> IntArray:
    outermost = beyond.outermost
    near = np.abs(beyond.beyond_mm[outermost]) < within_mm
    return np.asarray(outermost[near & (beyond.facing(normals)[outermost] > facing)])
