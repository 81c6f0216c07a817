"""The layers of an insole, as they are prescribed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from insole_core.insole.fields import Choice, Number, Part, Text


@dataclass(frozen=True, kw_only=True)
class Layers(Part):
    """Thickness of the layers from the foot down, mm; 0 for a layer that is not made separately.

    Parameters
    ----------
    cover_material, shell_material, base_material
        Of the layers; None if not said.
    cover_is_taken_off
        The cover is glued on later: what is made lies lower by its thickness, and the foot stands
        on the cover.
    """

    cover_mm: Annotated[
        float, Number("Cover", "Thickness of the layer next to the foot; 0 for none", 0, 5)
    ] = 0.0
    shell_mm: Annotated[
        float,
        Number("Middle layer", "Thickness of the layer between cover and base; 0 for none", 0, 10),
    ] = 0.0
    base_mm: Annotated[
        float,
        Number(
            "Base",
            "Thickness of the layer next to the shoe; 0 for none",
            0,
            10,
            within="Layers",
        ),
    ] = 0.0
    cover_material: Annotated[
        str | None,
        Text(
            "Material of the cover",
            effect="What the layer is made of; a material of the clinic's table",
        ),
    ] = None
    shell_material: Annotated[
        str | None,
        Text(
            "Material of the middle layer",
            effect="What the layer is made of; a material of the clinic's table",
        ),
    ] = None
    base_material: Annotated[
        str | None,
        Text(
            "Material of the base",
            effect="What the layer is made of; a material of the clinic's table",
        ),
    ] = None
    cover_is_taken_off: Annotated[
        bool,
        Choice(
            "Cover is",
            "A cover that is glued on later is taken off what is made",
            words={False: "made with it", True: "glued on later"},
            within="Layers",
            expert=True,
        ),
    ] = False

    @property
    def total_mm(self) -> float:
        """Thickness of all layers together."""
        return self.cover_mm + self.shell_mm + self.base_mm
