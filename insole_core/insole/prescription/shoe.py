"""The shoe that an insole is made for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from insole_core.insole.fields import Choice, Line, Number, Part, Place, Text


@dataclass(frozen=True, kw_only=True)
class Shoe(Part):
    """The inside of a shoe seen from above, where the insole lies.

    Parameters
    ----------
    name
        For display: a size, or the file of a last.
    trim
        Whether the insole is trimmed to the shoe.
    clearance_mm
        Room that trimming leaves between the insole and the shoe.
    inside_mm
        Places on the closed edge of the inside, in the shoe's own frame: x medial, y = 0 at the
        rearmost point, x = 0 on the line through the middles of heel and ball. The same for a left
        and a right shoe.
    """

    name: Annotated[str, Text("Shoe")]
    trim: Annotated[bool, Choice("Trimmed to it", words={False: "no", True: "yes"})] = False
    clearance_mm: Annotated[float, Number("Room", least=0, greatest=5)] = 0.5
    inside_mm: Annotated[tuple[Place, ...], Line("Inside", "", 12, 400, is_mirrored=False)]
