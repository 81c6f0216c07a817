"""What the corrections of a design may add up to: each may be in range, and all together not."""

from __future__ import annotations

import numpy as np

from insole_core.errors import DesignError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.fields import Range
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.lifts import lift_profile_mm
from insole_core.insole.prescription.posting_angles import posting_profile_deg

POSTING_TOTAL = Range(-15, 15, "degrees")
LIFT_TOTAL = Range(-10, 20)
MOST_CORRECTIONS = 200
_STEP = 0.1  # mm and degrees to which totals are rounded, before they are compared and printed
_SHARES = np.linspace(0.0, 1.0, 41)


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
    angle_deg = _farthest(posting_profile_deg(design, _SHARES))
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
