"""The edge of an insole and the shoe that it is made for, as they are prescribed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Final

from insole_core.insole.fields import Choice, Line, Number, Part, Place, Text

NARROW_MM: Final = -3.2
"""Medial border of a narrow insole, from the bisection of the 1st metatarsal."""
WIDE_MM: Final = 3.2


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


@dataclass(frozen=True, kw_only=True)
class Outline(Part):
    """The edge of the insole, seen from above.

    Parameters
    ----------
    source
        "foot": the foot's outline with the allowances; "shoe_size": the length from the shoe size,
        the widths from the foot; "drawn": the closed curve through `points_mm`.
    extent
        "full", or "three_quarter": ends behind the metatarsal heads.
    toe_allowance_mm, ball_allowance_mm, heel_allowance_mm
        Added to the foot in front of the toes, on both sides of the ball, and around the heel.
    shoe_size_eu
        Paris points, 6.67 mm each; required if the source is the shoe size.
    width_mm
        From the bisection of the 1st metatarsal to the medial border beside its head: 0 regular,
        −3.2 narrow, 3.2 wide; by default the foot's own border and the ball's allowance decide.
        Not read if the outline is drawn.
    points_mm
        At least four if the outline is drawn.
    shoe
        The shoe that the insole is to lie in; None: any.
    """

    source: Annotated[
        str,
        Choice(
            "Outline",
            "What the edge of the insole follows",
            words={"foot": "from the foot", "shoe_size": "from the shoe size", "drawn": "drawn"},
        ),
    ] = "foot"
    extent: Annotated[
        str,
        Choice(
            "Extent",
            "To the toes, or to behind the metatarsal heads",
            words={"full": "full length", "three_quarter": "three-quarter"},
        ),
    ] = "full"
    toe_allowance_mm: Annotated[
        float, Number("Toes", "Allowance in front of the longest toe", -20, 30, within="Outline")
    ] = 5.0
    ball_allowance_mm: Annotated[
        float, Number("Ball", "Allowance on both sides of the ball", -20, 20, within="Outline")
    ] = 2.0
    heel_allowance_mm: Annotated[
        float, Number("Heel", "Allowance around the heel", -20, 20, within="Outline")
    ] = 2.0
    shoe_size_eu: Annotated[
        float | None,
        Number("EU size", "Size of the shoe, which decides the length", 16, 52, unit=""),
    ] = None
    width_mm: Annotated[
        float | None,
        Number(
            "Width",
            "Medial border against the bisection of the 1st metatarsal",
            -20,
            20,
            template="{value} mm from the bisection of the 1st metatarsal",
            offers=(
                (None, "from the foot"),
                (NARROW_MM, "narrow"),
                (0.0, "regular"),
                (WIDE_MM, "wide"),
            ),
            within="Outline",
        ),
    ] = None
    points_mm: Annotated[
        tuple[Place, ...] | None, Line("Drawn outline", effect="Places of a drawn edge")
    ] = None
    shoe: Shoe | None = None

    def acts(self, name: str) -> bool:
        """Return whether a field does something beside the others."""
        if self.source == "drawn":
            return name in ("source", "points_mm")
        if name == "toe_allowance_mm":
            return self.source == "foot" and self.extent == "full"
        if name == "shoe_size_eu":
            return self.source == "shoe_size"
        return name != "points_mm"
