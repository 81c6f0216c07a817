"""The outline of a usual shoe of the right size around an insole, to judge its place in one.

It follows from size, foot and heel height alone: it is no last, and no certain shoe.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.foot.measures import PARIS_MM, shoe_size_eu
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.outline.insole_outline import full_outline, insole_outline, shoe_inside
from insole_core.insole.outline.shoe_fit import fit_in
from insole_core.insole.outline.shoe_last import ground_heights_mm, last_heights_mm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.lifts import heel_lift_mm
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.primitives.outline_curve import smoothed_along

_BALL_MM, _HEEL_MM = 4.0, 3.0
"""Room of a usual shoe beside the ball and the heel of the foot."""
_WALL_MM, _EVENING_MM = 6.0, 6.0
"""Upper and edge of the sole, by which it is wider than the shoe's inside."""


@dataclass(frozen=True, eq=False)
class ShoeOutline:
    """The outline of a shoe, mm, insole frame; its inside lies on the last that carries the insole.

    Parameters
    ----------
    name
        Of the chosen shoe; empty for a usual one.
    size_eu, inside_mm
        Size in Paris points, and the inside's length.
    inside : (n, 3) float64
        Closed curve around the surface of the last, on which the underside of the insole rests.
    ground : (n, 3) float64
        Closed curve around the sole, on the ground.
    heel : (2, 3) float64
        From the rearmost point of the inside to the ground below: as long as the heel is high.
    wider : (n, 3) float64 each
        Where the edge of the insole lies outside a chosen shoe.
    most_over_mm
        By how much at most.
    pitch_mm
        Height of the shoe's heel over its forefoot.
    lift_mm
        Height of the heel lifts in the insole.
    """

    name: str
    size_eu: float
    inside_mm: float
    inside: FloatArray
    ground: FloatArray
    heel: FloatArray
    wider: tuple[FloatArray, ...]
    most_over_mm: float
    pitch_mm: float
    lift_mm: float


def shoe_outline(foot: Foot, design: InsoleDesign) -> ShoeOutline:
    """Return the outline of the design's shoe, or else of a usual one for the foot.

    The size of a usual one is that of the design's outline; else that of the foot, with 15 mm
    before the toes.
    """
    size = design.outline.shoe_size_eu or shoe_size_eu(foot.length_mm)
    room = Outline(
        source="shoe_size",
        shoe_size_eu=size,
        ball_allowance_mm=_BALL_MM,
        heel_allowance_mm=_HEEL_MM,
    )
    chosen = shoe_inside(foot, design.outline)
    inside = full_outline(foot, room) if chosen is None else chosen
    sole = smoothed_along(inside + _WALL_MM * _outward(inside), _EVENING_MM)
    back = inside[[inside[:, 1].argmin()]]

    def on_last(points: FloatArray) -> FloatArray:
        return np.column_stack([points, last_heights_mm(design, points[:, 1], foot.length_mm)])

    def on_ground(points: FloatArray) -> FloatArray:
        return np.column_stack([points, ground_heights_mm(design, points[:, 1], foot.length_mm)])

    fit = None if chosen is None else fit_in(_edge(foot, design), inside)
    length_mm = PARIS_MM * size if chosen is None else float(np.ptp(inside[:, 1]))
    worn = design.outline.shoe
    return ShoeOutline(
        "" if worn is None else worn.name,
        size if chosen is None else length_mm / PARIS_MM,
        length_mm,
        on_last(inside),
        on_ground(sole),
        np.concatenate([on_last(back), on_ground(back)]),
        () if fit is None else tuple(on_last(piece) for piece in fit.wider()),
        0.0 if fit is None else fit.most_over_mm,
        design.heel_pitch_mm,
        heel_lift_mm(design),
    )


def _edge(foot: Foot, design: InsoleDesign) -> FloatArray:
    # Only a shortened insole needs landmarks.
    landmarks = {} if design.outline.extent == "full" else find_landmarks(foot)
    return insole_outline(foot, design, landmarks)


def _outward(curve: FloatArray) -> FloatArray:
    """Return the unit normals (n, 2) of a closed curve that runs counter-clockwise."""
    along = np.roll(curve, -1, axis=0) - np.roll(curve, 1, axis=0)
    normals = along[:, ::-1] * [1.0, -1.0]
    return np.asarray(normals / np.linalg.norm(normals, axis=1, keepdims=True))
