"""The prescription of one insole as an immutable value, from which every surface is derived.

The JSON form is documented in docs/formats/design.md and read by the module `design_json`.
All positions are in the insole frame: mm, x = 0 on the foot axis, y = 0 at the rearmost heel point.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from insole_core.geometry.side import Side
from insole_core.insole.elements import Correction
from insole_core.insole.prescription.base_form import BaseForm
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Shell


@dataclass(frozen=True)
class InsoleDesign:
    """The ordered corrections of an insole, its outline and its construction.

    Parameters
    ----------
    thickness_mm
        Least material between the contact surface and the bottom plane, without a cover that is
        taken off.
    grid_mm
        Pitch of the rectangular grid of thesis 3.3; its nodes lie at whole multiples of it.
    max_height_mm
        How far up the foot's flanks the contact surface reaches, from the sole's lowest point.
    margin_mm
        How far the surface extends beyond the foot's outline, on all four sides.
    outline
        The edge of the insole within that surface.
    layers
        If thicker together than `thickness_mm`, they decide: see `least_thickness_mm`.
    bottom
        "flat" on the ground, or "following" the contact surface at the least thickness.
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
    thickness_mm: float = 3.0
    grid_mm: float = 1.0
    max_height_mm: float = 30.0
    margin_mm: float = 10.0
    outline: Outline = field(default_factory=Outline)
    layers: Layers = field(default_factory=Layers)
    bottom: str = "flat"
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
    def active(self) -> tuple[Correction, ...]:
        """The corrections that are switched on, in order."""
        return tuple(c for c in self.corrections if c.enabled)

    def correction(self, correction_id: str) -> Correction | None:
        """Return the correction with this id, or None."""
        return next((c for c in self.corrections if c.id == correction_id), None)

    def with_added(self, correction: Correction) -> InsoleDesign:
        """Return the design with a correction appended."""
        return replace(self, corrections=(*self.corrections, correction))

    def with_changed(self, correction: Correction) -> InsoleDesign:
        """Return the design with `correction` in place of the one with the same id."""
        return replace(
            self,
            corrections=tuple(correction if c.id == correction.id else c for c in self.corrections),
        )

    def with_removed(self, correction_id: str) -> InsoleDesign:
        """Return the design without the correction with this id."""
        kept = tuple(c for c in self.corrections if c.id != correction_id)
        return replace(self, corrections=kept)
