"""A raised medial arch."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np

from insole_core.insole.elements.correction import Correction
from insole_core.insole.elements.pelott import Pelott
from insole_core.insole.elements.words import mm_message
from insole_core.insole.fields import Number, Place, Spot
from insole_core.insole.primitives.height_field import HeightField
from insole_core.messages import Message


@dataclass(frozen=True, kw_only=True)
class ArchRaise(Correction):
    """The medial arch raised about its apex, an ellipse that falls to zero with continuous slope.

    Parameters
    ----------
    height_mm
        Added at the apex; ignored if there is a target.
    target_mm
        Height over the bottom plane that the arch reaches at the apex, before pads and strokes.
        A surface that is higher there is not lowered.
    apex_mm
        By default the apex of the foot's own arch.
    """

    type, name = "arch_raise", "Arch raise"
    tip = "Raise the medial arch about its apex"
    stage = "pad"

    height_mm: Annotated[
        float,
        Number("Height", "How much the arch is raised at its highest place", -20, 20, main=""),
    ] = 3.0
    target_mm: Annotated[
        float | None,
        Number(
            "Finished height",
            "Height of the finished arch over the underside of the insole",
            0,
            60,
            main="{value} over the floor",
        ),
    ] = None
    length_mm: Annotated[
        float, Number("Length", "Length of the zone that is raised", 20, 200, main="{value} long")
    ] = 100.0
    width_mm: Annotated[float, Number("Width", "Width of the zone that is raised", 10, 150)] = 50.0
    apex_mm: Annotated[Place | None, Spot("Place")] = None

    def acts(self, name: str) -> bool:
        """Return whether a field does something: to a height, what is added says nothing."""
        return name != "height_mm" or self.target_mm is None

    def for_any_foot(self) -> Correction:
        """Return it at the apex of whatever foot."""
        return replace(super().for_any_foot(), apex_mm=None)  # type: ignore[call-arg]

    def laid(self, surface: HeightField, arch_apex_mm: Place) -> Pelott:
        """Return the elliptical pad that it is on a surface."""
        apex = self.apex_mm or arch_apex_mm
        return Pelott(
            id=self.id,
            centre_mm=apex,
            length_mm=self.length_mm,
            width_mm=self.width_mm,
            height_mm=self._rise_mm(apex, surface),
            egg_ratio=0.0,
        )

    def _rise_mm(self, apex_mm: Place, surface: HeightField) -> float:
        """Return by how much it lifts a surface at its apex; 0 off the surface."""
        if self.target_mm is None:
            return self.height_mm
        missing = self.target_mm - float(surface.height_at(np.array(apex_mm)))
        return max(missing, 0.0) if np.isfinite(missing) else 0.0

    def brief(self) -> Message:
        """Return what it adds, or the height that it reaches."""
        if self.target_mm is None:
            return mm_message(self.height_mm)
        return Message("to {height}", height=mm_message(self.target_mm))
