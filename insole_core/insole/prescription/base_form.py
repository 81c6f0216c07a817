"""What the contact surface starts from: the foot itself, a form of a library, or both."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from insole_core.insole.fields import Number, Part, Share, Table, Text
from insole_core.insole.prescription.finish import HEADS_ALONG

__all__ = ["HEADS_ALONG", "BaseForm", "Form"]


@dataclass(frozen=True, kw_only=True)
class Form(Part):
    """Heights over stations of a foot, graded to other feet; the same for left and right.

    Parameters
    ----------
    name
        For display.
    length_mm, ball_width_mm
        Of the foot that the heights hold for. On another foot the stations move with its landmarks,
        and the heights change with the width of its ball, so that slopes across the foot stay.
    along_shares : (m,)
        Shares of the way along the foot, increasing: 0 at the rearmost point of the heel,
        `HEADS_ALONG` at the line of the metatarsal heads, 1 at the longest toe.
    across_shares : (n,)
        Shares of the width, increasing: 0 at the medial, 1 at the lateral border.
    heights_mm : m rows of n
        Over the lowest place of the form; between the stations the surface is a cubic spline.
    source
        Where the heights come from.
    """

    name: Annotated[str, Text("Form")]
    length_mm: Annotated[float, Number("Foot length", least=80, greatest=400)]
    ball_width_mm: Annotated[float, Number("Ball width", least=30, greatest=160)]
    along_shares: Annotated[tuple[float, ...], Table("Along", "", -0.5, 1.5, unit="")]
    across_shares: Annotated[tuple[float, ...], Table("Across", "", -1, 2, unit="")]
    heights_mm: Annotated[tuple[tuple[float, ...], ...], Table("Heights", "", -60, 60)]
    source: str = ""


@dataclass(frozen=True, kw_only=True)
class BaseForm(Part):
    """A form in place of the foot's own sole, or mixed with it.

    Parameters
    ----------
    contact_share
        Weight of the foot's own sole in the mean of both: 0 is the form alone.
    """

    form: Form
    contact_share: Annotated[float, Share("Share of the foot")] = 0.0
