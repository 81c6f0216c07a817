"""By how much postings, twists and posts turn each cross section of the foot, thesis 6.3.1."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.elements import Posting
from insole_core.insole.prescription.design import InsoleDesign


def posting_angles(design: InsoleDesign) -> tuple[float, float]:
    """Sum the rear- and forefoot angles of postings and posts, in degrees; > 0 is medial."""
    postings = (*design.of(Posting), *_posts(design))
    return sum(c.rearfoot_deg for c in postings), sum(c.forefoot_deg for c in postings)


def posting_profile_deg(design: InsoleDesign, share: FloatArray) -> FloatArray:
    """Sum the angles of active postings, twists and posts at shares (n,) of the length."""
    return angles_deg(design, share, rim=True) + angles_deg(design, share, rim=False)


def angles_deg(design: InsoleDesign, share: FloatArray, *, rim: bool) -> FloatArray:
    """Sum the angles of those that turn the rim, or not, at shares (n,) of the length."""
    turning = (*design.of_stage("turn"), *_posts(design))
    angles = (c.turned_deg(share) for c in turning if c.turns_rim is rim)
    return np.asarray(sum(angles, start=np.zeros_like(share)))


def _posts(design: InsoleDesign) -> tuple[Posting, ...]:
    """Return the posting that the posts below a shell amount to, if they turn anything."""
    posts = () if design.shell is None else design.shell.posts
    rearfoot, forefoot = (
        sum(post.angle_deg for post in posts if post.region == region)
        for region in ("rearfoot", "forefoot")
    )
    if rearfoot == forefoot == 0:
        return ()
    return (Posting(id="posts", rearfoot_deg=rearfoot, forefoot_deg=forefoot),)
