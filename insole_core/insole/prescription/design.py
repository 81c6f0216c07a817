"""The prescription of one insole as an immutable value, from which every surface is derived.

The JSON form is documented in docs/formats/design.md and read by the module `design_json`.
All positions are in the insole frame: mm, x = 0 on the foot axis, y = 0 at the rearmost heel point.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Annotated, TypeVar

from insole_core.geometry.side import Side
from insole_core.insole.elements import Correction
from insole_core.insole.fields import Choice, Number, Part
from insole_core.insole.prescription.base_form import BaseForm
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Shell

_Kind = TypeVar("_Kind", bound=Correction)


@dataclass(frozen=True)
class InsoleDesign(Part):
    """The ordered corrections of an insole, its outline and its construction.

    Parameters
    ----------
    thickness_mm
        Least material between the contact surface and the bottom plane, without a cover that is
        taken off.
    bottom
        "flat" on the ground, or "following" the contact surface at the least thickness.
    max_height_mm
        How far up the foot's flanks the contact surface reaches, from the sole's lowest point.
    margin_mm
        How far the surface extends beyond the foot's outline, on all four sides.
    grid_mm
        Pitch of the rectangular grid of thesis 3.3; its nodes lie at whole multiples of it.
    outline
        The edge of the insole within that surface.
    layers
        If thicker together than `thickness_mm`, they decide: see `least_thickness_mm`.
    device
        Name of the device that the design started from; empty if none.
    base
        None: the foot's own sole.
    finish
        None: as scanned, the way of thesis 3.3.
    shell
        None: plain walls and bottom, as the order asks for.
    """

    side: Side
    corrections: tuple[Correction, ...] = ()
    thickness_mm: Annotated[
        float,
        Number("Thickness", "Least thickness under the foot, before pads and recesses", 0.5, 40),
    ] = 3.0
    bottom: Annotated[
        str,
        Choice(
            "Underside",
            "Flat on the ground, or cupped: everywhere as thick below the foot",
            words={"flat": "flat", "following": "cupped"},
        ),
    ] = "flat"
    max_height_mm: Annotated[
        float,
        Number(
            "Side height", "Height over the ground up to which the insole follows the foot", 5, 45
        ),
    ] = 30.0
    margin_mm: Annotated[
        float,
        Number(
            "Margin", least=0, greatest=50, effect="How far the surface is computed beside the foot"
        ),
    ] = 10.0
    grid_mm: Annotated[
        float,
        Number(
            "Computed every",
            "Distance of the points that the surface is computed at",
            0.25,
            5,
            step=0.25,
            expert=True,
            within="Insole",
        ),
    ] = 1.0
    outline: Outline = field(default_factory=Outline)
    layers: Layers = field(default_factory=Layers)
    device: str = ""
    base: BaseForm | None = None
    finish: Finish | None = None
    shell: Shell | None = None

    @property
    def least_thickness_mm(self) -> float:
        """Height of the contact surface's lowest point over the bottom, before pads.

        It includes a cover that is taken off.
        """
        return max(self.thickness_mm + self.taken_off_mm, self.layers.total_mm)

    @property
    def taken_off_mm(self) -> float:
        """Thickness of a cover that is glued on later; 0 if it is made with the insole."""
        return self.layers.cover_mm if self.layers.cover_is_taken_off else 0.0

    @property
    def made_thickness_mm(self) -> float:
        """Least thickness of what is made, before pads."""
        return self.least_thickness_mm - self.taken_off_mm

    @property
    def heel_pitch_mm(self) -> float:
        """How much higher than the ball the shoe carries the heel; 0 without a shell."""
        return 0.0 if self.shell is None else self.shell.heel_pitch_mm

    @property
    def active(self) -> tuple[Correction, ...]:
        """The corrections that are switched on, in order."""
        return tuple(c for c in self.corrections if c.enabled)

    def of(self, kind: type[_Kind], *, active: bool = True) -> tuple[_Kind, ...]:
        """Return the corrections of one type, in order; those switched off too if not `active`."""
        among = self.active if active else self.corrections
        return tuple(c for c in among if isinstance(c, kind))

    def found(self, correction_id: str | None, kind: type[_Kind]) -> _Kind | None:
        """Return the correction with this id if it is of one type, or None."""
        return next((c for c in self.of(kind, active=False) if c.id == correction_id), None)

    def of_stage(self, *stages: str) -> tuple[Correction, ...]:
        """Return the active corrections that change something at one of these stages, in order."""
        return tuple(c for c in self.active if c.stage in stages)

    def correction(self, correction_id: str) -> Correction | None:
        """Return the correction with this id, or None."""
        return self.found(correction_id, Correction)

    def with_added(self, correction: Correction) -> InsoleDesign:
        """Return the design with a correction appended."""
        return replace(self, corrections=(*self.corrections, correction))

    def with_changed(self, correction: Correction) -> InsoleDesign:
        """Return the design with `correction` in place of the one with the same id."""
        return replace(
            self,
            corrections=tuple(correction if c.id == correction.id else c for c in self.corrections),
        )

    def with_set(self, correction: Correction) -> InsoleDesign:
        """Return the design with a correction added, or in place of the one with the same id."""
        if self.correction(correction.id) is None:
            return self.with_added(correction)
        return self.with_changed(correction)

    def with_removed(self, correction_id: str) -> InsoleDesign:
        """Return the design without the correction with this id."""
        kept = tuple(c for c in self.corrections if c.id != correction_id)
        return replace(self, corrections=kept)
