"""The readings of a view as equations for a mesh's vertices, and its motion between two views."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.reconstruct.fusion.depth_view import DepthView

_LEAST_COSINE = 0.2
_OUTLIER_RAW = 8.0
_LEAST_COSINE_OF_BOTH = 0.5
"""On steeper parts the sensor's window shifts the surface, oppositely in the two views."""
_LEAST_COMMON = 500
_ROUNDS_MM = (6.0, 4.0, 3.0, 2.0, 1.5, 1.5, 1.5)
"""Scales of the robust weights; at first nearly all vertices count, in case the foot moved."""
_SHARED_VERTICES = 36
"""Number of vertices, 2 mm apart, that lie in one window of the sensor and share its error."""
_PRIOR = 1e-3
"""Weight of the prior that nothing has moved, per vertex."""
_WINDOW_MM = 0.5
"""Least error of the sensor's windows, however well the two surfaces agree."""
_LARGEST_STD_MM = 0.7


@dataclass(frozen=True, eq=False)
class Observations:
    """Readings of one view on the mesh, as linear equations for the vertices' displacements.

    Parameters
    ----------
    design : (k, n) sparse, raw units per mm
        Derivative of each reading by the displacement of each vertex along its normal.
    residuals : (k,) float64, raw units
        Reading minus the value predicted by the mesh.
    information : (k,) float64
        Inverse variance of the readings, reduced for the error that neighbours share.
    shared : (k,) float64
        Number of neighbouring readings that share their error.
    terms : (k, 3) float64
        Derivative of each reading by the view's offset and tilts.
    """

    design: scipy.sparse.csr_array[np.float64]
    residuals: FloatArray
    information: FloatArray
    shared: FloatArray
    terms: FloatArray

    def shifted(self, by_raw: float) -> Observations:
        """Return them with readings that are larger by a number of raw units."""
        return replace(self, residuals=self.residuals + by_raw)


def observe(
    reading: DepthView, mesh: TriangleMesh, normals: FloatArray, caster: RayCaster
) -> Observations:
    """Compare the readings of a view with a mesh, ray by ray.

    Parameters
    ----------
    reading
    mesh : mm, reference frame
    normals : (n, 3) float64
        Directions in which the vertices may move.
    caster
        Of the same mesh.

    Returns
    -------
    Observations
        Without readings at grazing angles and outliers.
    """
    hits = hits_of(reading, mesh, normals, caster)
    residuals = reading.raw.ravel()[hits.ray] - reading.sensor.disparity.raw(hits.depth_mm)
    good = np.flatnonzero((hits.cosine > _LEAST_COSINE) & (np.abs(residuals) < _OUTLIER_RAW))
    depth_mm = hits.depth_mm[good]
    pixel_mm = depth_mm / reading.sensor.depth_camera.fx
    tangent = np.sqrt(1 / np.clip(hits.cosine[good], 0.05, 1) ** 2 - 1)
    slope = reading.raw_per_mm(depth_mm)
    family = reading.sensor.family
    variance = family.noise_raw**2 + (family.spot_offset_px * slope * pixel_mm * tangent) ** 2
    return hits.equations(
        reading,
        mesh,
        good,
        residuals=residuals[good],
        variance=variance,
        shared_px=family.shared_px,
    )


@dataclass(frozen=True, eq=False)
class MeshHits:
    """Where the rays of a view meet a mesh.

    Parameters
    ----------
    ray : (k,) int64
        Index of the pixel, row by row.
    corners : (k, 3) int32
        Vertices of the triangle that is hit.
    weights : (k, 3) float64
        Barycentric.
    depth_mm : (k,) float64
    along : (k,) float64
        Component of the vertices' direction along the ray, whose depth component is 1.
    cosine : (k,) float64
        Of the angle between the two.
    """

    ray: IntArray
    corners: IndexArray
    weights: FloatArray
    depth_mm: FloatArray
    along: FloatArray
    cosine: FloatArray

    def equations(
        self,
        reading: DepthView,
        mesh: TriangleMesh,
        chosen: IntArray,
        *,
        residuals: FloatArray,
        variance: FloatArray,
        shared_px: int,
    ) -> Observations:
        """Make the equations of some hits.

        Parameters
        ----------
        reading, mesh
            Those that met.
        chosen : (k,) int64
            Which hits.
        residuals, variance : (k,) float64, raw units
            Of a single reading.
        shared_px
            Number of neighbouring readings that share their error.

        Returns
        -------
        Observations
        """
        slope = reading.raw_per_mm(self.depth_mm[chosen])
        weights: FloatArray = self.weights[chosen] * (slope / self.along[chosen])[:, None]
        count = len(chosen)
        design = scipy.sparse.csr_array(
            (weights.ravel(), self.corners[chosen].ravel(), np.arange(0, 3 * count + 1, 3)),
            (count, len(mesh.vertices)),
        )
        pixels = reading.pixels.reshape(-1, 2)[self.ray[chosen]]
        shared = np.full(count, float(shared_px))
        terms = _view_terms(reading, pixels)
        return Observations(design, residuals, 1 / (shared * variance), shared, terms)


