"""Permitted values of a design: one table for files, spin boxes and the builder.

The ranges are wide, what devices and workshops can do; what is usual or advisable is a matter of
the clinic's own rules (`insole_core.insole.warnings.clinic_rules`).
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, fields, replace
from itertools import pairwise
from typing import Any

import numpy as np

from insole_core.errors import DesignError
from insole_core.geometry.side import Side
from insole_core.insole.elements import (
    ArchRaise,
    BrushStroke,
    Correction,
    ForefootTwist,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
    Rocker,
)
from insole_core.insole.pads.pad_shapes import FREE, PAD_SHAPES, encloses_centre
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.item_name import checked_name
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Post, Shell
from insole_core.insole.prescription.shoe import Shoe
from insole_core.insole.primitives.outline_curve import closed_curve, crosses_itself
from insole_core.messages import Message


@dataclass(frozen=True)
class Range:
    """Least and greatest value, both allowed, and the unit ("" for a plain number)."""

    least: float
    greatest: float
    unit: str = "mm"

    def __contains__(self, value: float) -> bool:
        return math.isfinite(value) and self.least <= value <= self.greatest

    def __str__(self) -> str:
        least, most = self.least, self.greatest
        if not self.unit:
            return Message("{least:g} to {most:g}", least=least, most=most)
        return Message("{least:g} to {most:g} {unit}", least=least, most=most, unit=self.unit)


_PLACE = Range(-400, 400)
_SHARE = Range(0, 1, "")
_ANGLE = Range(-15, 15, "degrees")

DESIGN_RANGES = {
    "thickness_mm": Range(0.5, 40),
    "grid_mm": Range(0.25, 5),
    "max_height_mm": Range(5, 45),
    "margin_mm": Range(0, 50),
}
OUTLINE_RANGES = {
    "toe_allowance_mm": Range(-20, 30),
    "ball_allowance_mm": Range(-20, 20),
    "heel_allowance_mm": Range(-20, 20),
    "shoe_size_eu": Range(16, 52, ""),
    "points_mm": _PLACE,
    "width_mm": Range(-20, 20),
}
SHOE_RANGES = {"inside_mm": _PLACE, "clearance_mm": Range(0, 5)}
SHOE_LENGTH = Range(80, 400)
LAYER_RANGES = {"cover_mm": Range(0, 5), "shell_mm": Range(0, 10), "base_mm": Range(0, 10)}
FINISH_RANGES = {
    "expansion_mm": Range(0, 5),
    "arch_fill_mm": Range(0, 15),
    "skin_smoothing_mm": Range(0, 6),
    "toe_line_mm": Range(0, 40),
    "heel_blend_mm": Range(4, 25),
    "arch_blend_mm": Range(4, 25),
    "forefoot_blend_mm": Range(4, 25),
}
BASE_RANGES = {"contact_share": Range(0, 1, "")}
FORM_RANGES = {
    "length_mm": Range(80, 400),
    "ball_width_mm": Range(30, 160),
    "along_shares": Range(-0.5, 1.5, ""),
    "across_shares": Range(-1, 2, ""),
    "heights_mm": Range(-60, 60),
}
RIM_RANGES = {"along": Range(0, 1, ""), "height_mm": Range(-10, 45)}
SHELL_RANGES = {
    "body_weight_kg": Range(5, 250, "kg"),
    "least_mm": Range(0.5, 40),
    "least_edge_mm": Range(0.5, 40),
    "taper_mm": Range(0.5, 10),
    "taper_length_mm": Range(5, 60),
    "edge_radius_mm": Range(0, 5),
    "draft_medial_deg": Range(-15, 30, "degrees"),
    "draft_lateral_deg": Range(-15, 30, "degrees"),
    "chamfer_mm": Range(0, 10),
    "heel_pitch_mm": Range(0, 30),
    "trim_mm": _PLACE,
}
POST_RANGES = {
    "angle_deg": _ANGLE,
    "length_mm": Range(15, 120),
    "edge_radius_mm": Range(0, 10),
}
CORRECTION_RANGES: dict[type[Correction], dict[str, Range]] = {
    Pelott: {
        "centre_mm": _PLACE,
        "length_mm": Range(5, 200),
        "width_mm": Range(5, 150),
        "height_mm": Range(-20, 20),
        "turn_deg": Range(-360, 360, "degrees"),
        "egg_ratio": _SHARE,
        "sigma_mm": Range(1, 400),
        "blend_mm": Range(0.5, 100),
        "outline_mm": Range(-200, 200),
    },
    Posting: {
        "rearfoot_deg": _ANGLE,
        "forefoot_deg": _ANGLE,
        "blend_start": _SHARE,
        "blend_end": _SHARE,
    },
    ForefootTwist: {"angle_deg": _ANGLE, "blend_start": _SHARE, "blend_end": _SHARE},
    HeelSkive: {"depth_mm": Range(0.5, 8), "slope_deg": Range(5, 30, "degrees")},
    HeelLift: {"height_mm": Range(-10, 20), "fade_start": _SHARE, "fade_end": _SHARE},
    ArchRaise: {
        "height_mm": Range(-20, 20),
        "target_mm": Range(0, 60),
        "apex_mm": _PLACE,
        "length_mm": Range(20, 200),
        "width_mm": Range(10, 150),
    },
    HeelCup: {"depth_mm": Range(0, 30), "fade_start": _SHARE, "fade_end": _SHARE},
    Rocker: {"behind_heads_mm": Range(-20, 40), "slope_deg": Range(0, 25, "degrees")},
    BrushStroke: {
        "points_mm": _PLACE,
        "radius_mm": Range(2, 80),
        "strength": Range(0, 10, ""),
    },
}
PELOTT_SHAPES = PAD_SHAPES
CHOICES: dict[type[Any], dict[str, tuple[str, ...]]] = {
    InsoleDesign: {"bottom": ("flat", "following")},
    Outline: {"source": ("foot", "shoe_size", "drawn"), "extent": ("full", "three_quarter")},
    Finish: {"toe_zone": ("flat", "sulcus", "crest", "as_scanned")},
    RimStation: {"border": ("medial", "lateral"), "over": ("heel", "toes", "foot")},
    Post: {"region": ("rearfoot", "forefoot")},
    Pelott: {"shape": PAD_SHAPES},
    Posting: {"method": ("extrinsic", "intrinsic")},
    HeelSkive: {"border": ("medial", "lateral")},
    BrushStroke: {"mode": ("push", "pull", "smooth")},
}
POINT_COUNTS = {
    "inside_mm": (12, 400),
    "outline_mm": (3, 400),
    "points_mm": (1, 2000),
    "trim_mm": (2, 60),
}
"""Least and greatest number of points in a list of them."""
LEAST_DRAWN_POINTS = 4
LONGEST_KIND = 60
"""Most letters in the kind of a pad."""
LEAST_STATIONS, MOST_FORM_STATIONS = 4, 400
"""Numbers of stations of a form along and across the foot; a cubic needs four."""
LEAST_TRIM_STEP_MM = 1.0
"""By which each point of a trim line lies farther lateral than the one before."""
MOST_STATIONS = 40
LEAST_ZONE = 0.05
"""Least share of the length over which a correction fades."""
MOST_SMOOTHING = 1.0
_ROUNDING = 1e-9
_CURVE_STRIDE = 4  # every fourth point of the curve shows whether it crosses itself


def range_beside(part: Any, key: str, allowed: Range) -> Range:
    """Narrow the range of a value by the other values of its part.

    A zone starts before it ends, and smoothing strength is at most 1.

    Parameters
    ----------
    part
        The correction, outline or layers that hold the value.
    key
        Name of the field.
    allowed
        The field's range in the tables above.
    """
    zone, _, place = key.rpartition("_")
    if zone in ("blend", "fade") and place == "start":
        most = getattr(part, f"{zone}_end") - LEAST_ZONE
        return replace(allowed, greatest=min(allowed.greatest, most))
    if zone in ("blend", "fade") and place == "end":
        least = getattr(part, f"{zone}_start") + LEAST_ZONE
        return replace(allowed, least=max(allowed.least, least))
    if key == "strength" and part.mode == "smooth":
        return replace(allowed, greatest=MOST_SMOOTHING)
    return allowed


def check_design(design: InsoleDesign) -> None:
    """Check that all values of a design are in range and its corrections consistent.

    Raises
    ------
    DesignError
        Naming the key, the value, and what is allowed.
    """
    _check(design, DESIGN_RANGES, "")
    _check(design.outline, OUTLINE_RANGES, " of outline")
    _check(design.layers, LAYER_RANGES, " of layers")
    _check_outline(design.outline)
    _check_base(design.base)
    _check_finish(design.finish)
    _check_shell(design)
    for number, correction in enumerate(design.corrections):
        where = Message(" of corrections[{number}] ({type})", number=number, type=correction.type)
        _check(correction, CORRECTION_RANGES[type(correction)], where)
        _check_zone(correction, where)
        if isinstance(correction, Pelott):
            _check_pad(correction, where)
        if isinstance(correction, BrushStroke) and correction.mode == "smooth":
            _check_smoothing(correction, where)
    ids = [c.id for c in design.corrections]
    if len(set(ids)) < len(ids):
        twice = next(i for i in ids if ids.count(i) > 1)
        raise DesignError('two corrections have the id "{twice}"; give each its own.', twice=twice)


def _check(value: Any, ranges: dict[str, Range], where: str) -> None:
    for key in (f.name for f in fields(value) if f.name in ranges):
        for number in _numbers(getattr(value, key)):
            if number not in ranges[key]:
                raise DesignError(
                    "{key}{where} is {value:g}, and must be {range}; put in a value of that range.",
                    key=key,
                    where=where,
                    value=number,
                    range=str(ranges[key]),
                )
    for key, words in CHOICES.get(type(value), {}).items():
        if getattr(value, key) not in words:
            allowed = ", ".join(f'"{word}"' for word in words)
            raise DesignError(
                '{key}{where} is "{value}", and must be {allowed}.',
                key=key,
                where=where,
                value=getattr(value, key),
                allowed=allowed,
            )
    for key in (f.name for f in fields(value) if f.name in POINT_COUNTS):
        _check_count(key, getattr(value, key), where)


def _numbers(content: Any) -> list[float]:
    """Return all numbers in a number, a point, a list of points, or None."""
    if isinstance(content, tuple):
        return [number for part in content for number in _numbers(part)]
    return [] if content is None else [content]


def _check_count(key: str, points: tuple[Any, ...] | None, where: str) -> None:
    least, greatest = POINT_COUNTS[key]
    if points is not None and not least <= len(points) <= greatest:
        raise DesignError(
            "{key}{where} has {count} places, and must have {least} to {most}; draw it again.",
            key=key,
            where=where,
            count=len(points),
            least=least,
            most=greatest,
        )


def _check_base(base: BaseForm | None) -> None:
    if base is not None:
        _check(base, BASE_RANGES, " of base")
        check_form(base.form)


def check_form(form: Form) -> None:
    """Check that a form has ordered stations, a height for each, and values in range.

    Raises
    ------
    DesignError
        Naming the key, the value, and what is allowed.
    """
    _check(form, FORM_RANGES, " of form")
    for key in ("along_shares", "across_shares"):
        shares = getattr(form, key)
        if not LEAST_STATIONS <= len(shares) <= MOST_FORM_STATIONS:
            raise DesignError(
                "{key} of form has {count} stations, and must have {least} to {most}; add or "
                "remove some.",
                key=key,
                count=len(shares),
                least=LEAST_STATIONS,
                most=MOST_FORM_STATIONS,
            )
        if any(b <= a for a, b in pairwise(shares)):
            raise DesignError("{key} of form must increase; put its stations in order.", key=key)
    rows, columns = len(form.along_shares), len(form.across_shares)
    if len(form.heights_mm) != rows or any(len(row) != columns for row in form.heights_mm):
        raise DesignError(
            "heights_mm of form must have {rows} rows of {columns} heights, one for each station.",
            rows=rows,
            columns=columns,
        )


def _check_finish(finish: Finish | None) -> None:
    if finish is None:
        return
    _check(finish, FINISH_RANGES, " of finish")
    if len(finish.rim) > MOST_STATIONS:
        raise DesignError(
            "rim of finish has {count} stations, and may have {most}; remove some.",
            count=len(finish.rim),
            most=MOST_STATIONS,
        )
    for number, station in enumerate(finish.rim):
        _check(station, RIM_RANGES, Message(" of rim[{number}]", number=number))


def _check_shell(design: InsoleDesign) -> None:
    shell = design.shell
    if shell is None:
        return
    _check(shell, SHELL_RANGES, " of shell")
    for number, post in enumerate(shell.posts):
        _check(post, POST_RANGES, Message(" of posts[{number}]", number=number))
    if len({post.region for post in shell.posts}) < len(shell.posts):
        raise DesignError("posts of shell holds two for one region; keep one of them.")
    _check_trim(shell, design.side)


def _check_trim(shell: Shell, side: Side) -> None:
    """Check that a trim line goes from the medial to the lateral border, and never back."""
    lateral = [-side.medial_sign * x for x, _ in shell.trim_mm or ()]
    for number, (before, after) in enumerate(itertools.pairwise(lateral), start=2):
        if after - before < LEAST_TRIM_STEP_MM:
            raise DesignError(
                "The trim line turns back or crosses itself at its point {number}, counted from "
                "the medial border; let every point lie at least {least_mm:g} mm farther lateral "
                "than the one before.",
                number=number,
                least_mm=LEAST_TRIM_STEP_MM,
            )


def _check_zone(correction: Correction, where: str) -> None:
    for name in ("blend", "fade"):
        start = getattr(correction, f"{name}_start", None)
        end = getattr(correction, f"{name}_end", None)
        if start is not None and end is not None and end - start < LEAST_ZONE - _ROUNDING:
            raise DesignError(
                "{zone}_end{where} is {end:g}, and must lie at least {least:g} beyond {zone}_start "
                "({start:g}), or the surface gets a step.",
                zone=name,
                where=where,
                end=end,
                least=LEAST_ZONE,
                start=start,
            )


def _check_smoothing(stroke: BrushStroke, where: str) -> None:
    if stroke.strength > MOST_SMOOTHING:
        raise DesignError(
            "strength{where} is {strength:g}, and for smoothing must be 0 to 1; 1 evens out all it "
            "can.",
            where=where,
            strength=stroke.strength,
        )


def _check_pad(pad: Pelott, where: str) -> None:
    if pad.kind is not None and not 0 < len(pad.kind) <= LONGEST_KIND:
        raise DesignError(
            "kind{where} has {count} letters, and must have 1 to {most}; shorten it, or leave it "
            "out.",
            where=where,
            count=len(pad.kind),
            most=LONGEST_KIND,
        )
    if (pad.shape in FREE) != (pad.outline_mm is not None):
        raise DesignError(
            'outline_mm{where} belongs to the shapes "outline" and "flat_outline" and to no other; '
            "draw an outline, or choose another shape and leave it out.",
            where=where,
        )
    if pad.outline_mm is None:
        return
    if crosses_itself(pad.outline_mm):
        raise DesignError(
            "outline_mm{where} crosses itself; draw the outline again in one round.", where=where
        )
    if not encloses_centre(pad):
        raise DesignError(
            "outline_mm{where} does not go round the pad's centre; put the apex into the outline.",
            where=where,
        )


def _check_shoe(shoe: Shoe) -> None:
    _check(shoe, SHOE_RANGES, " of shoe")
    checked_name(shoe.name)
    curve = closed_curve(shoe.inside_mm)
    if crosses_itself(curve[::_CURVE_STRIDE]):
        raise DesignError("The inside of the shoe crosses itself; choose the shoe again.")
    width_mm, length_mm = np.ptp(curve, axis=0)
    if length_mm not in SHOE_LENGTH or not 0.2 < width_mm / length_mm < 0.7:
        raise DesignError(
            "The shoe is {length:.0f} mm long and {width:.0f} mm wide inside, as no shoe is; "
            "choose it again.",
            length=length_mm,
            width=width_mm,
        )


def _check_outline(outline: Outline) -> None:
    if outline.shoe is not None:
        _check_shoe(outline.shoe)
    if outline.source == "shoe_size" and outline.shoe_size_eu is None:
        raise DesignError("shoe_size_eu of outline is missing; put in the size of the shoe.")
    if outline.source != "drawn":
        return
    points = outline.points_mm or ()
    if len(points) < LEAST_DRAWN_POINTS:
        raise DesignError(
            "points_mm of outline has {count} places, and a drawn outline needs at least "
            "{least}; draw it again.",
            count=len(points),
            least=LEAST_DRAWN_POINTS,
        )
    if crosses_itself(closed_curve(points)[::_CURVE_STRIDE]):
        raise DesignError("The drawn outline of the insole crosses itself; move its points apart.")
