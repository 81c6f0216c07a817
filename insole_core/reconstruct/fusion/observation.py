"""The readings of a view as linear equations for the displacements of a mesh's vertices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.reconstruct.fusion.depth_view import DepthView

_NOISE_RAW = 0.21
"""Standard deviation of a mean, corrected reading on a surface that faces the sensor."""
_SPOT_OFFSET_PX = 0.6
"""Distance of the dots in a window from its centre (0.7 to 1 px), less the part predicted."""
SHARED_PX = 20
"""Number of neighbouring readings that share their error: the sensor compares 9 x 9 pixels."""
_LEAST_COSINE = 0.2
_OUTLIER_RAW = 8.0


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
    terms : (k, 3) float64
        Derivative of each reading by the view's offset and tilts.
    """

    design: scipy.sparse.csr_array[np.float64]
    residuals: FloatArray
    information: FloatArray
    terms: FloatArray


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
    rays = reading.rays.reshape(-1, 3)
    hits = caster.cast(reading.origin_mm, rays)
    rays, corners = rays[hits.ray], mesh.triangles[hits.triangle]
    normal = np.einsum("nk,nkc->nc", hits.weights, normals[corners])
    depth_mm = reading.depth_along(np.einsum("nk,nkc->nc", hits.weights, mesh.vertices[corners]))
    along = np.einsum("nc,nc->n", normal, rays)
    cosine = -along / (np.linalg.norm(normal, axis=1) * np.linalg.norm(rays, axis=1))
    residuals = reading.raw.ravel()[hits.ray] - reading.sensor.disparity.raw(depth_mm)
    good = np.flatnonzero((cosine > _LEAST_COSINE) & (np.abs(residuals) < _OUTLIER_RAW))
    slope = reading.raw_per_mm(depth_mm[good])
    weights = hits.weights[good] * (slope / along[good])[:, None]
    count = len(good)
    design = scipy.sparse.csr_array(
        (weights.ravel(), corners[good].ravel(), np.arange(0, 3 * count + 1, 3)),
        (count, len(mesh.vertices)),
    )
    pixel_mm = depth_mm[good] / reading.sensor.depth_camera.fx
    tangent = np.sqrt(1 / np.clip(cosine[good], 0.05, 1) ** 2 - 1)
    variance = _NOISE_RAW**2 + (_SPOT_OFFSET_PX * slope * pixel_mm * tangent) ** 2
    view_terms = _view_terms(reading, reading.pixels.reshape(-1, 2)[hits.ray[good]])
    return Observations(design, residuals[good], 1 / (SHARED_PX * variance), view_terms)


def _view_terms(reading: DepthView, pixels: FloatArray) -> FloatArray:
    """Return the terms (k, 3) of offset and tilts: 1, and the pixel's position in 100 px."""
    camera = reading.sensor.depth_camera
    place = (pixels - [camera.width / 2, camera.height / 2]) / 100
    return np.column_stack([np.ones(len(place)), place])
