"""A shoe around an insole: the outline of a usual one, and the underside for a raised heel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.foot.measures import PARIS_MM, is_length_seen, shoe_size_eu
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.outline.insole_outline import full_outline, insole_outline, shoe_inside
from insole_core.insole.outline.shoe_fit import fit_in
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_totals import heel_lift_mm
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.primitives.blending import smooth_hinge, smooth_step
from insole_core.insole.primitives.outline_curve import smoothed_along

_HEEL, _BALL = 0.15, 0.7  # shares of the length where the insole rests on the last
_BEND = 0.03  # share of the length over which the underside bends at the ball
_BALL_MM, _HEEL_MM = 4.0, 3.0
"""Room of a usual shoe beside the ball and the heel of the foot."""
_WALL_MM, _EVENING_MM = 6.0, 6.0
"""Upper and edge of the sole, by which it is wider than the shoe's inside."""


def last_heights_mm(design: InsoleDesign, y_mm: FloatArray, length_mm: float) -> FloatArray:
    """Return how high the shoe's last carries an insole in each cross section.

    Parameters
    ----------
    y_mm : (n,) float64, mm, insole frame
    length_mm
        Of the foot.

    Returns
    -------
    (n,) float64, mm
        Over z = 0, which the last touches; zeros for a shoe without heel.
    """
    pitch_mm = design.heel_pitch_mm
    if pitch_mm == 0:
        return np.zeros_like(y_mm)
    return pitch_mm * (_over_chord(y_mm / length_mm) - _LOWEST)


def _ground_heights_mm(design: InsoleDesign, y_mm: FloatArray, length_mm: float) -> FloatArray:
    """Return the height of the ground below a shoe's last in each cross section.

    Under heel and ball it lies as far below the last as the shoe carries them. The insole is
    designed level, so that in its frame the ground falls from the ball to the heel.

    Parameters
    ----------
    y_mm : (n,) float64, mm, insole frame
    length_mm
        Of the foot.

    Returns
    -------
    (n,) float64, mm, insole frame
        Zeros for a shoe without heel.
    """
    pitch_mm = design.heel_pitch_mm
    share = np.maximum(y_mm / length_mm, 0.0)
    return np.asarray(-pitch_mm * (_chord(share) + _LOWEST)) if pitch_mm else np.zeros_like(y_mm)


def _over_chord(share: FloatArray) -> FloatArray:
    """Return the last's bottom line over its chord, for a heel of unit height."""
    share = np.maximum(share, 0.0)
    return np.asarray(1 - smooth_step(share, 0.0, _BALL) - _chord(share))


def _chord(share: FloatArray) -> FloatArray:
    """Return the height over the ground of the line through heel and ball, level ahead of it."""
    return _SLOPE * smooth_hinge(_BALL - share, _BEND)


_SLOPE = float(1 - smooth_step(np.array(_HEEL), 0.0, _BALL)) / (_BALL - _HEEL)
_LOWEST = float(_over_chord(np.linspace(0, 1, 1001)).min())


@dataclass(frozen=True, eq=False)
class ShoeOutline:
    """The outline of a shoe, mm, insole frame; its inside lies on the last that carries the insole.

    Parameters
    ----------
    name
        Of the chosen shoe; empty for a usual one.
    size_eu, inside_mm
        Size in Paris points, and the inside's length.
    is_guess
        Whether the size follows from a foot whose heel or toes were not scanned.
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
    is_guess: bool
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
    given = design.outline.shoe_size_eu
    size = given or shoe_size_eu(foot.length_mm)
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
        return np.column_stack([points, _ground_heights_mm(design, points[:, 1], foot.length_mm)])

    fit = None if chosen is None else fit_in(_edge(foot, design), inside)
    length_mm = PARIS_MM * size if chosen is None else float(np.ptp(inside[:, 1]))
    worn = design.outline.shoe
    return ShoeOutline(
        "" if worn is None else worn.name,
        size if chosen is None else length_mm / PARIS_MM,
        length_mm,
        chosen is None and not given and not is_length_seen(find_landmarks(foot)),
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
