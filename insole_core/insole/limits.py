"""What the numbers of a design may be: one table for files, spin boxes and the builder.

The ranges are wide, from what devices and shops can do; what is usual or advisable is a matter of
the clinic's own rules.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any

from insole_core.errors import DesignError
from insole_core.insole.design import Correction, InsoleDesign, Pelott, Posting


@dataclass(frozen=True)
class Range:
    """Least and greatest value, both allowed, and the unit ("" for a plain number)."""

    least: float
    greatest: float
    unit: str = "mm"

    def __contains__(self, value: float) -> bool:
        return math.isfinite(value) and self.least <= value <= self.greatest

    def __str__(self) -> str:
        return f"{self.least:g} to {self.greatest:g} {self.unit}".rstrip()


DESIGN_RANGES = {
    "thickness_mm": Range(0.5, 40),
    "grid_mm": Range(0.25, 5),
    "max_height_mm": Range(5, 45),
    "margin_mm": Range(0, 50),
}
CORRECTION_RANGES: dict[type[Correction], dict[str, Range]] = {
    Pelott: {
        "centre_mm": Range(-400, 400),
        "length_mm": Range(5, 200),
        "width_mm": Range(5, 150),
        "height_mm": Range(-20, 20),
        "turn_deg": Range(-360, 360, "degrees"),
        "egg_ratio": Range(0, 1, ""),
        "sigma_mm": Range(1, 400),
    },
    Posting: {
        "rearfoot_deg": Range(-15, 15, "degrees"),
        "forefoot_deg": Range(-15, 15, "degrees"),
    },
}
PELOTT_SHAPES = ("egg",)


def check_design(design: InsoleDesign) -> None:
    """Refuse a design with a value out of range.

    Raises
    ------
    DesignError
        Names the key, the value, and what is allowed.
    """
    _check(design, DESIGN_RANGES, "")
    for number, correction in enumerate(design.corrections):
        where = f" of corrections[{number}] ({correction.type})"
        _check(correction, CORRECTION_RANGES[type(correction)], where)
        if isinstance(correction, Pelott) and correction.shape not in PELOTT_SHAPES:
            raise DesignError(
                f'shape{where} is "{correction.shape}", and only "egg" is known;'
                ' write "egg" or leave it out.'
            )
    ids = [c.id for c in design.corrections]
    if len(set(ids)) < len(ids):
        twice = next(i for i in ids if ids.count(i) > 1)
        raise DesignError(f'two corrections have the id "{twice}"; give each its own.')


def _check(value: Any, ranges: dict[str, Range], where: str) -> None:
    for key in (f.name for f in fields(value) if f.name in ranges):
        content = getattr(value, key)
        for number in content if isinstance(content, tuple) else (content,):
            if number is not None and number not in ranges[key]:
                raise DesignError(
                    f"{key}{where} is {number:g}, and must be {ranges[key]};"
                    " put in a value of that range."
                )
