"""The same prescription for the other foot."""

from __future__ import annotations

from dataclasses import replace

from insole_core.insole.elements.correction import reflected
from insole_core.insole.prescription.design import InsoleDesign


def mirrored(design: InsoleDesign) -> InsoleDesign:
    """Mirror a design in the plane x = 0; medial stays medial, ids stay the same.

    Mirroring twice returns the original, except that turns of 360 degrees are unwound.
    """
    return replace(
        design,
        side=design.side.other,
        corrections=tuple(correction.mirrored() for correction in design.corrections),
        outline=reflected(design.outline),
        shell=None if design.shell is None else reflected(design.shell),
    )
