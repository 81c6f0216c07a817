"""From raw numbers to millimetres and onto the colour image."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from kinect_samples import make_calibration

from kinect_v1.calibration import Padding
from kinect_v1.depth import (
    DepthRegistration,
    depth_mm,
    millimetre_table,
    points_mm,
    registration_table,
)
from kinect_v1.emulation.playback import TYPICAL_CALIBRATION


def test_known_distances() -> None:
    raw = np.array([0, 399, 596, 744, 1054])
    assert millimetre_table(TYPICAL_CALIBRATION)[raw].tolist() == [317, 500, 596 + 104, 1000, 9757]


def test_fractions_are_kept() -> None:
    low, middle, high = depth_mm(np.array([596.0, 596.5, 597.0]), TYPICAL_CALIBRATION)
    assert low < middle < high
    assert high - low == pytest.approx(1.42, abs=0.01)


def test_past_infinity_and_no_reading_are_nothing() -> None:
    raw = np.arange(2048)
    mm = depth_mm(raw, TYPICAL_CALIBRATION)
    assert np.isnan(mm[[1055, 1090, 1100, 2046, 2047]]).all()
    assert np.all(np.diff(mm[:1055]) > 0)
    assert millimetre_table(TYPICAL_CALIBRATION)[1055:].max() == 0


def test_points_follow_the_pinhole() -> None:
    depth = np.full((480, 640), np.nan)
    depth[240, 320] = 800.0
    depth[0, 620] = 1000.0
    points = points_mm(depth, TYPICAL_CALIBRATION)
    focal = 120 / (2 * 0.1042)
    assert points[240, 320].tolist() == [0, 0, 800]
    assert points[0, 620] == pytest.approx([300 * 1000 / focal, -240 * 1000 / focal, 1000])
    assert np.isnan(points[5, 5]).all()


def test_without_coefficients_pixels_stay_but_for_the_fixed_step() -> None:
    table = registration_table(TYPICAL_CALIBRATION)
    assert table[7, 9].tolist() == [256 * 10, 8]
    assert table[0, 639].tolist() == [1280 * 256, 1]  # out of the picture


def test_the_nearest_of_two_wins() -> None:
    near, far = 500, 900
    registration = DepthRegistration(make_calibration(4))
    both = np.full((480, 640), far, np.uint16)
    both[100:380, 300:340] = near
    seen = registration.register(both)
    table = millimetre_table(make_calibration(4))
    assert set(np.unique(seen)) <= {0, table[near], table[far]}
    kept = np.count_nonzero(seen == table[near])
    assert kept == np.count_nonzero(
        registration.register(np.where(both == near, both, 2047)) == table[near]
    )


def test_start_lines_move_the_picture_up() -> None:
    calibration = make_calibration(4)
    raw = np.full((480, 640), 800, np.uint16)
    plain = DepthRegistration(calibration).register(raw)
    moved = DepthRegistration(replace(calibration, padding=Padding(4, 0, 0))).register(raw)
    assert np.array_equal(moved.reshape(-1)[:-1920], plain.reshape(-1)[1920:])
