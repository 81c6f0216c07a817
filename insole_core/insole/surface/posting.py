"""Pronation/supination as a rotation of the foot relative to the insole's bottom, thesis 6.3.1.

The foot turns about its axis on the ground (x = 0, z = 0), each cross section by the angle that
postings and twists define there. As every section stays in its plane, the contact surface can be
turned row by row, without the scan.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.elements import Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_totals import angles_deg
from insole_core.insole.primitives.blending import smooth_step
from insole_core.insole.primitives.height_field import HeightField

_RIM_START = 0.7
"""Intrinsic posting fades from this share of a section's half width to its border."""


def posted_mesh(foot: Foot, rearfoot_deg: float, forefoot_deg: float) -> TriangleMesh:
    """Turn the foot's mesh as a posting with the default blend turns its surface, for display.

    Parameters
    ----------
    rearfoot_deg, forefoot_deg
        Angles > 0 raise the medial edge.

    Returns
    -------
    TriangleMesh, mm, insole frame
    """
    x, y, z = foot.mesh.vertices.T
    zone = Posting(rearfoot_deg=rearfoot_deg, forefoot_deg=forefoot_deg)
    angle = foot.side.medial_sign * np.radians(zone.turned_deg(y / foot.length_mm))
    cos, sin = np.cos(angle), np.sin(angle)
    return replace(foot.mesh, vertices=np.stack([x * cos - z * sin, y, z * cos + x * sin], axis=1))


def posted(
    field: HeightField, measured: BoolArray, design: InsoleDesign, length_mm: float
) -> FloatArray:
    """Turn the contact surface by all postings and twists of a design; > 0 raises medially.

    Parameters
    ----------
    field
        Surface of the level foot, heights above the sole's lowest point.
    measured : (ny, nx) bool
        Nodes where the foot was measured.
    length_mm
        Of the foot.

    Returns
    -------
    (ny, nx) float64, mm
        Equal rear- and forefoot angles yield a rigid rotation of the measured surface.
    """
    share = field.y_mm / length_mm
    turned = field.heights_mm
    whole = angles_deg(design, share, rim=True)
    if whole.any():
        turned = _turned(field, design.side.medial_sign * np.radians(whole))
    inner = angles_deg(design, share, rim=False)
    if inner.any():
        turned = turned + _inner_tilt(field, measured, design.side, inner)
    return turned


def _turned(field: HeightField, angle: FloatArray) -> FloatArray:
    """Rotate each row in its plane: its nodes move, and heights are interpolated between them."""
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, z = field.x_mm, field.heights_mm
    # Where a steep flank would fold over, its foremost points win.
    moved = np.maximum.accumulate(x * cos - z * sin, axis=1)
    # All rows in one interpolation: each is shifted to an interval of its own.
    apart = 2 * float(np.abs(moved).max() + np.abs(x).max()) * np.arange(len(z))[:, None]
    lifted = (z * cos + x * sin).ravel()
    within = np.clip(x, moved[:, :1], moved[:, -1:])
    read = np.interp((within + apart).ravel(), (moved + apart).ravel(), lifted)
    beyond = (x - within) * np.tan(angle)[:, None]
    return np.asarray(read.reshape(z.shape) + beyond)


def _inner_tilt(
    field: HeightField, measured: BoolArray, side: Side, angle_deg: FloatArray
) -> FloatArray:
    """Return what the tilt adds to the sole; it vanishes at the borders, so that the rim stays."""
    x = np.where(measured, field.x_mm, np.nan)
    seen = measured.any(axis=1)
    low, high = (np.zeros(len(measured)) for _ in range(2))
    low[seen], high[seen] = np.nanmin(x[seen], axis=1), np.nanmax(x[seen], axis=1)
    middle, half = (low + high)[:, None] / 2, np.maximum(high - low, field.step_mm)[:, None] / 2
    inner = 1 - smooth_step(np.abs(field.x_mm - middle) / half, _RIM_START, 1.0)
    slope = side.medial_sign * np.tan(np.radians(angle_deg))[:, None]
    return np.asarray(slope * (field.x_mm - middle) * inner)
