"""How far the foot seems to have moved between two views, by what both of them measured."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.observation import Observations

_LEAST_COSINE = 0.5
"""Steeper places are drawn sideways by the sensor's window, in the two views in opposite ways."""
_LEAST_COMMON = 500
_ROUNDS_MM = (6.0, 4.0, 3.0, 2.0, 1.5, 1.5, 1.5)
"""First nearly all places count: a foot that was moved as a whole has no other outliers."""
_SHARED_VERTICES = 36
"""So many vertices, 2 mm apart, lie in one window of the sensor and share its error."""
_PRIOR = 1e-3
"""Share of a vertex that says that nothing has moved."""
_WINDOW_MM = 0.5
"""Error that the sensor's windows have at least, however even the two surfaces look."""
_LARGEST_DEVIATION_MM = 0.7


@dataclass(frozen=True, eq=False)
class _Side:
    """What one view says of the vertices: how far before each its surface lies, mm; NaN = none."""

    height_mm: FloatArray
    faced: BoolArray


def view_gaps(
    mesh: TriangleMesh,
    normals: FloatArray,
    displacement: FloatArray,
    readings: list[DepthView],
    seen: list[Observations],
) -> FloatArray:
    """Find the shift from each view's surface to each other's, by what both measured.

    What only one view measured says nothing of the other, and would hide a shift across the foot.

    Parameters
    ----------
    mesh
    normals : (n, 3) float64
    displacement : (n,) float64, mm
        Of the vertices along the normals, to where the fused surface is.
    readings, seen
        Of every view, with the error of the sensor's window taken out.

    Returns
    -------
    (views, views, 3) float64, mm, reference frame
        From the first view to the second; 0 along what their common part does not tell, NaN where
        it is too small.
    """
    sides = [
        _side(part, displacement, reading.origin_mm - mesh.vertices, normals)
        for reading, part in zip(readings, seen, strict=True)
    ]
    gaps = np.zeros((len(sides), len(sides), 3))
    for i, j in combinations(range(len(sides)), 2):
        gaps[i, j] = _gap_mm(sides[i], sides[j], normals)
        gaps[j, i] = -gaps[i, j]
    return gaps


def _side(
    part: Observations, displacement: FloatArray, towards: FloatArray, normals: FloatArray
) -> _Side:
    left = np.asarray(part.residuals - part.design @ displacement)
    response: FloatArray = np.asarray(part.design.sum(axis=1)).ravel()
    pull = np.asarray(part.design.T @ (part.information * left))
    total = np.asarray(part.design.T @ (part.information * response))
    known = total != 0
    height_mm = np.divide(pull, total, out=np.full(len(total), np.nan), where=known)
    cosine = np.einsum("nc,nc->n", normals, towards) / np.linalg.norm(towards, axis=1)
    return _Side(height_mm, np.asarray(known & (cosine > _LEAST_COSINE)))


def _gap_mm(first: _Side, second: _Side, normals: FloatArray) -> FloatArray:
    """Shift (3,) along the normals, robust least squares (Geman & McClure)."""
    common = first.faced & second.faced
    if common.sum() < _LEAST_COMMON:
        return np.full(3, np.nan)
    normal, height_mm = normals[common], (second.height_mm - first.height_mm)[common]
    shift: FloatArray = np.zeros(3)
    for scale_mm in _ROUNDS_MM:
        weights = 1 / (1 + ((height_mm - normal @ shift) / scale_mm) ** 2) ** 2
        matrix = normal.T @ (weights[:, None] * normal) + _PRIOR * np.eye(3)
        shift = np.asarray(np.linalg.solve(matrix, normal.T @ (weights * height_mm)))
    left_mm = np.sqrt(np.average((height_mm - normal @ shift) ** 2, weights=weights))
    strength, axes = np.linalg.eigh(matrix)
    deviation_mm = max(float(left_mm), _WINDOW_MM) * np.sqrt(_SHARED_VERTICES / strength)
    told = deviation_mm < _LARGEST_DEVIATION_MM
    return np.asarray(axes @ (told * (axes.T @ shift)))
