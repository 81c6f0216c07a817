"""What the corrections of a design add up to: lifts, turns, and what they may be together."""

from __future__ import annotations

import numpy as np

from insole_core.errors import DesignError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.elements import Posting
from insole_core.insole.fields import Range
from insole_core.insole.prescription.design import InsoleDesign

POSTING_TOTAL = Range(-15, 15, "degrees")
LIFT_TOTAL = Range(-10, 20)
MOST_CORRECTIONS = 200
_STEP = 0.1  # mm and degrees to which totals are rounded, before they are compared and printed
_SHARES = np.linspace(0.0, 1.0, 41)


def lift_profile_mm(design: InsoleDesign, share: FloatArray) -> FloatArray:
    """Return the lift of the sections at shares (n,) of the foot's length."""
    lifts = (correction.raised_mm(share) for correction in design.of_stage("sole"))
    return np.asarray(sum(lifts, start=np.zeros_like(share)))


def heel_lift_mm(design: InsoleDesign) -> float:
    """Return the lift of the heel."""
    return float(lift_profile_mm(design, np.zeros(1))[0])


def posting_angles(design: InsoleDesign) -> tuple[float, float]:
    """Sum the rear- and forefoot angles of postings and posts, in degrees; > 0 is medial."""
    postings = (*design.of(Posting), *_posts(design))
    return sum(c.rearfoot_deg for c in postings), sum(c.forefoot_deg for c in postings)


def _posting_profile_deg(design: InsoleDesign, share: FloatArray) -> FloatArray:
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


def check_totals(design: InsoleDesign) -> None:
    """Check the design as a whole: its number of corrections, total posting and total lift.

    Raises
    ------
    DesignError
        Naming the total, and what is allowed.
    """
    if len(design.corrections) > MOST_CORRECTIONS:
        raise DesignError(
            "The prescription has {count} corrections, and {most} can be made into one insole; "
            "remove some.",
            count=len(design.corrections),
            most=MOST_CORRECTIONS,
        )
    angle_deg = _farthest(_posting_profile_deg(design, _SHARES))
    if angle_deg not in POSTING_TOTAL:
        raise DesignError(
            "The postings and twists turn the foot by {angle_deg:g}° together, and must be "
            "{range}; lower some of them.",
            angle_deg=angle_deg,
            range=str(POSTING_TOTAL),
        )
    lift_mm = _farthest(lift_profile_mm(design, _SHARES))
    if lift_mm not in LIFT_TOTAL:
        raise DesignError(
            "The heel lifts add up to {lift_mm:g} mm, and must be {range}; lower some of them.",
            lift_mm=lift_mm,
            range=str(LIFT_TOTAL),
        )


def _farthest(profile: FloatArray) -> float:
    return rounded(float(profile[np.abs(profile).argmax()]), _STEP)
