"""Small sheets that look along +z, as the table sensors do."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.transforms import rigid, transform
from insole_core.reconstruct.views.range_mesh import RangeMesh, longest_edges, triangulate
from insole_core.sensing.pinhole_camera import PinholeCamera

CAMERA = PinholeCamera(64, 48, 60.0, 60.0, 31.5, 23.5)


def sheet_of(depth_mm: FloatArray, position_mm: tuple[float, float, float]) -> RangeMesh:
    """A sheet of the camera at a place, turned by half a turn about z."""
    sensor2reference = rigid(np.diag([-1.0, -1.0, 1.0]), np.array(position_mm))
    rays = CAMERA.pixel_rays()
    points = np.concatenate([rays, np.ones((*rays.shape[:2], 1))], axis=2) * depth_mm[..., None]
    placed = transform(sensor2reference, points)
    inside: BoolArray = np.isfinite(depth_mm)
    triangles = triangulate(placed, inside, longest_edges(depth_mm, CAMERA.fx))
    colors = np.full((*depth_mm.shape, 3), 100, dtype=np.uint8)
    return RangeMesh(placed, triangles, colors, sensor2reference, CAMERA)


def flat(depth_mm: float) -> FloatArray:
    return np.full((CAMERA.height, CAMERA.width), depth_mm)
