"""From foot and design to the insole's surface: pure, so that a design can be replayed."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.contact import ContactBase, contact_base
from insole_core.insole.design import InsoleDesign, Pelott
from insole_core.insole.height_field import HeightField
from insole_core.insole.limits import check_design
from insole_core.insole.pads import pad_heights, pad_outline
from insole_core.progress import SILENT, Progress

LEAST_MATERIAL_MM = 0.3
"""A contact surface lower than this over the bottom cannot be made."""


@dataclass(frozen=True, eq=False)
class Insole:
    """A design realised on one foot.

    Parameters
    ----------
    design
    foot
    contact
        The surface that touches the foot; insole frame, z = 0 the bottom plane.
    measured : (ny, nx) bool
        Nodes of `contact` where the foot was measured.
    """

    design: InsoleDesign
    foot: Foot
    contact: HeightField
    measured: BoolArray


def build_insole(foot: Foot, design: InsoleDesign, progress: Progress = SILENT) -> Insole:
    """Derive the insole of a foot from its design.

    Raises
    ------
    DesignError
        When the design is for the other side, holds a value out of range, or cannot be built on
        this foot.
    """
    if design.side is not foot.side:
        raise DesignError(
            f"This design is for a {design.side} foot and the scan is of a {foot.side} one;"
            " open the matching scan or mirror the design."
        )
    check_design(design)
    base = contact_base(foot, design, progress.part(0.0, 0.9))
    progress.step(0.9, "Adding pads")
    insole = Insole(design, foot, apply_pads(base, design), base.measured)
    _check_material(insole.contact)
    progress.step(1.0, "Insole built")
    return insole


def apply_pads(base: ContactBase, design: InsoleDesign) -> HeightField:
    """Add the design's pads to the base: the only work while a pad is dragged.

    Outside the outlines of the pads the surface stays the same to the bit.
    """
    heights = base.surface.heights_mm.copy()
    for pad in active_pads(design):
        _raise(heights, base.surface, pad)
    return replace(base.surface, heights_mm=heights)


def active_pads(design: InsoleDesign) -> list[Pelott]:
    """The pads of a design that are switched on."""
    return [c for c in design.corrections if isinstance(c, Pelott) and c.enabled]


def _raise(heights: FloatArray, field: HeightField, pad: Pelott) -> None:
    outline = pad_outline(pad)
    (left, back), (right, front) = outline.min(axis=0), outline.max(axis=0)
    columns = slice(*np.searchsorted(field.x_mm, [left, right]))
    rows = slice(*np.searchsorted(field.y_mm, [back, front]))
    x, y = np.meshgrid(field.x_mm[columns], field.y_mm[rows])
    heights[rows, columns] += pad_heights(pad, np.stack([x, y], axis=-1))


def _check_material(contact: HeightField) -> None:
    row, column = np.unravel_index(contact.heights_mm.argmin(), contact.heights_mm.shape)
    lowest = contact.heights_mm[row, column]
    if lowest < LEAST_MATERIAL_MM:
        raise DesignError(
            f"The insole would be only {lowest:.1f} mm thick at x = {contact.x_mm[column]:.0f} mm,"
            f" y = {contact.y_mm[row]:.0f} mm; raise the thickness or make the recess shallower."
        )
