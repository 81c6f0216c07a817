"""The edge of an insole, as it is prescribed."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.insole.fields import Place
from insole_core.insole.prescription.shoe import Shoe


@dataclass(frozen=True, kw_only=True)
class Outline:
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
    points_mm
        At least four if the outline is drawn.
    width_mm
        From the bisection of the 1st metatarsal to the medial border beside its head: 0 regular,
        −3.2 narrow, 3.2 wide; by default the foot's own border and the ball's allowance decide.
        Not read if the outline is drawn.
    shoe
        The shoe that the insole is to lie in; None: any.
    """

    source: str = "foot"
    extent: str = "full"
    toe_allowance_mm: float = 5.0
    ball_allowance_mm: float = 2.0
    heel_allowance_mm: float = 2.0
    shoe_size_eu: float | None = None
    points_mm: tuple[Place, ...] | None = None
    width_mm: float | None = None
    shoe: Shoe | None = None
