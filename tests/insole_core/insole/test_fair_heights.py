"""Heights along a closed edge that nowhere bend sharply."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.finishing.fair_heights import MOST_BEND_MM, fair_heights

POINTS = (401, 650, 697, 700)  # with and without a common factor with the 5 points of a step


def bend(height_mm: FloatArray, lag: int = 5) -> FloatArray:
    return np.asarray(np.roll(height_mm, lag) - 2 * height_mm + np.roll(height_mm, -lag))


def wild_rim(seed: int, count: int) -> FloatArray:
    """Draw steps, noise, waves, or a comb, of up to 45 mm and more."""
    rng = np.random.default_rng(seed)
    steps = np.repeat(rng.uniform(-10, 45, 25), count // 25 + 1)[:count]
    waves = gaussian_filter1d(rng.normal(0, 60, count), 8, mode="wrap")
    comb = np.where(np.arange(count) // 7 % 2, 40.0, 0.0)
    return (steps, rng.uniform(-50, 50, count), waves, comb)[seed % 4]


@pytest.mark.parametrize("count", POINTS)
@pytest.mark.parametrize("seed", range(8))
def test_a_wild_rim_is_fair_and_nothing_fair_is_nearer(seed: int, count: int):
    wild = wild_rim(seed, count)
    fair = fair_heights(wild, 1.0)
    assert np.abs(bend(fair)).max() <= MOST_BEND_MM + 1e-9
    # The nearest point of a convex set: no way to another of its points leads towards the rim.
    others = [fair_heights(wild_rim(other, count), 1.0) for other in range(seed + 1, seed + 5)]
    others += [np.full(count, wild.mean()), 0.99 * fair, np.roll(fair, 1), fair_heights(-wild, 1.0)]
    for other in others:
        way = other - fair
        assert (wild - fair) @ way <= 0.01 * np.sqrt(count) * np.linalg.norm(way)


def test_a_fair_rim_stays_to_the_bit_and_one_just_too_sharp_nearly():
    turn = 2 * np.pi * np.arange(660) / 660
    wave = np.sin(8 * turn)
    wave *= MOST_BEND_MM / np.abs(bend(wave)).max()
    assert fair_heights(0.999 * wave, 1.0) == pytest.approx(0.999 * wave, abs=0)
    assert fair_heights(1.001 * wave, 1.0) == pytest.approx(wave, abs=0.02)


def test_the_limit_counts_in_steps_of_5_mm_whatever_the_pitch():
    for pitch_mm, lag in ((0.5, 10), (1.05, 5), (2.5, 2)):
        count = round(650 / pitch_mm)
        fair = fair_heights(wild_rim(2, count), pitch_mm)
        most_mm = MOST_BEND_MM * (lag * pitch_mm / 5) ** 2
        assert np.abs(bend(fair, lag)).max() <= most_mm + 1e-9
