"""Warnings about unusual insoles, by the clinic's limits (resources/rules/rules.json)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from itertools import combinations, islice
from pathlib import Path

import numpy as np

from insole_core.foot.landmarks import HEADS, Landmarks, find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.geometry.side import Side
from insole_core.insole.build import Insole
from insole_core.insole.elements import (
    ArchRaise,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
    Rocker,
)
from insole_core.insole.pads.clearance import behind_heads_mm
from insole_core.insole.pads.pad_heights import pad_outline
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.lifts import heel_lift_mm
from insole_core.insole.prescription.materials import MaterialTable, read_materials
from insole_core.insole.prescription.posting_angles import posting_angles
from insole_core.insole.prescription.pronation import PronationStep
from insole_core.insole.prescription.rim_sliders import cup_depth_mm, finish_with_cups
from insole_core.insole.primitives.outline_curve import inside_curve
from insole_core.insole.surface.rocker import LEAST_LEFT_MM, rocker_heights_mm
from insole_core.insole.warnings.design_warning import DesignWarning
from insole_core.insole.warnings.finish_warnings import finish_warnings
from insole_core.insole.warnings.scan_warnings import scan_warnings
from insole_core.insole.warnings.shell_warnings import shell_warnings
from insole_core.insole.warnings.shoe_warnings import shoe_warnings
from insole_core.json_object import JsonObject
from insole_core.messages import Message, Value
from insole_core.resources import resource_path

_WORDS = {
    "pternion": "rearmost point",
    "heel_centre": "heel centre",
    "metatarsal_head_1": "1st head",
    "metatarsal_head_2": "2nd head",
    "metatarsal_head_5": "5th head",
    "toe_tip_1": "1st toe",
    "toe_tip_2": "2nd toe",
}
"""Display names of landmarks whose identifier says too little."""
_ALONG = (
    ("pternion", "heel_centre"), ("heel_centre", "metatarsal_head_1"),
    ("heel_centre", "metatarsal_head_2"), ("heel_centre", "metatarsal_head_5"),
    ("metatarsal_head_1", "toe_tip_1"), ("metatarsal_head_2", "toe_tip_2"),
)  # fmt: skip
"""Pairs of landmarks of which the second lies nearer to the toes on every foot."""
_ACROSS = (
    ("metatarsal_head_1", "metatarsal_head_5"), ("metatarsal_head_1", "metatarsal_head_2"),
    ("metatarsal_head_2", "metatarsal_head_5"),
)  # fmt: skip
"""Pairs of landmarks of which the second lies lateral to the first."""
_POSTED = (
    "The rearfoot is posted by {angle:g}° {edge}; more than {usual:g}° is unusual.",
    "The forefoot is posted by {angle:g}° {edge}; more than {usual:g}° is unusual.",
)
_USUAL_CUP_MM = 12.0
_FARTHEST_AHEAD_MM = 50.0
_AT_LINE = ("egg", "bar")
"""Shapes whose distance behind the heads is the clinic's rule; a drop may lie between the heads."""
_ARCH_TOLERANCE_MM = 0.2
_ROCKER_TOLERANCE_MM = 0.5
_SHOWN = 0.1
"""Step in mm and degrees to which values are rounded, before they are compared and printed."""
_SHOWN_HEIGHT_MM = 1.0
_SHOWN_SHARE = 0.01
_STEP_MM = 2.0
_MOST_OVERLAPS = (
    10  # of which is warned: where very many pads lie on each other, no more are sought
)


@dataclass(frozen=True, kw_only=True)
class ClinicRules:
    """Limits of the warnings, and the suggested posting by pronation; mm and degrees.

    The distances behind the heads are < 0 for pads that end ahead of them: trials disagree on where
    a pad works best, so that the place is the clinic's own rule.
    """

    post_unusual_deg: float
    skive_least_cup_mm: float
    skive_and_inversion_limit: float
    skive_and_inversion_cup_mm: float
    greatest_insole_height_mm: float
    greatest_heel_lift_mm: float
    pelott_least_behind_heads_mm: float
    pelott_greatest_behind_heads_mm: float
    pelott_usual_behind_heads_mm: float
    greatest_metatarsal_pad_height_mm: float
    greatest_recess_depth_mm: float
    least_beside_first_head_mm: float
    least_on_foot_share: float
    greatest_overlap_share: float
    greatest_grid_mm: float
    pronation: tuple[PronationStep, ...] = ()


def load_rules(path: Path | None = None) -> ClinicRules:
    """Read the clinic's rules, by default those shipped with the product.

    Raises
    ------
    InputError
        If the file cannot be read or breaks its format.
    """
    content = JsonObject.read(path or resource_path("rules/rules.json"))
    content.check_format("insole-rules")
    rules = content.object("rules")
    limits = [f.name for f in fields(ClinicRules) if f.name != "pronation"]
    return ClinicRules(
        **{name: rules.number(name, _least(name), 1000) for name in limits},
        pronation=tuple(
            PronationStep(step.number("from_deg", 0, 90), step.number("post_deg", 0, 15))
            for step in (content.objects("pronation") if content.has("pronation") else ())
        ),
    )


