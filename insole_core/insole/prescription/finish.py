"""What turns the foot's contact surface into a finished one: rim, toe zone, fill, smoothing."""

from __future__ import annotations

from dataclasses import dataclass

HEADS_ALONG = 0.7
"""Where the 1st (medially) and the 5th (laterally) metatarsal head lie along the edge."""


@dataclass(frozen=True, kw_only=True)
class RimStation:
    """The height of the rim at one place of the insole's edge.

    Parameters
    ----------
    border
        "medial" or "lateral".
    along
        Share of the way along this border's edge: 0 behind the heel, `HEADS_ALONG` beside the outer
        metatarsal head of this border, 1 in front of the toes; linear in arc length between these,
        so that a station moves with the landmarks.
    height_mm
        Over the level that `over` names.
    over
        "heel" (the lowest place of the heel), "toes" (the level of the toe zone), or "foot" (the
        contact surface beside the edge: the height that the foot itself asks for).
    """

    border: str
    along: float
    height_mm: float
    over: str = "heel"


@dataclass(frozen=True, kw_only=True)
class Finish:
    """The finishing of a contact surface; a design without one is left as scanned (thesis 3.3).

    Parameters
    ----------
    expansion_mm
        By how much the heel and the lateral border are widened on each side, for soft tissue that
        spreads in stance.
    arch_fill_mm
        How far the medial arch is lowered below the scan at its apex.
    skin_smoothing_mm
        Standard deviation of the Gaussian that evens out folds of the skin; 0 for none.
    toe_zone
        "flat", "sulcus", "crest", or "as_scanned".
    toe_line_mm
        Where the toe zone begins to take over, ahead of the parabola through the heads.
    heel_blend_mm, arch_blend_mm, forefoot_blend_mm
        Width of the transition from the supporting surface to the rim.
    rim
        Stations in any order; without any, the rim stays as the foot.
    """

    expansion_mm: float = 0.0
    arch_fill_mm: float = 0.0
    skin_smoothing_mm: float = 2.0
    toe_zone: str = "flat"
    toe_line_mm: float = 4.0
    heel_blend_mm: float = 9.0
    arch_blend_mm: float = 12.0
    forefoot_blend_mm: float = 8.0
    rim: tuple[RimStation, ...] = ()
