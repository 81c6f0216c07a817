"""What turns the foot's contact surface into a finished one: rim, toe zone, fill, smoothing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from insole_core.insole.fields import Choice, Number, Part, Share

HEADS_ALONG = 0.7
"""Where the 1st (medially) and the 5th (laterally) metatarsal head lie along the edge."""


@dataclass(frozen=True, kw_only=True)
class RimStation(Part):
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

    border: Annotated[
        str,
        Choice(
            "Border",
            words={"medial": "medial", "lateral": "lateral"},
            effect="The border that the station is on",
        ),
    ]
    along: Annotated[
        float,
        Share("Place", "0 % behind the heel, 70 % beside the metatarsal head, 100 % at the toes"),
    ]
    height_mm: Annotated[
        float, Number("Height", "Height of the rim at this station over its level", -10, 45)
    ]
    over: Annotated[
        str,
        Choice(
            "Over",
            "The level from which the height is counted",
            words={"heel": "heel", "toes": "toe zone", "foot": "the foot itself"},
        ),
    ] = "heel"

    def acts(self, name: str) -> bool:
        """Return whether a field says what the name of its rim does not."""
        return name != "border"


@dataclass(frozen=True, kw_only=True)
class Finish(Part):
    """The finishing of a contact surface; a design without one is left as scanned (thesis 3.3).

    Parameters
    ----------
    toe_zone
        "flat", "sulcus", "crest", or "as_scanned".
    toe_line_mm
        Where the toe zone begins to take over, ahead of the parabola through the heads.
    arch_fill_mm
        How far the medial arch is lowered below the scan at its apex.
    heel_blend_mm, arch_blend_mm, forefoot_blend_mm
        Width of the transition from the supporting surface to the rim.
    expansion_mm
        By how much the heel and the lateral border are widened on each side, for soft tissue that
        spreads in stance.
    skin_smoothing_mm
        Standard deviation of the Gaussian that evens out folds of the skin; 0 for none.
    rim
        Stations in any order; without any, the rim stays as the foot.
    """

    toe_zone: Annotated[
        str,
        Choice(
            "Toe zone",
            "What lies ahead of the metatarsal heads, in place of the scanned toes",
            words={
                "flat": "flat", "sulcus": "sulcus", "crest": "toe crest",
                "as_scanned": "as scanned",
            },
        ),
    ] = "flat"  # fmt: skip
    toe_line_mm: Annotated[
        float,
        Number(
            "Toe line",
            "How far ahead of the metatarsal heads the toe zone begins",
            0,
            40,
            expert=True,
        ),
    ] = 4.0
    arch_fill_mm: Annotated[
        float,
        Number(
            "Arch fill",
            least=0,
            greatest=15,
            effect="How far the medial arch is lowered below the scan",
        ),
    ] = 0.0
    heel_blend_mm: Annotated[
        float,
        Number(
            "Heel transition",
            "Width of the transition from support to rim at the heel",
            4,
            25,
            expert=True,
        ),
    ] = 9.0
    arch_blend_mm: Annotated[
        float,
        Number(
            "Arch transition",
            "Width of the transition from support to rim in the arch",
            4,
            25,
            expert=True,
        ),
    ] = 12.0
    forefoot_blend_mm: Annotated[
        float,
        Number(
            "Forefoot transition",
            "Width of the transition from support to rim at the forefoot",
            4,
            25,
            expert=True,
        ),
    ] = 8.0
    expansion_mm: Annotated[
        float,
        Number(
            "Soft tissue expansion",
            "Widening of heel and lateral border: soft tissue spreads in stance",
            0,
            5,
            expert=True,
        ),
    ] = 0.0
    skin_smoothing_mm: Annotated[
        float,
        Number(
            "Skin smoothing",
            "Width over which folds of the skin are evened out; 0 for none",
            0,
            6,
            expert=True,
        ),
    ] = 2.0
    rim: tuple[RimStation, ...] = ()
