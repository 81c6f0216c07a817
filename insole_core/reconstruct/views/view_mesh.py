"""A coarse surface of a single view, for display."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import transform
from insole_core.reconstruct.views.measured_view import MeasuredView
from insole_core.reconstruct.views.range_mesh import RangeMesh, join, longest_edges, triangulate
from insole_core.reconstruct.volume import is_inside
from insole_core.recording.box import Box

_STEP = 2


def view_mesh(
    measured: MeasuredView, sensor2reference: FloatArray, box: Box, rgb: tuple[int, int, int]
) -> TriangleMesh:
    """Mesh every second reading of a view inside a volume, in one colour.

    Parameters
    ----------
    measured
    sensor2reference : (4, 4) float64, mm
        Pose of the depth camera.
    box
        The volume of interest, reference frame.
    rgb
        Colour of every vertex.

    Returns
    -------
    TriangleMesh, mm, reference frame
    """
    camera = measured.view.sensor.depth_camera
    points = measured.points[::_STEP, ::_STEP]
    placed = transform(sensor2reference, points)
    edges = _STEP * longest_edges(points[..., 2], camera.fx)
    triangles = triangulate(placed, is_inside(placed, box), edges)
    colors = np.broadcast_to(np.array(rgb, dtype=np.uint8), placed.shape)
    return join([RangeMesh(placed, triangles, colors, sensor2reference, camera)])
