"""What the readings say about a mesh: how far each vertex would have to move along its normal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.reconstruct.fusion.depth_view import DepthView

_NOISE_RAW = 0.21
"""Standard deviation of a mean, corrected reading on a surface that faces the sensor."""
_SPOT_OFFSET_PX = 0.6
"""How far the spots in a window lie from its centre (0.7 to 1 px), less what is foretold of it."""
SHARED_PX = 20
"""So many neighbouring readings share their error: the sensor compares windows of 9 x 9 pixels."""
_LEAST_COSINE = 0.2
_OUTLIER_RAW = 8.0


@dataclass(frozen=True, eq=False)
class Observations:
    """Readings of one view on the mesh, as linear equations for the vertices' displacements.

    Parameters
    ----------
    design : (k, n) sparse, raw units per mm
        Change of each reading with the displacement of each vertex along its normal.
    residuals : (k,) float64, raw units
        Reading minus what the mesh would give.
    information : (k,) float64
        Inverse variance of the readings, with what they share with their neighbours.
    terms : (k, 3) float64
        Change of each reading with the view's offset and tilts.
    """

    design: sparse.csr_array[np.float64]
    residuals: FloatArray
    information: FloatArray
    terms: FloatArray


def observe(
    reading: DepthView, mesh: TriangleMesh, normals: FloatArray, caster: RayCaster
) -> Observations:
    """Compare a reading with the mesh, ray by ray.

    Parameters
    ----------
    reading
    mesh, caster
        The same surface.
    normals : (n, 3) float64
        Along which the vertices may move.
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
    design = sparse.csr_array(
        (weights.ravel(), corners[good].ravel(), np.arange(0, 3 * count + 1, 3)),
        (count, len(mesh.vertices)),
    )
    pixel_mm = depth_mm[good] / reading.sensor.depth_camera.fx
    tangent = np.sqrt(1 / np.clip(cosine[good], 0.05, 1) ** 2 - 1)
    variance = _NOISE_RAW**2 + (_SPOT_OFFSET_PX * slope * pixel_mm * tangent) ** 2
    view_terms = _view_terms(reading, reading.pixels.reshape(-1, 2)[hits.ray[good]])
    return Observations(design, residuals[good], 1 / (SHARED_PX * variance), view_terms)


def _view_terms(reading: DepthView, pixels: FloatArray) -> FloatArray:
    """Offset and tilt over the view: 1, and the pixel's place across the foot, per 100 px."""
    camera = reading.sensor.depth_camera
    place = (pixels - [camera.width / 2, camera.height / 2]) / 100
    return np.column_stack([np.ones(len(place)), place])