def _least(limit: str) -> float:
    """Return the least value of a limit."""
    return -_FARTHEST_AHEAD_MM if limit.endswith("_behind_heads_mm") else 0.0


def design_warnings(
    insole: Insole,
    landmarks: Landmarks,
    rules: ClinicRules,
    materials: MaterialTable | None = None,
) -> tuple[DesignWarning, ...]:
    """Check an insole against the clinic's rules.

    Parameters
    ----------
    materials
        By default those of the product.

    Returns
    -------
    tuple of DesignWarning
        Landmarks first, then the foot's pose, posting, heel, height, grid, finish, arch, pads,
        shell, and shoe; at most one about landmarks.
    """
    design, table = insole.design, materials or read_materials()
    pads, arches = design.of(Pelott), design.of(ArchRaise)
    return (
        *islice(_of_landmarks(design.side, landmarks), 1),  # the first explains the others
        *scan_warnings(insole),
        *_of_posting(design, rules),
        *_of_heel(design, rules),
        *_of_height(insole, rules),
        *_of_grid(design, rules),
        *finish_warnings(insole),
        *(w for arch in arches for w in _of_arch(insole, arch)),
        *_of_rocker(insole),
        *(w for pad in pads for w in _of_pad(insole, landmarks, pad, rules)),
        *islice(_of_overlaps(pads, rules), _MOST_OVERLAPS),
        *(() if design.shell is None else shell_warnings(insole, landmarks, table)),
        *shoe_warnings(insole, landmarks),
    )


def _words(name: str) -> str:
    return _WORDS.get(name, name)


def _of_landmarks(side: Side, landmarks: Landmarks) -> Iterator[DesignWarning]:
    """Warn of landmarks in an order that no foot has: everything else depends on them."""
    toes, lateral = np.array([0.0, 1.0]), np.array([-side.medial_sign, 0.0])
    for pairs, towards in ((_ALONG, toes), (_ACROSS, lateral)):
        for first, second in pairs:
            if not {first, second} <= landmarks.keys():
                continue
            a, b = landmarks[first], landmarks[second]
            if (b.point[:2] - a.point[:2]) @ towards < 0:
                x, y = (b if b.origin == "hand" else a).point[:2]
                disorder = Message(
                    "The landmarks {landmark} and {other_landmark} stand in an order that no foot "
                    "has; drag them to where they belong.",
                    landmark=_words(first),
                    other_landmark=_words(second),
                )
                yield DesignWarning(disorder, place_mm=(float(x), float(y)))


def _of_posting(design: InsoleDesign, rules: ClinicRules) -> Iterator[DesignWarning]:
    usual = rules.post_unusual_deg
    cause = next((posting.id for posting in design.of(Posting)), "")
    for posted, angle_deg in zip(_POSTED, posting_angles(design), strict=True):
        angle = rounded(angle_deg, _SHOWN)
        if abs(angle) > usual:
            sentence = Message(posted, angle=abs(angle), edge=_edge(angle), usual=usual)
            yield DesignWarning(sentence, cause)


def _edge(angle_deg: float) -> str:
    """Return which edge a posting raises."""
    return "medially" if angle_deg > 0 else "laterally"


def _of_heel(design: InsoleDesign, rules: ClinicRules) -> Iterator[DesignWarning]:
    cup = _cup_mm(design)
    inversion = max(rounded(posting_angles(design)[0], _SHOWN), 0.0)
    lifts = design.of(HeelLift)  # alone, a full-length lift is what a greater height is made by
    lift_mm = rounded(heel_lift_mm(design), _SHOWN)
    if lifts and lift_mm > rules.greatest_heel_lift_mm:
        lifted = Message(
            "The heel is lifted by {height_mm:g} mm; on the device up to {usual_mm:g} mm are "
            "usual.",
            height_mm=lift_mm,
            usual_mm=rules.greatest_heel_lift_mm,
        )
        yield DesignWarning(lifted, lifts[-1].id)
    for c in design.of(HeelSkive):
        both = rounded(c.depth_mm + inversion, _SHOWN)
        deep = both > rules.skive_and_inversion_limit
        needed = rules.skive_and_inversion_cup_mm if deep else rules.skive_least_cup_mm
        if cup < needed:
            shallow = Message(
                "A skive of {depth_mm:g} mm with {angle:g}° of inversion needs a heel cup of "
                "{needed_mm:g} mm, and the cup is {cup_mm:g} mm deep.",
                depth_mm=c.depth_mm,
                angle=inversion,
                needed_mm=needed,
                cup_mm=cup,
            )
            yield DesignWarning(shallow, c.id)


