"""By how much postings, twists and posts turn each cross section of the foot, thesis 6.3.1."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.elements import Correction, ForefootTwist, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.blending import smooth_step


def posting_angles(design: InsoleDesign) -> tuple[float, float]:
    """Sum the rear- and forefoot angles of postings and posts, in degrees; > 0 is medial."""
    postings = [c for c in _turning(design) if isinstance(c, Posting)]
    return sum(c.rearfoot_deg for c in postings), sum(c.forefoot_deg for c in postings)


def posting_profile_deg(design: InsoleDesign, share: FloatArray) -> FloatArray:
    """Sum the angles of active postings, twists and posts at shares (n,) of the length."""
    return angles_deg(design, share, "extrinsic") + angles_deg(design, share, "intrinsic")


def angles_deg(design: InsoleDesign, share: FloatArray, method: str) -> FloatArray:
    """Sum the angles of one method in each section, (ny,); a twist is extrinsic."""
    angle = np.zeros_like(share)
    for c in _turning(design):
        if isinstance(c, Posting) and c.method == method:
            angle += angle_deg(c, share)
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


def angle_deg(posting: Posting, share: FloatArray) -> FloatArray:
    """Return the angle of one posting in each section, (ny,)."""
    forefoot = smooth_step(share, posting.blend_start, posting.blend_end)
    return posting.rearfoot_deg + (posting.forefoot_deg - posting.rearfoot_deg) * forefoot
