"""The shoe that a user names: by the file of a last, or by a size."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from insole_core.formats.units import Unit
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.item_name import MOST_CHARACTERS
from insole_core.insole.prescription.outline import Shoe
from insole_core.insole.shoes.last import last_outline
from insole_core.scans.mesh_file import read_mesh


def shoe_of_last(path: Path, side: Side, unit: Unit | None = None, *, either: bool = False) -> Shoe:
    """Read the shoe of a last.

    Parameters
    ----------
    side
        Of the foot.
    unit
        Of the file; None to conclude it from the size.
    either
        Whether the last may be that of the other foot, whose shoe is its mirror image.

    Raises
    ------
    InputError
        When the file cannot be read, is no last, or is one for the other foot.
    """
    outline = last_outline(read_mesh(path, unit).mesh, path.name)
    if either and outline.side is not None:
        side = outline.side
    return outline.shoe(path.stem[:MOST_CHARACTERS], side)


def with_shoe(design: InsoleDesign, shoe: Shoe | None) -> InsoleDesign:
    """Return a design for a shoe, or for any."""
    return replace(design, outline=replace(design.outline, shoe=shoe))