def _cup_mm(design: InsoleDesign) -> float:
    """Return the depth of the heel cup: that of the designed rim, or of the corrections."""
    if design.finish is not None:
        rim = cup_depth_mm(finish_with_cups(design.finish, design.of(HeelCup)))
        return _USUAL_CUP_MM if rim is None else rim
    return min((cup.depth_mm for cup in design.of(HeelCup)), default=_USUAL_CUP_MM)


def _of_height(insole: Insole, rules: ClinicRules) -> Iterator[DesignWarning]:
    heights = np.where(insole.measured, insole.contact.heights_mm, -np.inf)
    row, column = np.unravel_index(heights.argmax(), heights.shape)
    height_mm = rounded(float(heights[row, column]), _SHOWN_HEIGHT_MM)
    if height_mm > rules.greatest_insole_height_mm:
        place = float(insole.contact.x_mm[column]), float(insole.contact.y_mm[row])
        high = Message(
            "The insole is {height_mm:.0f} mm high and may not fit a shoe; up to {usual_mm:g} mm "
            "are usual.",
            height_mm=height_mm,
            usual_mm=rules.greatest_insole_height_mm,
        )
        yield DesignWarning(high, place_mm=place)


def _of_grid(design: InsoleDesign, rules: ClinicRules) -> Iterator[DesignWarning]:
    if design.grid_mm > rules.greatest_grid_mm:
        coarse = Message(
            "The grid of {grid_mm:g} mm is too coarse for a smooth insole; up to {usual_mm:g} mm "
            "are usual.",
            grid_mm=design.grid_mm,
            usual_mm=rules.greatest_grid_mm,
        )
        yield DesignWarning(coarse)


def _of_pad(
    insole: Insole, landmarks: Landmarks, pad: Pelott, rules: ClinicRules
) -> Iterator[DesignWarning]:
    share = rounded(_share_on_foot(insole, pad), _SHOWN_SHARE)
    if share < rules.least_on_foot_share and not pad.is_filler:
        beside = Message(
            "Only {share:.0%} of the {pad} lie below the foot; move it inwards.",
            share=share,
            pad=pad.noun,
        )
        yield DesignWarning(beside, pad.id, pad.centre_mm)
    yield from _of_recess(pad, rules)
    if pad.leaves_first_head_free:
        yield from _of_first_head(pad, landmarks, rules)
    if pad.ends_behind_heads and pad.height_mm > 0:
        yield from _of_metatarsal_pad(pad, landmarks, rules)


def _of_recess(pad: Pelott, rules: ClinicRules) -> Iterator[DesignWarning]:
    if -pad.height_mm > rules.greatest_recess_depth_mm:
        deep = Message(
            "The {pad} is {depth_mm:g} mm deep; up to {usual_mm:g} mm are usual.",
            pad=pad.noun,
            depth_mm=rounded(-pad.height_mm, _SHOWN),
            usual_mm=rules.greatest_recess_depth_mm,
        )
        yield DesignWarning(deep, pad.id, pad.centre_mm)


def _of_first_head(
    pad: Pelott, landmarks: Landmarks, rules: ClinicRules
) -> Iterator[DesignWarning]:
    head = landmarks[HEADS[0]].point[:2]
    outline = pad_outline(pad)
    away_mm = float(np.hypot(*(outline - head).T).min())
    away_mm = 0.0 if inside_curve(outline, head) else rounded(away_mm, _SHOWN)
    if away_mm < rules.least_beside_first_head_mm:
        near = Message(
            "The {pad} comes within {distance_mm:g} mm of the 1st head, which it leaves free; keep "
            "it at least {least_mm:g} mm away.",
            pad=pad.noun,
            distance_mm=away_mm,
            least_mm=rules.least_beside_first_head_mm,
        )
        yield DesignWarning(near, pad.id, pad.centre_mm)


