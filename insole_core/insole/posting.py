"""Pronation/supination as a rotation of the foot against the insole's bottom, thesis 6.3.1."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.blending import smooth_step
from insole_core.insole.design import InsoleDesign, Posting

HEEL_END = 0.25
"""Share of the foot's length up to which the rearfoot angle holds."""
BALL_START = 0.65
"""Share of the foot's length from which the forefoot angle holds."""


def posting_angles(design: InsoleDesign) -> tuple[float, float]:
    """Rear- and forefoot angle in degrees, summed over the postings that are switched on."""
    active = [c for c in design.corrections if isinstance(c, Posting) and c.enabled]
    return sum(c.rearfoot_deg for c in active), sum(c.forefoot_deg for c in active)


def posted_mesh(foot: Foot, rearfoot_deg: float, forefoot_deg: float) -> TriangleMesh:
    """Rotate the foot about its axis on the ground (x = 0, z = 0); > 0 raises the medial edge.

    Equal angles give a rigid rotation; otherwise the angle changes along y from HEEL_END to
    BALL_START with continuous slope. The height over the ground is for the caller to choose.
    """
    if rearfoot_deg == forefoot_deg == 0:
        return foot.mesh
    x, y, z = foot.mesh.vertices.T
    angle = foot.side.medial_sign * np.radians(
        rearfoot_deg
        + (forefoot_deg - rearfoot_deg) * smooth_step(y / foot.length_mm, HEEL_END, BALL_START)
    )
    cos, sin = np.cos(angle), np.sin(angle)
    return replace(foot.mesh, vertices=np.stack([x * cos - z * sin, y, z * cos + x * sin], axis=1))
