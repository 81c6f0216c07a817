"""The pelott: outline (26), Gaussian (25), smooth edge."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from insole_core.insole.design import Pelott
from insole_core.insole.egg import egg_outline, pelott_heights

pelotts = st.builds(
    Pelott,
    centre_mm=st.tuples(st.floats(-50, 50), st.floats(0, 250)),
    length_mm=st.floats(5, 200),
    width_mm=st.floats(5, 150),
    height_mm=st.floats(-20, 20),
    turn_deg=st.floats(-360, 360),
    egg_ratio=st.floats(0, 1),
)


def grid(pelott: Pelott, step: float) -> np.ndarray:
    reach = np.arange(-120, 121) * step
    x, y = np.meshgrid(pelott.centre_mm[0] + reach, pelott.centre_mm[1] + reach)
    return np.stack([x, y], axis=-1)


@given(pelott=pelotts)
@settings(max_examples=50, deadline=None)
def test_apex_has_exactly_the_height_and_is_the_highest(pelott):
    assert float(pelott_heights(pelott, np.array(pelott.centre_mm))) == pelott.height_mm
    step = max(pelott.length_mm, pelott.width_mm) / 100
    heights = pelott_heights(pelott, grid(pelott, step))
    assert np.abs(heights).max() <= abs(pelott.height_mm)


@given(pelott=pelotts)
@settings(max_examples=50, deadline=None)
def test_outline_has_the_asked_size_and_the_apex_where_it_is_widest(pelott):
    turn = np.radians(pelott.turn_deg)
    ahead = np.array([-np.sin(turn), np.cos(turn)])
    across = np.array([np.cos(turn), np.sin(turn)])
    local = egg_outline(pelott) - np.array(pelott.centre_mm)
    assert np.ptp(local @ ahead) == pytest.approx(pelott.length_mm, rel=1e-4)
    assert np.ptp(local @ across) == pytest.approx(pelott.width_mm, rel=1e-4)
    widest = (local @ across).argmax()
    assert abs(local[widest] @ ahead) < 0.01 * pelott.length_mm


def test_outline_satisfies_equation_26():
    pelott = Pelott(centre_mm=(0, 0), length_mm=80, width_mm=50, egg_ratio=0.7)
    x, y = egg_outline(pelott).T
    y = y - y.min()
    # Undo the stretch to the asked width: with a = length, x of (26) at the same y.
    a, b = 80.0, 0.7 * 80.0
    expected = np.sqrt((a - b - 2 * y + np.sqrt(4 * b * y + (a - b) ** 2)) / 2 * y)
    assert np.abs(x) / 25 == pytest.approx(expected / expected.max(), abs=2e-3)


def test_ratio_zero_is_an_ellipse():
    x, y = egg_outline(Pelott(centre_mm=(3, 4), length_mm=60, width_mm=40, egg_ratio=0)).T
    assert ((x - 3) / 20) ** 2 + ((y - 4) / 30) ** 2 == pytest.approx(np.ones(len(x)))


def test_blunt_end_is_towards_the_toes():
    outline = egg_outline(Pelott(centre_mm=(0, 150), egg_ratio=0.8))
    near_front = outline[outline[:, 1] > outline[:, 1].max() - 5, 0]
    near_back = outline[outline[:, 1] < outline[:, 1].min() + 5, 0]
    assert np.ptp(near_front) > 1.25 * np.ptp(near_back)


def test_turn_is_counter_clockwise_seen_from_above():
    straight = Pelott(centre_mm=(0, 0), turn_deg=0)
    turned = Pelott(centre_mm=(0, 0), turn_deg=90)
    places = np.random.default_rng(1).uniform(-30, 30, (200, 2))
    rotated = places @ np.array([[0, 1], [-1, 0]])  # (x, y) -> (-y, x)
    assert pelott_heights(turned, rotated) == pytest.approx(pelott_heights(straight, places))


def test_nothing_changes_from_the_outline_on():
    pelott = Pelott(centre_mm=(12.3, 150.4), turn_deg=17)
    beyond = np.array(pelott.centre_mm) + 1.001 * (egg_outline(pelott) - pelott.centre_mm)
    assert np.all(pelott_heights(pelott, beyond) == 0)
    inside = np.array(pelott.centre_mm) + 0.9 * (egg_outline(pelott) - pelott.centre_mm)
    assert np.all(pelott_heights(pelott, inside) > 0)


@pytest.mark.parametrize("ratio", [0.0, 0.5, 0.9])
def test_slope_is_continuous_everywhere(ratio):
    pelott = Pelott(centre_mm=(0, 0), length_mm=60, width_mm=40, height_mm=8, egg_ratio=ratio)
    step = 0.05
    along = np.stack([np.full(1600, 0.37), np.arange(-800, 800) * step], axis=1)
    for line in (along, along[:, ::-1]):
        slope = np.diff(pelott_heights(pelott, line)) / step
        assert np.abs(np.diff(slope)).max() < 0.05  # an edge would give ten times as much


def test_sigma_widens_the_hill():
    place = np.array([5.0, 0.0])
    narrow = Pelott(centre_mm=(0, 0), sigma_mm=(3, 3))
    assert float(pelott_heights(narrow, place)) == pytest.approx(6 * np.exp(-0.5 * (5 / 3) ** 2))
