"""The same prescription for the other foot, or with its places moved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from insole_core.insole.elements.correction import reflected, with_places
from insole_core.insole.fields import Place
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


def moved(design: InsoleDesign, move: Callable[[Place], Place]) -> InsoleDesign:
    """Move all places of a design on the foot: of corrections, outline and trim line.

    Parameters
    ----------
    move
        Maps a place (x, y) in mm to another.
    """
    return replace(
        design,
        corrections=tuple(with_places(correction, move) for correction in design.corrections),
        outline=with_places(design.outline, move),
        shell=None if design.shell is None else with_places(design.shell, move),
    )
