"""The nearest heights along a closed edge that nowhere bend sharply."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray

STEP_MM = 5.0
MOST_BEND_MM = 0.36
"""Greatest second difference of a rim in steps of 5 mm; 0.4 is asked of the finished surface."""
_WEIGHT = 1.0  # of the multipliers' update
_ROUNDS = 400
_SLACK_MM = 0.01


def fair_heights(height_mm: FloatArray, step_mm: float) -> FloatArray:
    """Return the heights nearest to the given ones whose second difference is limited.

    The least squares problem with bounds is solved by the alternating direction method of
    multipliers (Boyd et al. 2011, section 5), its linear part by Fourier transform.

    Parameters
    ----------
    height_mm : (n,) float64
        At evenly spaced points of a closed curve, `step_mm` apart.

    Returns
    -------
    (n,) float64, mm
        The given heights to the bit, if they are fair.
    """
    lag = max(1, round(STEP_MM / step_mm))
    most_mm = MOST_BEND_MM * (lag * step_mm / STEP_MM) ** 2
    if np.abs(_second_difference(height_mm, lag)).max() <= most_mm:
        return height_mm
    turn = 2 * np.pi * lag * np.arange(len(height_mm) // 2 + 1) / len(height_mm)
    stiffness = 1 + _WEIGHT * (2 * np.cos(turn) - 2) ** 2
    bend = np.zeros_like(height_mm)
    multiplier = np.zeros_like(height_mm)
    fair = height_mm
    for _ in range(_ROUNDS):
        pull = height_mm + _WEIGHT * _second_difference(bend - multiplier, lag)
        fair = np.fft.irfft(np.fft.rfft(pull) / stiffness, len(height_mm))
        found = _second_difference(fair, lag)
        if np.abs(found).max() <= most_mm + _SLACK_MM:
            break
        bend = np.clip(found + multiplier, -most_mm, most_mm)
        multiplier += found - bend
    return np.asarray(fair)


def _second_difference(height_mm: FloatArray, lag: int) -> FloatArray:
    return np.asarray(np.roll(height_mm, lag) - 2 * height_mm + np.roll(height_mm, -lag))
