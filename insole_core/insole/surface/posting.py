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
from insole_core.insole.prescription.design import (
    Correction,
    ForefootTwist,
    InsoleDesign,
    Posting,
)
from insole_core.insole.surface.blending import smooth_step
from insole_core.insole.surface.height_field import HeightField

_RIM_START = 0.7
"""Intrinsic posting fades from this share of a section's half width to its border."""


def posting_angles(design: InsoleDesign) -> tuple[float, float]:
    """Sum the rear- and forefoot angles of postings and posts, in degrees; > 0 is medial."""
    postings = [c for c in _turning(design) if isinstance(c, Posting)]
    return sum(c.rearfoot_deg for c in postings), sum(c.forefoot_deg for c in postings)


def posting_profile_deg(design: InsoleDesign, share: FloatArray) -> FloatArray:
    """Sum the angles of active postings, twists and posts at shares (n,) of the length."""
    return _angles_deg(design, share, "extrinsic") + _angles_deg(design, share, "intrinsic")


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
    angle = foot.side.medial_sign * np.radians(_angle_deg(zone, y / foot.length_mm))
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
    whole = _angles_deg(design, share, "extrinsic")
    if whole.any():
        turned = _turned(field, design.side.medial_sign * np.radians(whole))
    inner = _angles_deg(design, share, "intrinsic")
    if inner.any():
        turned = turned + _inner_tilt(field, measured, design.side, inner)
    return turned


def _angles_deg(design: InsoleDesign, share: FloatArray, method: str) -> FloatArray:
    """Sum the angles in each section, (ny,)."""
    angle = np.zeros_like(share)
    for c in _turning(design):
        if isinstance(c, Posting) and c.method == method:
            angle += _angle_deg(c, share)
        elif isinstance(c, ForefootTwist) and method == "extrinsic":
            angle += c.angle_deg * smooth_step(share, c.blend_start, c.blend_end)
    return angle


def _turning(design: InsoleDesign) -> list[Correction]:
    """Return the active corrections, and the posting that the posts below a shell amount to."""
    posts = () if design.shell is None else design.shell.posts
    rearfoot, forefoot = (
        sum(post.angle_deg for post in posts if post.region == region)
        for region in ("rearfoot", "forefoot")
    )
    if rearfoot == forefoot == 0:
        return [*design.active]
    return [*design.active, Posting(id="posts", rearfoot_deg=rearfoot, forefoot_deg=forefoot)]


def _angle_deg(posting: Posting, share: FloatArray) -> FloatArray:
    forefoot = smooth_step(share, posting.blend_start, posting.blend_end)
    return posting.rearfoot_deg + (posting.forefoot_deg - posting.rearfoot_deg) * forefoot


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
