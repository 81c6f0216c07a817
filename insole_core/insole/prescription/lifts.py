"""By how much the corrections of a design lift the foot together."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.prescription.design import InsoleDesign


def lift_profile_mm(design: InsoleDesign, share: FloatArray) -> FloatArray:
    """Return the lift of the sections at shares (n,) of the foot's length."""
    lifts = (correction.raised_mm(share) for correction in design.of_stage("sole"))
    return np.asarray(sum(lifts, start=np.zeros_like(share)))


def heel_lift_mm(design: InsoleDesign) -> float:
    """Return the lift of the heel."""
    return float(lift_profile_mm(design, np.zeros(1))[0])
