"""A foot of simple shape that carries measures: lengths, widths and what the sole tells."""

from __future__ import annotations

import numpy as np
import trimesh

from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side


def round_foot(side: Side, cut_mm: float = 0.0) -> Foot:
    """The sole of a foot without separate toes, 80 × 250 mm and round; its front may be cut off."""
    ball = trimesh.creation.icosphere(subdivisions=5)
    vertices = ball.vertices * [40.0, 125.0, 40.0] + [0.0, 125.0, 40.0]
    mesh = TriangleMesh(vertices, ball.faces.astype(np.int32))
    _, y, z = vertices.T
    part = mesh.part((z < 42) & (y < 250 - cut_mm))
    if side is Side.RIGHT:  # the exact mirror image
        part = part.moved(part.vertices * [-1.0, 1.0, 1.0]).flipped()
    return Foot(side, part, np.eye(4), 250.0)
