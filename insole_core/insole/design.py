"""The prescription of one insole as an immutable value; every surface is derived from it.

The JSON form is documented in docs/formats/design.md and read by `insole_core.insole.design_json`.
All places are in the insole frame: mm, x = 0 on the foot axis, y = 0 at the rearmost heel point.
"""

from __future__ import annotations

import uuid
from dataclasses import dataclass, field, replace
from typing import ClassVar, TypeAlias

from insole_core.geometry.side import Side


def _new_id() -> str:
    return uuid.uuid4().hex[:12]


@dataclass(frozen=True, kw_only=True)
class CorrectionBase:
    """What every correction has.

    Parameters
    ----------
    id
        Stays the same while the correction is edited.
    enabled
        A correction that is switched off stays in the prescription and changes nothing.
    author, created_at
        Who prescribed it and when (ISO 8601, UTC); empty where unknown.
    """

    id: str = field(default_factory=_new_id)
    enabled: bool = True
    author: str = ""
    created_at: str = ""


@dataclass(frozen=True, kw_only=True)
class Pelott(CorrectionBase):
    """A raised pad under the metatarsal arch, thesis 6.3.2.

    Parameters
    ----------
    centre_mm
        Place (x, y) of the apex, where the added height is `height_mm`.
    length_mm, width_mm
        Size of the egg outline (26); its blunt end is towards the toes.
    height_mm
        Peak of the Gaussian neighbourhood (25).
    turn_deg
        Counter-clockwise seen from above (from the foot's side).
    egg_ratio
        r of (26): 0 gives an ellipse, 1 the most pointed egg.
    sigma_mm
        Standard deviations (along width, along length) of (25); by default the outline decides.
    """

    type: ClassVar[str] = "pelott"
    shape: str = "egg"
    centre_mm: tuple[float, float]
    length_mm: float = 60.0
    width_mm: float = 40.0
    height_mm: float = 6.0
    turn_deg: float = 0.0
    egg_ratio: float = 0.5
    sigma_mm: tuple[float, float] | None = None


@dataclass(frozen=True, kw_only=True)
class Posting(CorrectionBase):
    """Pronation/supination: rotation of the foot against the insole's bottom, thesis 6.3.1.

    Angles > 0 raise the medial edge (varus) of either foot; rear- and forefoot blend between.
    """

    type: ClassVar[str] = "posting"
    rearfoot_deg: float = 0.0
    forefoot_deg: float = 0.0


Correction: TypeAlias = Pelott | Posting


@dataclass(frozen=True)
class InsoleDesign:
    """An ordered set of corrections and the make of the insole.

    Parameters
    ----------
    side
    corrections
    thickness_mm
        Least material between the contact surface and the bottom plane.
    grid_mm
        Pitch of the rectangular grid of thesis 3.3; its nodes lie at whole multiples of it.
    max_height_mm
        How far up the foot's flanks the contact surface reaches, from the sole's lowest point.
    margin_mm
        How far the surface goes on beyond the foot's outline, on all four sides.
    """

    side: Side
    corrections: tuple[Correction, ...] = ()
    thickness_mm: float = 3.0
    grid_mm: float = 1.0
    max_height_mm: float = 30.0
    margin_mm: float = 10.0

    def correction(self, correction_id: str) -> Correction | None:
        """Find a correction, or None."""
        return next((c for c in self.corrections if c.id == correction_id), None)

    def with_added(self, correction: Correction) -> InsoleDesign:
        """Append a correction."""
        return replace(self, corrections=(*self.corrections, correction))

    def with_changed(self, correction: Correction) -> InsoleDesign:
        """Put `correction` where the one of the same id was."""
        return replace(
            self,
            corrections=tuple(correction if c.id == correction.id else c for c in self.corrections),
        )

    def with_removed(self, correction_id: str) -> InsoleDesign:
        """Leave one correction out."""
        kept = tuple(c for c in self.corrections if c.id != correction_id)
        return replace(self, corrections=kept)
