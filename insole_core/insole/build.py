"""Build the surface of an insole from a foot and a design.

The functions are pure, so that a design can be replayed on another scan.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import BoolArray
from insole_core.insole.finishing.finished import FinishedSurface
from insole_core.insole.outline.shoe_outline import last_heights_mm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_limits import check_design
from insole_core.insole.prescription.design_totals import check_totals
from insole_core.insole.primitives.height_field import HeightField
from insole_core.insole.surface.contact import ContactBase, contact_base
from insole_core.insole.surface.pads_on_surface import apply_pads
from insole_core.progress import SILENT, Progress

__all__ = [
    "GREATEST_HEIGHT_MM",
    "LEAST_MATERIAL_MM",
    "BaseStep",
    "Insole",
    "apply_pads",
    "build_insole",
    "check_design_for",
    "material_problem",
]

LEAST_MATERIAL_MM = 0.3
"""Least height of the contact surface over the bottom plane that can be manufactured."""
GREATEST_HEIGHT_MM = 200.0
"""Greatest one: every single correction stays below it, only very many together do not."""


@dataclass(frozen=True, eq=False)
class Insole:
    """An insole design realised on one foot.

    Parameters
    ----------
    contact
        The surface that touches the foot; insole frame, z = 0 is the bottom plane.
    measured : (ny, nx) bool
        Nodes of `contact` where the foot was measured.
    finished
        How the surface below the pads was finished; None of a design without a finish.
    """

    design: InsoleDesign
    foot: Foot
    contact: HeightField
    measured: BoolArray
    finished: FinishedSurface | None = None


class BaseStep(Protocol):
    """A function that computes the contact surface before pads: `contact_base` or a cached one."""

    def __call__(  # noqa: D102
        self, foot: Foot, design: InsoleDesign, progress: Progress
    ) -> ContactBase: ...


def build_insole(
    foot: Foot,
    design: InsoleDesign,
    progress: Progress = SILENT,
    *,
    base_of: BaseStep = contact_base,
) -> Insole:
    """Build the insole of a foot from its design: base, pads, check.

    Parameters
    ----------
    base_of
        Computes the contact surface before pads.

    Returns
    -------
    Insole
        Its contact surface is in the insole frame, mm.

    Raises
    ------
    DesignError
        If the design is for the other side, holds a value out of range, or cannot be built on
        this foot.
    """
    check_design_for(foot, design)
    base = base_of(foot, design, progress.part(0.0, 0.9))
    progress.step(0.9, "Adding pads")
    insole = Insole(design, foot, apply_pads(base, design), base.measured, base.finished)
    problem = material_problem(insole.contact, design, foot.length_mm)
    if problem is not None:
        raise problem
    progress.step(1.0, "Insole built")
    return insole


def check_design_for(foot: Foot, design: InsoleDesign) -> None:
    """Check that a design is for the side of this foot and that its values are in range.

    Raises
    ------
    DesignError
        If the sides differ, or naming the value or the total that is out of range.
    """
    if design.side is not foot.side:
        raise DesignError(
            "This design is for a {side} foot and the scan is of a {foot_side} one; open the "
            "matching scan or mirror the design.",
            side=design.side,
            foot_side=foot.side,
        )
    check_design(design)
    check_totals(design)


def material_problem(
    contact: HeightField, design: InsoleDesign, length_mm: float
) -> DesignError | None:
    """Return an error saying where the insole is too thin or too high to be made, or None.

    It is fast enough to be called at every step of a drag.

    Parameters
    ----------
    contact
        The surface with its pads.
    length_mm
        Of the foot.
    """
    highest = float(contact.heights_mm.max())
    if highest > GREATEST_HEIGHT_MM:
        return DesignError(
            "The insole would be {height_mm:.0f} mm high, and {most_mm:g} mm can be made; lower "
            "the corrections that lie on each other.",
            height_mm=highest,
            most_mm=GREATEST_HEIGHT_MM,
        )
    material = contact.heights_mm - last_heights_mm(design, contact.y_mm, length_mm)[:, None]
    row, column = np.unravel_index(material.argmin(), material.shape)
    lowest = round(float(material[row, column]) - design.taken_off_mm, 1)  # as it is printed
    if lowest >= LEAST_MATERIAL_MM:
        return None
    return DesignError(
        "The insole would be only {thickness_mm:.1f} mm thick at x = {x_mm:.0f} mm, y = {y_mm:.0f} "
        "mm; raise the thickness or make the recess shallower.",
        thickness_mm=lowest,
        x_mm=contact.x_mm[column],
        y_mm=contact.y_mm[row],
    )
