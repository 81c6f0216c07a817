"""A free-hand stroke."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from insole_core.errors import DesignError
from insole_core.insole.elements.correction import Correction
from insole_core.insole.fields import Choice, Declared, Line, Number, Place, Share
from insole_core.messages import Message

_WORDS = {"push": "raise", "pull": "lower", "smooth": "smooth"}


@dataclass(frozen=True, kw_only=True)
class BrushStroke(Correction):
    """One free-hand stroke over the surface; the Gaussian neighbourhood (25) follows it.

    Parameters
    ----------
    mode
        "push" adds material, "pull" removes it, "smooth" evens out.
    strength
        "push", "pull": mm on the path itself; "smooth": share from 0 to 1 of full smoothing.
    radius_mm
        Distance from the path beyond which nothing changes.
    points_mm
        Path of the pointer, at least one point.
    """

    type, name = "brush", "Brush stroke"
    stage = "pad"

    mode: Annotated[
        str, Choice("Brush", "What the stroke does to the surface", words=_WORDS, main="")
    ] = "push"
    strength: Annotated[
        float,
        Number("Strength", "How much the stroke raises or lowers", 0, 10, step=0.1, main=""),
    ] = 1.0
    radius_mm: Annotated[
        float, Number("Radius", "Distance from the stroke beyond which nothing changes", 2, 80)
    ] = 15.0
    points_mm: Annotated[
        tuple[Place, ...], Line("Path", effect="Places of the pointer along the stroke")
    ]

    @property
    def is_of_one_foot(self) -> bool:
        """Whether no finding proposes it."""
        return True

    def declared(self, name: str) -> Declared:
        """Return what a field is: a smoothing stroke has a share of full smoothing."""
        if name == "strength" and self.mode == "smooth":
            return Share("Strength", "100 % smooths out all that a stroke can", main="")
        return super().declared(name)

    @property
    def spreads(self) -> bool:
        """Whether it reads the heights beside it."""
        return self.mode == "smooth"

    def check(self, where: str) -> None:
        """Check the strength of a smoothing stroke."""
        if self.mode == "smooth" and self.strength > 1:
            raise DesignError(
                "strength{where} is {strength:g}, and for smoothing must be 0 to 1; 1 evens out "
                "all it can.",
                where=where,
                strength=self.strength,
            )

    def brief(self) -> Message:
        """Return what it does."""
        return Message(_WORDS[self.mode])