def _of_metatarsal_pad(
    pad: Pelott, landmarks: Landmarks, rules: ClinicRules
) -> Iterator[DesignWarning]:
    if pad.height_mm > rules.greatest_metatarsal_pad_height_mm:
        high = Message(
            "The {pad} is {height_mm:g} mm high; up to {usual_mm:g} mm are usual.",
            pad=pad.noun,
            height_mm=rounded(pad.height_mm, _SHOWN),
            usual_mm=rules.greatest_metatarsal_pad_height_mm,
        )
        yield DesignWarning(high, pad.id, pad.centre_mm)
    if pad.shape not in _AT_LINE:
        return
    behind = rounded(behind_heads_mm(pad, landmarks), _SHOWN)
    least, most = rules.pelott_least_behind_heads_mm, rules.pelott_greatest_behind_heads_mm
    if not least <= behind <= most:
        values: dict[str, Value] = {
            "pad": pad.noun,
            "distance_mm": abs(behind),
            "least_mm": least,
            "most_mm": most,
        }
        away = (
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
        yield DesignWarning(away, pad.id, pad.centre_mm)


def _of_rocker(insole: Insole) -> Iterator[DesignWarning]:
    """Warn of a rocker for which the forefoot is not thick enough."""
    design = insole.design
    rockers = design.of(Rocker)
    if not rockers:
        return
    flat = design.bottom == "flat"
    thickness = insole.contact.heights_mm if flat else design.least_thickness_mm
    asked = rocker_heights_mm(design, insole.foot, insole.contact)
    missing = np.where(insole.measured, asked - (thickness - LEAST_LEFT_MM), 0.0)
    missing_mm = rounded(float(missing.max()), _SHOWN)
    if missing_mm > _ROCKER_TOLERANCE_MM:
        row, column = np.unravel_index(missing.argmax(), missing.shape)
        thin = Message(
            "The forefoot is {missing_mm:g} mm too thin for the rocker, which leaves {least_mm:g} "
            "mm of material; raise the thickness or lower the slope.",
            missing_mm=missing_mm,
            least_mm=LEAST_LEFT_MM,
        )
        place = float(insole.contact.x_mm[column]), float(insole.contact.y_mm[row])
        yield DesignWarning(thin, rockers[0].id, place)


def _of_arch(insole: Insole, arch: ArchRaise) -> Iterator[DesignWarning]:
    """Warn where the finished arch is not as high as prescribed."""
    if arch.target_mm is None:
        return
    x, y = arch.apex_mm or find_landmarks(insole.foot)["arch_apex"].point[:2]
    place = float(x), float(y)
    finished_mm = float(insole.contact.height_at(np.array(place)))
    if not np.isfinite(finished_mm):
        beside = Message("The arch is to be raised beside the insole; move its place inwards.")
        yield DesignWarning(beside, arch.id, place)
        return
    height_mm = rounded(finished_mm, _SHOWN)
    values: dict[str, Value] = {"height_mm": height_mm, "target_mm": arch.target_mm}
    if height_mm - arch.target_mm > _ARCH_TOLERANCE_MM:
        above = Message(
            "The arch is {height_mm:g} mm high where {target_mm:g} mm are prescribed, and an arch "
            "raise lowers nothing; prescribe a greater height, or lower the surface there.",
            **values,
        )
        yield DesignWarning(above, arch.id, place)
    elif arch.target_mm - height_mm > _ARCH_TOLERANCE_MM:
        below = Message(
            "The arch is only {height_mm:g} mm high where {target_mm:g} mm are prescribed; a "
            "recess or a stroke lowers it there.",
            **values,
        )
        yield DesignWarning(below, arch.id, place)


def _share_on_foot(insole: Insole, pad: Pelott) -> float:
    places = _places_in(pad)
    field = insole.contact
    column, row = np.rint((places - [field.x0_mm, field.y0_mm]) / field.step_mm).astype(int).T
    rows, columns = insole.measured.shape
    inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
    return float(insole.measured[row[inside], column[inside]].sum() / len(places))


def _of_overlaps(pads: Sequence[Pelott], rules: ClinicRules) -> Iterator[DesignWarning]:
    places = {pad.id: _places_in(pad) for pad in pads}
    outlines = {pad.id: pad_outline(pad, 180) for pad in pads}
    for a, b in combinations(pads, 2):
        if not _boxes_meet(outlines[a.id], outlines[b.id]):
            continue
        small, large = sorted((a, b), key=lambda pad: len(places[pad.id]))
        covered = inside_curve(outlines[large.id], places[small.id])
        share = rounded(float(covered.mean()), _SHOWN_SHARE)
        if share > rules.greatest_overlap_share:
            overlap = Message(
                "The {pad} lies with {share:.0%} on the {other_pad}, and their heights add up.",
                pad=small.noun,
                share=share,
                other_pad=large.noun,
            )
            yield DesignWarning(overlap, small.id, small.centre_mm)


def _boxes_meet(a: FloatArray, b: FloatArray) -> bool:
    return bool((a.min(axis=0) <= b.max(axis=0)).all() and (b.min(axis=0) <= a.max(axis=0)).all())


def _places_in(pad: Pelott) -> FloatArray:
    """Return points (n, 2) spread evenly over a pad, at least its apex."""
    outline = pad_outline(pad, 180)
    low, high = outline.min(axis=0), outline.max(axis=0)
    x, y = np.meshgrid(np.arange(low[0], high[0], _STEP_MM), np.arange(low[1], high[1], _STEP_MM))
    places = np.column_stack([x.ravel(), y.ravel()])
    inside = places[inside_curve(outline, places)]
    return inside if len(inside) else np.array([pad.centre_mm])
