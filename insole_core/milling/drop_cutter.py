"""How low the tip of a cutter may go on the lines of a raster, without touching the solids."""

from __future__ import annotations

import cv2
import numpy as np

from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.height_map import disc
from insole_core.geometry.mesh import TriangleMesh
from insole_core.milling.machine import Cutter
from insole_core.milling.surface import Surface, raise_to_triangles

STEEPEST = np.tan(np.radians(75.0))
"""Of a path: beside a rim the cutter does not fall along the wall, which the contour cuts."""

_BENT_MM = 0.009
"""By which a ball sinks into edges between their samples."""
_OFF_MM = 0.012
"""By which the path stays off what it touches, which it is known to no better."""
_LONGEST_NORMAL = 1.015
"""To which the normals at the corners of a triangle are stretched, so that it does not sink in."""


def tip_heights(
    surface: Surface,
    cutter: Cutter,
    lines: IntArray,
    allowance_mm: float = 0.0,
    every: int = 1,
) -> FloatArray:
    """Compute the lowest tip of a cutter that keeps an allowance from the surface.

    It is the dilation of the surface by the cutter, enlarged by the allowance.

    Parameters
    ----------
    lines : (k,) int64
        Indices of the grid's lines along which the cutter goes.
    every
        Of the nodes round the cutter's axis, along x and y, that are looked at.

    Returns
    -------
    (k, ny) float64, mm
        Above the bottom of the block, at the nodes of each line.
    """
    radius = cutter.radius_mm + allowance_mm
    if cutter.shape == "flat":
        return _under_disc(surface, radius)[lines] + allowance_mm
    reach = int(radius / surface.step_mm / every) * every
    ring = np.pad(surface.heights_mm, reach, constant_values=np.float32(surface.floor_mm))
    ny = surface.inside.shape[1]
    tips = np.full((len(lines), ny), -np.inf, np.float32)
    level = np.empty_like(tips)
    for i in range(-reach, reach + 1, every):
        row = ring[lines + i + reach]
        for j in range(0, reach + 1, every):
            distance2 = (i * i + j * j) * surface.step_mm**2
            if distance2 > radius**2:
                break
            np.maximum(
                row[:, reach + j : reach + j + ny], row[:, reach - j : reach - j + ny], out=level
            )
            level += np.float32(np.sqrt(radius**2 - distance2) - cutter.radius_mm)
            np.maximum(tips, level, out=tips)
    return np.asarray(tips, float)


def _under_disc(surface: Surface, radius_mm: float) -> FloatArray:
    """Return the greatest height (nx, ny) of the surface within a radius of each node."""
    floor = float(surface.floor_mm)
    kernel = disc(radius_mm, surface.step_mm)
    return np.asarray(
        cv2.dilate(
            surface.heights_mm, kernel, borderType=cv2.BORDER_CONSTANT, borderValue=(floor,)
        ),
        float,
    )


def finishing_heights(surface: Surface, cutter: Cutter) -> FloatArray:
    """Compute the tips (nx, ny), mm, of a ball-nose cutter that leaves the surface.

    Triangles, sharp edges and their ends are touched by themselves, so that nothing rises between
    the nodes of the grid. Between its nodes the path does not cut off the arcs that the ball
    describes round an edge.
    """
    every_line = np.arange(len(surface.x_mm))
    tips = tip_heights(surface, cutter, every_line, every=2)
    for solid in surface.solids:
        _touch_faces(solid, surface, cutter, tips)
    _touch_edges(surface, cutter, tips)
    _touch_peaks(surface, cutter, tips)
    slope = STEEPEST * surface.step_mm * np.arange(tips.shape[1])
    falling = np.maximum.accumulate(tips + slope, axis=1) - slope
    rising = np.maximum.accumulate((tips - slope)[:, ::-1], axis=1)[:, ::-1] + slope
    return _over_arcs(np.maximum(falling, rising)) + _OFF_MM


