"""Find the large planes of a scanned surface, such as the rim, walls and bottom of a box."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray

_NEIGHBOURS = 12
_HYPOTHESES = 120
_MOST_PLANES = 8
_LEAST_SHARE = 0.03
"""Share of the points that a plane holds at least."""
_THICK_MM = 2.5
_SAME_NORMAL = 0.93  # cosine: the normals of neighbouring points are noisy
_FITS = 3


@dataclass(frozen=True, eq=False)
class Plane:
    """A plane: where ``points @ normal == offset_mm``.

    Parameters
    ----------
    normal : (3,) float64
        Unit normal, of either direction.
    offset_mm
    share
        Of the points that lie on it.
    """

    normal: FloatArray
    offset_mm: float
    share: float

    def heights(self, points: FloatArray) -> FloatArray:
        """Return the signed distances (n,) of points (n, 3), mm."""
        return np.asarray(points @ self.normal - self.offset_mm)


def large_planes(points: FloatArray) -> list[Plane]:
    """Find planes that hold many of the points, the largest first.

    Hypotheses are the tangential planes of some of the points; the best one is fitted to the points
    on it, which are then set aside (sequential RANSAC, Fischler & Bolles 1981).

    Parameters
    ----------
    points : (n, 3) float64, mm
        Evenly spread over a surface.
    """
    normals = _normals(points)
    free = np.ones(len(points), dtype=bool)
    planes: list[Plane] = []
    while len(planes) < _MOST_PLANES and free.any():
        normal, offset = _best_hypothesis(points[free], normals[free])
        for _ in range(_FITS):
            on = _on_plane(points, normals, normal, offset) & free
            if on.sum() < _LEAST_SHARE * len(points):
                return planes
            normal, offset = _fitted(points[on])
        planes.append(Plane(normal, offset, float(on.mean())))
        free &= ~on
    return planes


def _normals(points: FloatArray) -> FloatArray:
    """Return the directions (n, 3) in which the neighbours of each point vary least."""
    near = points[scipy.spatial.cKDTree(points).query(points, _NEIGHBOURS)[1]]
    near = near - near.mean(axis=1, keepdims=True)
    return np.asarray(np.linalg.eigh(np.swapaxes(near, 1, 2) @ near)[1][:, :, 0])


def _best_hypothesis(points: FloatArray, normals: FloatArray) -> tuple[FloatArray, float]:
    """Return the tangential plane on which most of the points lie."""
    tried = np.linspace(0, len(points) - 1, min(_HYPOTHESES, len(points))).astype(np.int64)
    offsets = np.einsum("ij,ij->i", points[tried], normals[tried])
    close = np.abs(points @ normals[tried].T - offsets) < _THICK_MM
    same = np.abs(normals @ normals[tried].T) > _SAME_NORMAL
    best = int((close & same).sum(axis=0).argmax())
    return normals[tried[best]], float(offsets[best])


def _on_plane(
    points: FloatArray, normals: FloatArray, normal: FloatArray, offset: float
) -> BoolArray:
    close = np.abs(points @ normal - offset) < _THICK_MM
    return np.asarray(close & (np.abs(normals @ normal) > _SAME_NORMAL))


def _fitted(points: FloatArray) -> tuple[FloatArray, float]:
    middle = points.mean(axis=0)
    centred = points - middle
    normal = np.linalg.eigh(centred.T @ centred)[1][:, 0]
    return normal, float(middle @ normal)
