"""Warnings about unusual insoles, by the clinic's limits, and about how the foot was scanned."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

import numpy as np

from insole_core.foot.contact_tilt import contact_tilt
from insole_core.foot.foot_placement import is_of_other_side
from insole_core.foot.landmarks import Landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.geometry.side import Side
from insole_core.insole.build import Insole
from insole_core.insole.clinic_rules import ClinicRules
from insole_core.insole.design_warning import DesignWarning
from insole_core.insole.elements import in_order
from insole_core.insole.judged import Judged
from insole_core.insole.outline.insole_outline import full_outline, insole_outline
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_totals import lift_profile_mm, posting_angles
from insole_core.insole.prescription.materials import MaterialTable, read_materials
from insole_core.insole.prescription.rim_sliders import designed_cup_mm
from insole_core.insole.warnings.finish_warnings import finish_warnings
from insole_core.insole.warnings.shell_warnings import shell_warnings
from insole_core.insole.warnings.shoe_warnings import shoe_warnings
from insole_core.messages import Message

_LEVEL_DEG = 1.5
"""Greatest usual tilt of a foot from heel to ball: some 4 mm over the length of an insole."""
_SHOWN_DEG = 0.1
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
_USUAL_CUP_MM = 12.0
_SHOWN_HEIGHT_MM = 1.0


def _scan_warnings(insole: Insole) -> Iterator[DesignWarning]:
    """Warn of a foot that is the other one or its mirror image, of an older scan, or not level."""
    foot = insole.foot
    if foot.scanned_on:
        yield DesignWarning(
            Message(
                "The scan of the {side} foot is that of the visit of {day}, used once more; scan "
                "the foot again if it has changed.",
                side=foot.side.other if foot.mirrored else foot.side,
                day=foot.scanned_on,
            )
        )
    if foot.mirrored:
        yield DesignWarning(
            Message(
                "The {side} foot was not scanned: foot and insole are mirrored from the {other} "
                "foot.",
                side=foot.side,
                other=foot.side.other,
            )
        )
    elif is_of_other_side(foot):
        yield DesignWarning(
            Message(
                "The {side} foot has the shape of a {other} one; check which foot was scanned, and "
                "if the side is wrong, open the scan again as the {other} foot.",
                side=foot.side,
                other=foot.side.other,
            )
        )
    yield from _tilt_warnings(insole)


def _tilt_warnings(insole: Insole) -> Iterator[DesignWarning]:
    """Warn of a foot that is not level, whose insole is thicker below heel or ball than asked.

    A base form replaces the foot's own heights, so that then there is nothing to warn of.
    """
    tilt = contact_tilt(insole.foot) if insole.design.base is None else None
    if tilt is None or abs(tilt.angle_deg) <= _LEVEL_DEG:
        return
    higher_mm = abs(tilt.heel_mm - tilt.ball_mm)
    angle_deg = rounded(abs(tilt.angle_deg), _SHOWN_DEG)
    if tilt.angle_deg > 0:
        yield DesignWarning(
            Message(
                "The foot is not level: the heel lies {higher_mm:.0f} mm higher than the ball "
                "({angle:g}°), and the insole is as much thicker below it; turn the foot toes up "
                "by {angle:g}°, or scan it again with heel and ball on one level.",
                higher_mm=higher_mm,
                angle=angle_deg,
            )
        )
    else:
        yield DesignWarning(
            Message(
                "The foot is not level: the ball lies {higher_mm:.0f} mm higher than the heel "
                "({angle:g}°), and the insole is as much thicker below it; turn the foot toes "
                "down by {angle:g}°, or scan it again with heel and ball on one level.",
                higher_mm=higher_mm,
                angle=angle_deg,
            )
        )


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
        Landmarks first, then the foot's pose, the corrections in the order in which they change an
        insole, height, grid, finish, shell, and shoe; at most one about landmarks.
    """
    design, table = insole.design, materials or read_materials()
    judged = _judged(insole, landmarks, rules)
    return (
        *islice(_of_landmarks(design.side, landmarks), 1),  # the first explains the others
        *_scan_warnings(insole),
        *(w for kind in in_order() for w in kind.rule(design.of(kind), judged)),
        *_of_height(judged),
        *_of_grid(design, rules),
        *finish_warnings(insole),
        *(() if design.shell is None else shell_warnings(insole, landmarks, table)),
        *shoe_warnings(insole, landmarks),
    )


def _judged(insole: Insole, landmarks: Landmarks, rules: ClinicRules) -> Judged:
    design, heights = insole.design, insole.contact.heights_mm
    cup_mm, least_mm = designed_cup_mm(design), design.least_thickness_mm
    return Judged(
        rules=rules,
        foot=insole.foot,
        landmarks=landmarks,
        surface=insole.contact,
        measured=insole.measured,
        thickness_mm=heights if design.bottom == "flat" else np.full_like(heights, least_mm),
        posted_deg=posting_angles(design),
        lifted_mm=lambda share: float(lift_profile_mm(design, np.array([share]))[0]),
        cup_mm=_USUAL_CUP_MM if cup_mm is None else cup_mm,
        outline_mm=lambda: _edge_mm(insole, landmarks),
    )


def _edge_mm(insole: Insole, landmarks: Landmarks) -> FloatArray:
    """Return the edge of the insole; what a trim line cuts off is told by the shell's warnings."""
    if insole.design.shell is not None:
        return full_outline(insole.foot, insole.design.outline)
    return insole_outline(insole.foot, insole.design, landmarks)


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


def _of_height(judged: Judged) -> Iterator[DesignWarning]:
    heights = np.where(judged.measured, judged.surface.heights_mm, -np.inf)
    height_mm = rounded(float(heights.max()), _SHOWN_HEIGHT_MM)
    usual_mm = judged.rules.greatest_insole_height_mm
    if height_mm > usual_mm:
        high = Message(
            "The insole is {height_mm:.0f} mm high and may not fit a shoe; up to {usual_mm:g} mm "
            "are usual.",
            height_mm=height_mm,
            usual_mm=usual_mm,
        )
        yield DesignWarning(high, place_mm=judged.place_of(heights))


def _of_grid(design: InsoleDesign, rules: ClinicRules) -> Iterator[DesignWarning]:
    if design.grid_mm > rules.greatest_grid_mm:
        coarse = Message(
            "The grid of {grid_mm:g} mm is too coarse for a smooth insole; up to {usual_mm:g} mm "
            "are usual.",
            grid_mm=design.grid_mm,
            usual_mm=rules.greatest_grid_mm,
        )
        yield DesignWarning(coarse)