def _touch_faces(solid: TriangleMesh, surface: Surface, cutter: Cutter, tips: FloatArray) -> None:
    """Raise tips (nx, ny) to where the ball touches the triangles of a solid.

    Its centre lies on the triangles moved by the radius along their normals; along the normals at
    the corners, there is no gap between them, and the ball sinks into an edge by no more than it
    is bent.
    """
    upward = solid.triangle_normals[:, 2] > 0
    triangles = solid.triangles[upward]
    corners = solid.vertices[triangles] - [0, 0, cutter.radius_mm]
    bent = solid.vertex_normals[triangles]
    # Between corners with other normals the mean normal is shorter, and the ball would sink in.
    shorter = np.linalg.norm(bent.mean(axis=1), axis=1)
    bent = bent * np.minimum(1.003 / np.maximum(shorter, 0.5), _LONGEST_NORMAL)[:, None, None]
    for normals in (solid.triangle_normals[upward][:, None], bent):
        moved = corners + cutter.radius_mm * normals
        raise_to_triangles(moved, surface.first_mm, surface.step_mm, tips)


def _touch_edges(surface: Surface, cutter: Cutter, tips: FloatArray) -> None:
    """Raise tips (nx, ny) where the ball would cut into the edges.

    On an edge the ball's centre turns from the normal of one side to that of the other; only the
    nodes round this arc are touched.
    """
    radius, step = cutter.radius_mm + _BENT_MM, surface.step_mm
    first, second = np.moveaxis(surface.edge_normals, 1, 0)
    across = np.linalg.norm(first[:, :2] - second[:, :2], axis=1)
    counts = np.ceil(1.5 * radius * across / step).astype(int) + 1
    edge = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(len(edge)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = (within / np.maximum(counts - 1, 1)[edge])[:, None]
    normal = first[edge] * (1 - share) + second[edge] * share
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    edge, normal = edge[normal[:, 2] > 0], normal[normal[:, 2] > 0]
    place = (surface.edges_mm[edge, :2] - surface.first_mm) / step
    nearest = np.rint(place + normal[:, :2] * (radius / step)).astype(int)
    within_grid = ((nearest >= 0) & (nearest < tips.shape)).all(axis=1)
    nearest = nearest[within_grid]
    off = (nearest - place[within_grid]) * step
    height = surface.edges_mm[edge[within_grid], 2] - cutter.radius_mm
    border = np.pad(tips, 1)
    flat, ny = border.ravel(), border.shape[1]
    middle = (nearest[:, 0] + 1) * ny + nearest[:, 1] + 1
    for i in (-1, 0, 1):
        across2 = radius**2 - (off[:, 0] + i * step) ** 2
        for j in (-1, 0, 1):
            left2 = across2 - (off[:, 1] + j * step) ** 2
            tip = np.where(left2 >= 0, height + np.sqrt(np.maximum(left2, 0)), -np.inf)
            np.maximum.at(flat, middle + (i * ny + j), tip)
    tips[:] = border[1:-1, 1:-1]


def _touch_peaks(surface: Surface, cutter: Cutter, tips: FloatArray) -> None:
    """Raise tips (nx, ny) where the ball would cut into the ends of edges, from any side."""
    radius, step = cutter.radius_mm + _BENT_MM, surface.step_mm
    place = (surface.peaks_mm[:, :2] - surface.first_mm) / step
    height = surface.peaks_mm[:, 2] - cutter.radius_mm
    reach = int(radius / step) + 1
    nearest = np.rint(place).astype(int) + reach
    off = (nearest - reach - place) * step
    border = np.pad(tips, reach)
    ny = border.shape[1]
    first, flat = nearest[:, 0] * ny + nearest[:, 1], border.ravel()
    inside = ((nearest >= reach) & (nearest < np.array(tips.shape) + reach)).all(axis=1)
    first, off, height = first[inside], off[inside], height[inside]
    for i in range(-reach, reach + 1):
        across2 = radius**2 - (off[:, 0] + i * step) ** 2
        for j in range(-reach, reach + 1):
            left2 = across2 - (off[:, 1] + j * step) ** 2
            near = np.flatnonzero(left2 >= 0)
            if len(near):
                np.maximum.at(flat, first[near] + (i * ny + j), height[near] + np.sqrt(left2[near]))
    tips[:] = border[reach:-reach, reach:-reach]


def _over_arcs(tips: FloatArray) -> FloatArray:
    """Raise a path so that its straight pieces stay above the arcs between its nodes."""
    sag = np.zeros_like(tips)
    sag[:, 1:-1] = np.maximum(2 * tips[:, 1:-1] - tips[:, 2:] - tips[:, :-2], 0) / 8
    raised = sag.copy()
    np.maximum(raised[:, 1:], sag[:, :-1], out=raised[:, 1:])
    np.maximum(raised[:, :-1], sag[:, 1:], out=raised[:, :-1])
    return np.asarray(tips + raised)
