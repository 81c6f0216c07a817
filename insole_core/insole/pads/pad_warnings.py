"""What is unusual about pads on a foot, by the clinic's limits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, islice
from typing import TypeVar

import numpy as np

from insole_core.foot.landmarks import HEADS, Landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.clinic_rules import ClinicRules
from insole_core.insole.judged import SHOWN, SHOWN_SHARE, Judged
from insole_core.insole.pads.clearance import behind_heads_mm
from insole_core.insole.pads.pad_form import PadForm
from insole_core.insole.pads.pad_heights import pad_outline
from insole_core.insole.primitives.outline_curve import inside_curve
from insole_core.messages import Message, Value

_Pad = TypeVar("_Pad", bound=PadForm)
_AT_LINE = ("egg", "bar")
"""Shapes whose distance behind the heads is the clinic's rule; a drop may lie between the heads."""
_STEP_MM = 2.0
_MOST_OVERLAPS = 10
"""Of which is warned: where very many pads lie on each other, no more are sought."""


def sentences_of(pad: PadForm, judged: Judged) -> Iterator[Message]:
    """Say what is unusual about one pad."""
    rules, landmarks = judged.rules, judged.landmarks
    share_of = _share_on_insole if pad.is_filler else _share_on_foot
    share = rounded(share_of(judged, pad), SHOWN_SHARE)
    if share < rules.least_on_foot_share and pad.is_filler:
        yield Message(
            "Only {share:.0%} of the {pad} lies on the insole, and the rest is not made; set the "
            "shoe size or a longer outline.",
            share=share,
            pad=pad.noun,
        )
    elif share < rules.least_on_foot_share:
        yield Message(
            "Only {share:.0%} of the {pad} lies below the foot; move it inwards.",
            share=share,
            pad=pad.noun,
        )
    yield from _of_recess(pad, rules)
    if pad.leaves_first_head_free:
        yield from _of_first_head(pad, landmarks, rules)
    if pad.ends_behind_heads and pad.height_mm > 0:
        yield from _of_metatarsal_pad(pad, landmarks, rules)


def overlaps(pads: Sequence[_Pad], rules: ClinicRules) -> Iterator[tuple[_Pad, Message]]:
    """Say which pads lie on each other, each pair with the smaller one."""
    return islice(_found_overlaps(pads, rules), _MOST_OVERLAPS)


def _of_recess(pad: PadForm, rules: ClinicRules) -> Iterator[Message]:
    if pad.is_recess and pad.height_mm > 0:
        yield Message(
            "The {pad} stands {height_mm:g} mm out of the insole and presses instead of relieving; "
            "set a depth above 0.",
            pad=pad.noun,
            height_mm=rounded(pad.height_mm, SHOWN),
        )
    if -pad.height_mm > rules.greatest_recess_depth_mm:
        yield Message(
            "The {pad} is {depth_mm:g} mm deep; up to {usual_mm:g} mm are usual.",
            pad=pad.noun,
            depth_mm=rounded(-pad.height_mm, SHOWN),
            usual_mm=rules.greatest_recess_depth_mm,
        )


def _of_first_head(pad: PadForm, landmarks: Landmarks, rules: ClinicRules) -> Iterator[Message]:
    head = landmarks[HEADS[0]].point[:2]
    outline = pad_outline(pad)
    away_mm = float(np.hypot(*(outline - head).T).min())
    away_mm = 0.0 if inside_curve(outline, head) else rounded(away_mm, SHOWN)
    if away_mm < rules.least_beside_first_head_mm:
        yield Message(
            "The {pad} comes within {distance_mm:g} mm of the 1st head, which it leaves free; keep "
            "it at least {least_mm:g} mm away.",
            pad=pad.noun,
            distance_mm=away_mm,
            least_mm=rules.least_beside_first_head_mm,
        )


def _of_metatarsal_pad(pad: PadForm, landmarks: Landmarks, rules: ClinicRules) -> Iterator[Message]:
    if pad.height_mm > rules.greatest_metatarsal_pad_height_mm:
        yield Message(
            "The {pad} is {height_mm:g} mm high; up to {usual_mm:g} mm are usual.",
            pad=pad.noun,
            height_mm=rounded(pad.height_mm, SHOWN),
            usual_mm=rules.greatest_metatarsal_pad_height_mm,
        )
    if pad.shape not in _AT_LINE:
        return
    behind = rounded(behind_heads_mm(pad, landmarks), SHOWN)
    least, most = rules.pelott_least_behind_heads_mm, rules.pelott_greatest_behind_heads_mm
    if not least <= behind <= most:
        values: dict[str, Value] = {
            "pad": pad.noun,
            "distance_mm": abs(behind),
            "least_mm": least,
            "most_mm": most,
        }
        yield (
            Message(
                "The front edge of the {pad} lies {distance_mm:.1f} mm behind the line of the "
                "heads 2 to 4; the clinic's rule is {least_mm:g} to {most_mm:g} mm behind it.",
                **values,
            )
            if behind >= 0
            else Message(
                "The front edge of the {pad} lies {distance_mm:.1f} mm ahead of the line of the "
                "heads 2 to 4; the clinic's rule is {least_mm:g} to {most_mm:g} mm behind it.",
                **values,
            )
        )


def _share_on_foot(judged: Judged, pad: PadForm) -> float:
    places = _places_in(pad)
    field = judged.surface
    column, row = np.rint((places - [field.x0_mm, field.y0_mm]) / field.step_mm).astype(int).T
    rows, columns = judged.measured.shape
    inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
    return float(judged.measured[row[inside], column[inside]].sum() / len(places))


def _share_on_insole(judged: Judged, pad: PadForm) -> float:
    return float(inside_curve(judged.outline_mm(), _places_in(pad)).mean())


def _found_overlaps(pads: Sequence[_Pad], rules: ClinicRules) -> Iterator[tuple[_Pad, Message]]:
    laid = [(pad, _places_in(pad), pad_outline(pad, 180)) for pad in pads]
    for a, b in combinations(laid, 2):
        if not _boxes_meet(a[2], b[2]):
            continue
        (small, places, _), (large, _, outline) = sorted((a, b), key=lambda one: len(one[1]))
        share = rounded(float(inside_curve(outline, places).mean()), SHOWN_SHARE)
        if share > rules.greatest_overlap_share:
            yield (
                small,
                Message(
                    "The {pad} lies with {share:.0%} on the {other_pad}, and their heights add up.",
                    pad=small.noun,
                    share=share,
                    other_pad=large.noun,
                ),
            )


def _boxes_meet(a: FloatArray, b: FloatArray) -> bool:
    return bool((a.min(axis=0) <= b.max(axis=0)).all() and (b.min(axis=0) <= a.max(axis=0)).all())


def _places_in(pad: PadForm) -> FloatArray:
    """Return points (n, 2) spread evenly over a pad, at least its apex."""
    outline = pad_outline(pad, 180)
    low, high = outline.min(axis=0), outline.max(axis=0)
    x, y = np.meshgrid(np.arange(low[0], high[0], _STEP_MM), np.arange(low[1], high[1], _STEP_MM))
    places = np.column_stack([x.ravel(), y.ravel()])
    inside = places[inside_curve(outline, places)]
    return inside if len(inside) else np.array([pad.centre_mm])