def hits_of(
    reading: DepthView, mesh: TriangleMesh, normals: FloatArray, caster: RayCaster
) -> MeshHits:
    """Cast the rays of a view's pixels onto a mesh; parameters as of `observe`."""
    rays = reading.rays.reshape(-1, 3)
    hits = caster.cast(reading.origin_mm, rays)
    rays, corners = rays[hits.ray], mesh.triangles[hits.triangle]
    normal = np.einsum("nk,nkc->nc", hits.weights, normals[corners])
    depth_mm = reading.depth_along(np.einsum("nk,nkc->nc", hits.weights, mesh.vertices[corners]))
    along = np.einsum("nc,nc->n", normal, rays)
    cosine = -along / (np.linalg.norm(normal, axis=1) * np.linalg.norm(rays, axis=1))
    return MeshHits(hits.ray, corners, hits.weights, depth_mm, along, cosine)


def _view_terms(reading: DepthView, pixels: FloatArray) -> FloatArray:
    """Return the terms (k, 3) of offset and tilts: 1, and the pixel's position in 100 px."""
    camera = reading.sensor.depth_camera
    place = (pixels - [camera.width / 2, camera.height / 2]) / 100
    return np.column_stack([np.ones(len(place)), place])


@dataclass(frozen=True, eq=False)
class _Side:
    """One view's height above the vertices, mm, NaN = not measured, and which of them it faces."""

    height_mm: FloatArray
    faced: BoolArray


def view_gaps(
    mesh: TriangleMesh,
    normals: FloatArray,
    displacement: FloatArray,
    readings: list[DepthView],
    seen: list[Observations],
) -> FloatArray:
    """Estimate the shift from each view's surface to each other's on their common part.

    A part that only one view measured carries no information, and would hide a shift across the
    foot.

    Parameters
    ----------
    mesh : mm, reference frame
    normals : (n, 3) float64
    displacement : (n,) float64, mm
        Of the vertices along their normals to the fused surface.
    readings, seen
        Readings and observations of every view, corrected for the sensor's matching error.

    Returns
    -------
    (views, views, 3) float64, mm, reference frame
        From the first view to the second; 0 along directions that their common part does not
        determine, NaN where it is too small.
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
    residuals = np.asarray(part.residuals - part.design @ displacement)
    response: FloatArray = np.asarray(part.design.sum(axis=1)).ravel()
    rhs = np.asarray(part.design.T @ (part.information * residuals))
    total = np.asarray(part.design.T @ (part.information * response))
    known = total != 0
    height_mm = np.divide(rhs, total, out=np.full(len(total), np.nan), where=known)
    cosine = np.einsum("nc,nc->n", normals, towards) / np.linalg.norm(towards, axis=1)
    return _Side(height_mm, np.asarray(known & (cosine > _LEAST_COSINE_OF_BOTH)))


def _gap_mm(first: _Side, second: _Side, normals: FloatArray) -> FloatArray:
    """Estimate the shift (3,) by robust least squares along the normals (Geman & McClure)."""
    common = first.faced & second.faced
    if common.sum() < _LEAST_COMMON:
        return np.full(3, np.nan)
    normal, height_mm = normals[common], (second.height_mm - first.height_mm)[common]
    shift: FloatArray = np.zeros(3)
    for scale_mm in _ROUNDS_MM:
        weights = 1 / (1 + ((height_mm - normal @ shift) / scale_mm) ** 2) ** 2
        matrix = normal.T @ (weights[:, None] * normal) + _PRIOR * np.eye(3)
        shift = np.asarray(np.linalg.solve(matrix, normal.T @ (weights * height_mm)))
    rms_mm = np.sqrt(np.average((height_mm - normal @ shift) ** 2, weights=weights))
    strength, axes = np.linalg.eigh(matrix)
    std_mm = max(float(rms_mm), _WINDOW_MM) * np.sqrt(_SHARED_VERTICES / strength)
    determined = std_mm < _LARGEST_STD_MM
    return np.asarray(axes @ (determined * (axes.T @ shift)))
