"""Permitted values of a design, for files, spin boxes and the builder.

The ranges of its values are declared beside them (`insole_core.insole.fields`): wide, what devices
and workshops can do. What is usual or advisable is a matter of the clinic's own rules
(`insole_core.insole.warnings.design_warnings`).
"""

from __future__ import annotations

import itertools
from itertools import pairwise
from typing import Any

import numpy as np

from insole_core.errors import DesignError
from insole_core.geometry.side import Side
from insole_core.insole.fields import LEAST_ZONE, Choice, Line, Part, Range, Share, declared
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.prescription.item_name import checked_name
from insole_core.insole.prescription.outline import Outline, Shoe
from insole_core.insole.prescription.shell import Shell
from insole_core.insole.primitives.outline_curve import closed_curve, crosses_itself
from insole_core.messages import Message

SHOE_LENGTH = Range(80, 400)
LEAST_DRAWN_POINTS = 4
LEAST_STATIONS, MOST_FORM_STATIONS = 4, 400
"""Numbers of stations of a form along and across the foot; a cubic needs four."""
LEAST_TRIM_STEP_MM = 1.0
"""By which each point of a trim line lies farther lateral than the one before."""
MOST_STATIONS = 40
_ROUNDING = 1e-9
_CURVE_STRIDE = 4  # every fourth point of the curve shows whether it crosses itself


def check_design(design: InsoleDesign) -> None:
    """Check that all values of a design are in range and its corrections consistent.

    Raises
    ------
    DesignError
        Naming the key, the value, and what is allowed.
    """
    _check(design, "")
    _check(design.outline, " of outline")
    _check(design.layers, " of layers")
    _check_outline(design.outline)
    _check_base(design.base)
    _check_finish(design.finish)
    _check_shell(design)
    for number, correction in enumerate(design.corrections):
        where = Message(" of corrections[{number}] ({type})", number=number, type=correction.type)
        _check(correction, where)
        _check_zones(correction, where)
        correction.check(where)
    ids = [c.id for c in design.corrections]
    if len(set(ids)) < len(ids):
        twice = next(i for i in ids if ids.count(i) > 1)
        raise DesignError('two corrections have the id "{twice}"; give each its own.', twice=twice)


def _check(part: Part, where: str) -> None:
    """Check each value of a part alone."""
    for key, found in declared(type(part)).items():
        value, allowed = getattr(part, key), found.range
        if allowed is not None:
            _check_numbers(key, _numbers(value), allowed, where)
        if isinstance(found, Choice) and value not in found.words:
            raise DesignError(
                '{key}{where} is "{value}", and must be {allowed}.',
                key=key,
                where=where,
                value=value,
                allowed=", ".join(f'"{word}"' for word in found.words),
            )
        if isinstance(found, Line) and value is not None:
            _check_count(key, found, len(value), where)


def _check_numbers(key: str, numbers: list[float], allowed: Range, where: str) -> None:
    for number in numbers:
        if number not in allowed:
            raise DesignError(
                "{key}{where} is {value:g}, and must be {range}; put in a value of that range.",
                key=key,
                where=where,
                value=number,
                range=str(allowed),
            )


def _numbers(content: Any) -> list[float]:
    """Return all numbers in a number, a point, a list of points, or None."""
    if isinstance(content, tuple):
        return [number for part in content for number in _numbers(part)]
    return [] if content is None else [content]


def _check_count(key: str, line: Line, count: int, where: str) -> None:
    if not line.fewest <= count <= line.most:
        raise DesignError(
            "{key}{where} has {count} places, and must have {least} to {most}; draw it again.",
            key=key,
            where=where,
            count=count,
            least=line.fewest,
            most=line.most,
        )


def _check_base(base: BaseForm | None) -> None:
    if base is not None:
        _check(base, " of base")
        check_form(base.form)


def check_form(form: Form) -> None:
    """Check that a form has ordered stations, a height for each, and values in range.

    Raises
    ------
    DesignError
        Naming the key, the value, and what is allowed.
    """
    _check(form, " of form")
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
    _check(finish, " of finish")
    if len(finish.rim) > MOST_STATIONS:
        raise DesignError(
            "rim of finish has {count} stations, and may have {most}; remove some.",
            count=len(finish.rim),
            most=MOST_STATIONS,
        )
    for number, station in enumerate(finish.rim):
        _check(station, Message(" of rim[{number}]", number=number))


def _check_shell(design: InsoleDesign) -> None:
    shell = design.shell
    if shell is None:
        return
    _check(shell, " of shell")
    for number, post in enumerate(shell.posts):
        _check(post, Message(" of posts[{number}]", number=number))
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


def _check_zones(part: Part, where: str) -> None:
    for key, found in declared(type(part)).items():
        if not (isinstance(found, Share) and found.after):
            continue
        start, end = getattr(part, found.after), getattr(part, key)
        if end - start < LEAST_ZONE - _ROUNDING:
            raise DesignError(
                "{end_key}{where} is {end:g}, and must lie at least {least:g} beyond {start_key} "
                "({start:g}), or the surface gets a step.",
                end_key=key,
                start_key=found.after,
                where=where,
                end=end,
                least=LEAST_ZONE,
                start=start,
            )


def _check_shoe(shoe: Shoe) -> None:
    _check(shoe, " of shoe")
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
