"""An underside that rises, as rockers ask for."""

from __future__ import annotations

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.elements.rocker import LEAST_LEFT_MM
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.height_field import HeightField


def rocker_heights_mm(design: InsoleDesign, foot: Foot, field: HeightField) -> FloatArray | None:
    """Return by how much a design asks the underside to rise, (ny, nx), mm; None if not at all."""
    asked = [correction.rise_mm(foot, field) for correction in design.of_stage("body")]
    return np.asarray(np.max(asked, axis=0)) if asked else None


def eased(bottom_mm: FloatArray, top_mm: FloatArray, rise_mm: FloatArray) -> FloatArray:
    """Return an underside raised by a rocker, as far as the thickness allows.

    Parameters
    ----------
    bottom_mm, top_mm, rise_mm : (ny, nx) float64, mm
    """
    highest = np.maximum(top_mm - LEAST_LEFT_MM, bottom_mm)
    return np.minimum(bottom_mm + rise_mm, highest)
