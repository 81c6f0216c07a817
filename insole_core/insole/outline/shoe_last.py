"""The underside for a shoe whose heel is higher than its forefoot.

The bottom line of a last is taken as a cubic: level below the heel's rear end and below the ball,
as much higher behind as the shoe's heel is. An insole that was designed level rests on it with heel
and ball, so that its underside gets what the line lies above or below the straight line between the
two. Ahead of the ball it bends with the shoe, and stays level.
"""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.primitives.blending import smooth_hinge, smooth_step

_HEEL, _BALL = 0.15, 0.7  # shares of the length where the insole rests on the last
_BEND = 0.03  # share of the length over which the underside bends at the ball


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


def ground_heights_mm(design: InsoleDesign, y_mm: FloatArray, length_mm: float) -> FloatArray:
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
