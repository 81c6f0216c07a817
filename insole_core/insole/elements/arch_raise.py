"""A raised medial arch."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Self

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.elements.correction import Correction
from insole_core.insole.elements.pelott import Pelott
from insole_core.insole.elements.words import mm_message
from insole_core.insole.fields import Number, Place, Spot, ranges_of
from insole_core.insole.grips import Grip, Pull
from insole_core.insole.judged import SHOWN, Judged
from insole_core.insole.primitives.height_field import HeightField
from insole_core.messages import Message, Value

_TOLERANCE_MM = 0.2


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
        return self._ellipse(apex, self._rise_mm(apex, surface))

    @classmethod
    def rule(cls, mine: Sequence[Self], judged: Judged) -> Iterator[DesignWarning]:
        """Warn where the finished arch is not as high as prescribed."""
        for arch in mine:
            place = arch.place_mm(judged.foot)
            sentence = arch._problem(float(judged.surface.height_at(np.array(place))))
            if sentence is not None:
                yield DesignWarning(sentence, arch.id, place)

    def _problem(self, finished_mm: float) -> Message | None:
        """Say what is wrong with the height of the finished arch; NaN beside the insole."""
        if self.target_mm is None:
            return None
        if not np.isfinite(finished_mm):
            return Message("The arch is to be raised beside the insole; move its place inwards.")
        height_mm = rounded(finished_mm, SHOWN)
        values: dict[str, Value] = {"height_mm": height_mm, "target_mm": self.target_mm}
        if height_mm - self.target_mm > _TOLERANCE_MM:
            return Message(
                "The arch is {height_mm:g} mm high where {target_mm:g} mm are prescribed, and an "
                "arch raise lowers nothing; prescribe a greater height, or lower the surface "
                "there.",
                **values,
            )
        if self.target_mm - height_mm > _TOLERANCE_MM:
            return Message(
                "The arch is only {height_mm:g} mm high where {target_mm:g} mm are prescribed; a "
                "recess or a stroke lowers it there.",
                **values,
            )
        return None

    def place_mm(self, foot: Foot) -> Place:
        """Return its apex: its own, or that of the foot's arch."""
        if self.apex_mm is not None:
            return self.apex_mm
        x, y = find_landmarks(foot)["arch_apex"].point[:2]
        return float(x), float(y)

    def lines(self, foot: Foot) -> tuple[FloatArray, ...]:
        """Return the border of the zone that is raised."""
        return self._pad(foot).lines(foot)

    def grips(self, foot: Foot) -> tuple[Grip, ...]:
        """Return those of the ellipse, which does not turn."""
        return tuple(grip for grip in self._pad(foot).grips(foot) if grip.name != "turn")

    def pulled(self, grip: str, pull: Pull, foot: Foot) -> Self:
        """Return it as the ellipse that was pulled."""
        before = self._pad(foot)
        after = before.pulled(grip, pull, foot)
        raised = replace(
            self,
            apex_mm=self.apex_mm if after.centre_mm == before.centre_mm else after.centre_mm,
            length_mm=_within("length_mm", after.length_mm),
            width_mm=_within("width_mm", after.width_mm),
        )
        if self.target_mm is None:
            return replace(raised, height_mm=after.height_mm)
        target = rounded(self.target_mm + after.height_mm - before.height_mm, 0.1)
        return replace(raised, target_mm=_within("target_mm", target))

    def _pad(self, foot: Foot) -> Pelott:
        """Return the ellipse that is grabbed for it; of one with a target it counts from 0."""
        height_mm = self.height_mm if self.target_mm is None else 0.0
        return self._ellipse(self.place_mm(foot), height_mm)

    def _ellipse(self, apex_mm: Place, height_mm: float) -> Pelott:
        return Pelott(
            id=self.id,
            centre_mm=apex_mm,
            length_mm=self.length_mm,
            width_mm=self.width_mm,
            height_mm=height_mm,
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


def _within(name: str, value: float) -> float:
    return float(ranges_of(ArchRaise)[name].nearest(value))
