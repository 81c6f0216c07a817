"""Warnings about an insole in its shoe: where it is wider, and which pads trimming cuts."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import Landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.build import Insole
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.elements import Pelott
from insole_core.insole.outline.insole_outline import insole_outline, shoe_inside
from insole_core.insole.outline.shoe_fit import fit_in
from insole_core.insole.pads.pad_heights import pad_outline
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.messages import Message

_TIGHT_MM = 5.0
"""Least room before the toes: feet lengthen as they step."""
_CUT_MM, _ROUNDED_MM = 1.0, 0.5
_ENDS = 0.1


def shoe_warnings(insole: Insole, landmarks: Landmarks) -> Iterator[DesignWarning]:
    """Yield the warnings about an insole in its shoe; none if no shoe is named."""
    return warnings_in_shoe(insole.foot, insole.design, landmarks)


def warnings_in_shoe(
    foot: Foot, design: InsoleDesign, landmarks: Landmarks
) -> Iterator[DesignWarning]:
    """Yield the same of an insole that is not built yet."""
    shoe, inside = design.outline.shoe, shoe_inside(foot, design.outline)
    if shoe is None or inside is None:
        return
    room_mm = float(inside[:, 1].max()) - foot.length_mm
    if room_mm < -_ROUNDED_MM:
        yield DesignWarning(
            Message(
                "The foot is {longer:.0f} mm longer than the shoe {shoe} is inside; check the "
                "size.",
                longer=-room_mm,
                shoe=shoe.name,
            )
        )
    elif room_mm < _TIGHT_MM:
        yield DesignWarning(
            Message(
                "The shoe {shoe} leaves {room:.0f} mm before the toes of this foot, and 10 to 15 "
                "mm are usual; check the size.",
                shoe=shoe.name,
                room=max(room_mm, 0.0),
            )
        )
    try:
        outline = insole_outline(foot, design, landmarks)
    except DesignError:  # no insole can be made, which is said where it is tried
        return
    fit = fit_in(outline, inside)
    if not shoe.trim and fit.most_over_mm:
        x, y = fit.widest_place
        yield DesignWarning(
            Message(
                "The insole is up to {over:.1f} mm wider than the shoe {shoe}, {place}; trim it to "
                "the shoe, or take another size.",
                over=fit.most_over_mm,
                shoe=shoe.name,
                place=_place(fit.outline, fit.widest_place, design.side),
            ),
            place_mm=(float(x), float(y)),
        )
    if shoe.trim:
        pads = design.of(Pelott)
        yield from (_cut(pad, inside, shoe.name) for pad in pads if _is_cut(pad, inside))


def _place(outline: FloatArray, place: FloatArray, side: Side) -> Message:
    """Say where a point of an outline lies."""
    low, high = outline[:, 1].min(), outline[:, 1].max()
    share = (place[1] - low) / (high - low)
    if share < _ENDS / 2 or share > 1 - _ENDS:
        return Message("at the heel") if share < 0.5 else Message("at the toes")
    middle = np.mean(outline[np.abs(outline[:, 1] - place[1]) < 2.0, 0])
    is_medial = (place[0] - middle) * side.medial_sign > 0
    words = "{from_heel:.0f} mm from the heel on the medial side"
    if not is_medial:
        words = "{from_heel:.0f} mm from the heel on the lateral side"
    return Message(words, from_heel=float(place[1] - low))


def _is_cut(pad: Pelott, inside: FloatArray) -> bool:
    return bool(fit_in(pad_outline(pad), inside).over_mm.max() > _CUT_MM)


def _cut(pad: Pelott, inside: FloatArray, name: str) -> DesignWarning:
    return DesignWarning(
        Message(
            "The {pad} reaches {over:.0f} mm beyond the shoe {shoe} and is cut there; move it or "
            "make it smaller.",
            pad=Message(pad.noun),
            over=float(fit_in(pad_outline(pad), inside).over_mm.max()),
            shoe=name,
        ),
        pad.id,
        pad.centre_mm,
    )
