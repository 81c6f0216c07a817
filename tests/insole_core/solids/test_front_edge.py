"""How far behind the front edge places lie."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.primitives.height_field import HeightField
from insole_core.solids.shell_body import behind_front_mm

FIELD = HeightField(-60.0, -10.0, 1.0, np.zeros((221, 121)))


def behind(*corners: tuple[float, float]) -> FloatArray:
    return behind_front_mm(np.array(corners, float), FIELD)


def at(values: FloatArray, x: float, y: float) -> float:
    return float(values[round(y + 10), round(x + 60)])


def test_a_straight_edge_has_its_distance():
    level = behind((-40, 0), (40, 0), (40, 180), (-40, 180))
    for x, y in ((0, 180), (20, 170), (-30, 100), (0, 190)):
        assert at(level, x, y) == pytest.approx(180 - y, abs=1e-9)
    oblique = behind((-40, 0), (40, 0), (40, 180), (-40, 140))
    normal = np.array([-0.5, 1]) / np.hypot(0.5, 1)
    for x, y in ((0, 150), (10, 130), (-10, 120)):
        assert at(oblique, x, y) == pytest.approx(normal @ [40 - x, 180 - y], abs=0.02)


def test_a_round_front_has_no_crease():
    turn = np.radians(np.arange(0.0, 360, 1))
    circle = behind_front_mm(np.column_stack([40 * np.cos(turn), 100 + 40 * np.sin(turn)]), FIELD)
    for degrees in (60, 75, 90, 110):
        x, y = 32 * np.cos(np.radians(degrees)), 100 + 32 * np.sin(np.radians(degrees))
        assert at(circle, x, y) == pytest.approx(8, abs=1.2)
    near = np.abs(circle) < 20
    for bends, inner in (
        (np.diff(circle, 2, axis=0), near[1:-1]),
        (np.diff(circle, 2, axis=1), near[:, 1:-1]),
    ):
        assert np.abs(bends[inner]).max() < 0.2  # the nearest point would give 1


def test_a_sharp_tip_has_a_front_too():
    tip = behind((-40, 0), (40, 0), (0.0, 190))
    assert at(tip, 0, 180) == pytest.approx(10, abs=0.6)
    assert np.isfinite(tip).all()
