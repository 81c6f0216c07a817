"""Make the library of base forms: `python resources/forms/make.py`.

Each form is a floor with walls that rise to the medial and lateral border and round the heel; the
walls' heights are those of its device (docs/formats/device.md), on a foot of usual size.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import PchipInterpolator

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.forms.form_file import write_form
from insole_core.insole.prescription.base_form import Form
from insole_core.insole.prescription.item_name import key_of

ALONG = np.array(
    [-0.05, 0.0, 0.03, 0.06, 0.1, 0.15, 0.2, 0.27, 0.35, 0.43, 0.5, 0.57, 0.63, 0.7, 0.8, 0.9, 1.0,
     1.08]
)  # fmt: skip
ACROSS = np.array([-0.1, 0.0, 0.08, 0.17, 0.27, 0.38, 0.5, 0.62, 0.73, 0.83, 0.92, 1.0, 1.1])
ADULT, CHILD = (258.0, 98.0), (185.0, 73.0)
"""Length and width of the ball, mm."""
REAR = 0.12
"""Share of the length from which the wall behind the heel rises."""
BEND = 2.2
"""A wall rises as this power of the way from the floor to the border."""
MOST = 1.6
"""Greatest height beyond the border, in heights of the wall."""
WALLS_AT = (0.0, 0.2, 0.33, 0.45, 0.58, 0.7, 1.0)
"""Shares of the length of the heights below."""
BEGIN_AT = (0.0, 0.2, 0.45, 0.7, 1.0)
BEGIN = ((0.45, 0.5, 0.75, 0.3, 0.2), (0.45, 0.45, 0.5, 0.3, 0.2))
"""Shares of the width, from the medial and from the lateral border, on which the walls rise."""


@dataclass(frozen=True)
class Walls:
    """Heights of a form's borders in mm at `WALLS_AT`."""

    name: str
    medial_mm: tuple[float, ...]
    lateral_mm: tuple[float, ...]
    foot_mm: tuple[float, float] = ADULT


FLAT = Form(
    name="Flat",
    source="A plane",
    length_mm=ADULT[0],
    ball_width_mm=ADULT[1],
    along_shares=(0.0, 0.35, 0.7, 1.0),
    across_shares=(0.0, 0.35, 0.65, 1.0),
    heights_mm=((0.0,) * 4,) * 4,
)
WALLED = (
    Walls("EVA, full length", (12, 13, 16, 17, 9, 2, 0), (12, 11, 7, 6, 4, 1, 0)),
    Walls("Functional, three-quarter", (12, 14, 18, 19, 10, 1, 0), (12, 11, 8, 6, 3, 0, 0)),
    Walls("Dress, three-quarter", (9, 10, 14, 15, 8, 1, 0), (9, 8, 5, 4, 2, 0, 0)),
    Walls("Sport, full length", (14, 15, 18, 19, 10, 2, 0), (14, 13, 9, 7, 4, 2, 0)),
    Walls("UCBL, child", (22, 22, 22, 21, 15, 6, 0), (22, 18, 15, 13, 9, 4, 0), CHILD),
    Walls("Diabetic, full length", (10, 10, 12, 12, 7, 3, 1), (10, 9, 6, 6, 4, 3, 1)),
)


def made(walls: Walls) -> Form:
    """Return the form of these walls."""
    along = np.clip(ALONG, 0, 1)
    rise = [PchipInterpolator(WALLS_AT, h)(along) for h in (walls.medial_mm, walls.lateral_mm)]
    begin = [PchipInterpolator(BEGIN_AT, shares)(along) for shares in BEGIN]
    heights = np.zeros((len(ALONG), len(ACROSS)))
    rear = np.clip((REAR - ALONG) / REAR, 0, None)[:, None]
    for wall, start, way in zip(rise, begin, (1 - ACROSS, ACROSS), strict=True):
        floor = (1 - start)[:, None]
        aside = np.clip((way - floor) / (1 - floor), 0, None)
        share = np.hypot(aside, rear * (way >= 0.5)) ** BEND
        heights = np.maximum(heights, _levelled(share) * wall[:, None])
    length_mm, width_mm = walls.foot_mm
    return Form(
        name=walls.name,
        source="Insole Studio, from the usual values of the device",
        length_mm=length_mm,
        ball_width_mm=width_mm,
        along_shares=tuple(ALONG.tolist()),
        across_shares=tuple(ACROSS.tolist()),
        heights_mm=tuple(tuple(row) for row in np.round(heights, 1).tolist()),
    )


def _levelled(share: FloatArray) -> FloatArray:
    """Return shares of a wall up to 1 as they are, and level them off beyond."""
    beyond = np.maximum(share - 1, 0)
    return np.minimum(share, 1) + (MOST - 1) * np.tanh(beyond / (MOST - 1))


def main() -> None:
    """Write every form beside this module."""
    for form in (FLAT, *map(made, WALLED)):
        write_form(form, Path(__file__).parent / f"{key_of(form.name)}.json")


if __name__ == "__main__":
    main()
