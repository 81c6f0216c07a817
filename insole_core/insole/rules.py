"""What a clinic wants to be warned of: the limits are data (resources/rules/rules.json)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from itertools import combinations
from pathlib import Path

import numpy as np

from insole_core.foot.landmarks import Landmarks
from insole_core.insole.build import Insole
from insole_core.insole.clearance import clearance
from insole_core.insole.design import HeelCup, HeelLift, HeelSkive, InsoleDesign, Pelott, Place
from insole_core.insole.outline_curve import inside_curve
from insole_core.insole.pads import pad_outline
from insole_core.insole.posting import posting_angles
from insole_core.insole.pronation import PronationStep
from insole_core.json_object import JsonObject
from insole_core.resources import resource_path

_AT_HEADS = ("egg", "bar")
"""Shapes that end behind the metatarsal heads."""
_USUAL_CUP_MM = 12.0
_STEP_MM = 2.0


@dataclass(frozen=True, kw_only=True)
class Rules:
    """Limits of the warnings, and what a pronation suggests; lengths in mm, angles in degrees."""

    post_unusual_deg: float
    skive_least_cup_mm: float
    skive_and_inversion_limit: float
    skive_and_inversion_cup_mm: float
    greatest_insole_height_mm: float
    greatest_heel_lift_mm: float
    pelott_least_behind_heads_mm: float
    pelott_greatest_behind_heads_mm: float
    pelott_usual_behind_heads_mm: float
    least_on_foot_share: float
    greatest_overlap_share: float
    pronation: tuple[PronationStep, ...] = ()


@dataclass(frozen=True)
class DesignWarning:
    """Something that can be built and is unusual.

    Parameters
    ----------
    text
        One sentence with the number.
    correction_id
        The correction that causes it; empty where it is the whole.
    place_mm
        Where to look, insole frame.
    """

    text: str
    correction_id: str = ""
    place_mm: Place | None = None


def load_rules(path: Path | None = None) -> Rules:
    """Read the rules of the clinic, or those that come with the product.

    Raises
    ------
    InputError
        When the file breaks its format.
    """
    path = path or resource_path("rules/rules.json")
    content = JsonObject.parse(path.name, path.read_bytes())
    content.choice("format", ["insole-rules"])
    content.integer("version", 1, 1)
    rules = content.object("rules")
    limits = [f.name for f in fields(Rules) if f.name != "pronation"]
    return Rules(
        **{name: rules.number(name, 0, 1000) for name in limits},
        pronation=tuple(
            PronationStep(step.number("from_deg", 0, 90), step.number("post_deg", 0, 15))
            for step in (content.objects("pronation") if content.has("pronation") else ())
        ),
    )


def design_warnings(
    insole: Insole, landmarks: Landmarks, rules: Rules
) -> tuple[DesignWarning, ...]:
    """Hold an insole against the rules."""
    design = insole.design
    pads = [c for c in design.active if isinstance(c, Pelott)]
    return (
        *_of_posting(design, rules),
        *_of_heel(design, rules),
        *_of_height(insole, rules),
        *(w for pad in pads for w in _of_pad(insole, landmarks, pad, rules)),
        *_of_overlaps(pads, rules),
    )


def behind_heads_mm(pad: Pelott, landmarks: Landmarks) -> float:
    """Distance of a pad's front edge behind the line of the heads 2 to 4; < 0 before it.

    Snapping a pad means to move it ahead by what this exceeds the wanted distance.
    """
    line = np.array([landmarks[f"metatarsal_head_{n}"].point[:2] for n in (2, 3, 4)])
    return clearance(pad, line).distance_mm


def _of_posting(design: InsoleDesign, rules: Rules) -> Iterator[DesignWarning]:
    for part, angle in zip(("rearfoot", "forefoot"), posting_angles(design), strict=True):
        if abs(angle) > rules.post_unusual_deg:
            yield DesignWarning(
                f"The {part} is posted by {angle:g}°; more than {rules.post_unusual_deg:g}° is"
                " unusual."
            )


def _of_heel(design: InsoleDesign, rules: Rules) -> Iterator[DesignWarning]:
    cups = [c.depth_mm for c in design.active if isinstance(c, HeelCup)]
    cup = min(cups, default=_USUAL_CUP_MM)
    inversion = max(posting_angles(design)[0], 0.0)
    for c in design.active:
        if isinstance(c, HeelLift) and c.height_mm > rules.greatest_heel_lift_mm:
            yield DesignWarning(
                f"The heel is lifted by {c.height_mm:g} mm; on the device up to"
                f" {rules.greatest_heel_lift_mm:g} mm are usual.",
                c.id,
            )
        if not isinstance(c, HeelSkive):
            continue
        both = c.depth_mm + inversion
        deep = both > rules.skive_and_inversion_limit
        needed = rules.skive_and_inversion_cup_mm if deep else rules.skive_least_cup_mm
        if cup < needed:
            yield DesignWarning(
                f"A skive of {c.depth_mm:g} mm with {inversion:g}° of inversion needs a heel cup of"
                f" {needed:g} mm, and the cup is {cup:g} mm deep.",
                c.id,
            )


def _of_height(insole: Insole, rules: Rules) -> Iterator[DesignWarning]:
    heights = np.where(insole.measured, insole.contact.heights_mm, -np.inf)
    row, column = np.unravel_index(heights.argmax(), heights.shape)
    if heights[row, column] > rules.greatest_insole_height_mm:
        place = float(insole.contact.x_mm[column]), float(insole.contact.y_mm[row])
        yield DesignWarning(
            f"The insole is {heights[row, column]:.0f} mm high and may not fit a shoe; up to"
            f" {rules.greatest_insole_height_mm:g} mm are usual.",
            place_mm=place,
        )


def _of_pad(
    insole: Insole, landmarks: Landmarks, pad: Pelott, rules: Rules
) -> Iterator[DesignWarning]:
    name = pad.shape.replace("_", " ")
    share = _share_on_foot(insole, pad)
    if share < rules.least_on_foot_share:
        yield DesignWarning(
            f"Only {share:.0%} of the {name} lie below the foot; move it inwards.",
            pad.id,
            pad.centre_mm,
        )
    if pad.shape not in _AT_HEADS or pad.height_mm <= 0:
        return
    behind = behind_heads_mm(pad, landmarks)
    least, most = rules.pelott_least_behind_heads_mm, rules.pelott_greatest_behind_heads_mm
    if not least <= behind <= most:
        where = f"{behind:.0f} mm behind" if behind >= 0 else f"{-behind:.0f} mm before"
        yield DesignWarning(
            f"The front edge of the {name} lies {where} the line of the heads 2 to 4;"
            f" {least:g} to {most:g} mm behind it are usual.",
            pad.id,
            pad.centre_mm,
        )


def _share_on_foot(insole: Insole, pad: Pelott) -> float:
    places = _places_in(pad)
    field = insole.contact
    column, row = np.rint((places - [field.x0_mm, field.y0_mm]) / field.step_mm).astype(int).T
    rows, columns = insole.measured.shape
    inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
    return float(insole.measured[row[inside], column[inside]].sum() / len(places))


def _of_overlaps(pads: list[Pelott], rules: Rules) -> Iterator[DesignWarning]:
    places = {pad.id: _places_in(pad) for pad in pads}
    for a, b in combinations(pads, 2):
        small, large = sorted((a, b), key=lambda pad: len(places[pad.id]))
        share = float(inside_curve(pad_outline(large, 180), places[small.id]).mean())
        if share > rules.greatest_overlap_share:
            yield DesignWarning(
                f"The {small.shape.replace('_', ' ')} lies with {share:.0%} on the"
                f" {large.shape.replace('_', ' ')}, and their heights add up.",
                small.id,
                small.centre_mm,
            )


def _places_in(pad: Pelott) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """Places (n, 2) spread evenly over a pad, at least its apex."""
    outline = pad_outline(pad, 180)
    low, high = outline.min(axis=0), outline.max(axis=0)
    x, y = np.meshgrid(np.arange(low[0], high[0], _STEP_MM), np.arange(low[1], high[1], _STEP_MM))
    places = np.column_stack([x.ravel(), y.ravel()])
    inside = places[inside_curve(outline, places)]
    return inside if len(inside) else np.array([pad.centre_mm])
