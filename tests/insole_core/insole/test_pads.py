"""Pads of all shapes: outline, apex, smooth edge; eggs by (26), the Gaussian by (25)."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from insole_core.insole.elements import Pelott
from insole_core.insole.pads.pad_form import FREE, PAD_SHAPES
from insole_core.insole.pads.pad_heights import pad_heights, pad_outline
from insole_core.insole.primitives.outline_curve import inside_curve

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
    assert float(pad_heights(pelott, np.array(pelott.centre_mm))) == pelott.height_mm
    step = max(pelott.length_mm, pelott.width_mm) / 100
    heights = pad_heights(pelott, grid(pelott, step))
    assert np.abs(heights).max() <= abs(pelott.height_mm)


@given(pelott=pelotts)
@settings(max_examples=50, deadline=None)
def test_outline_has_the_asked_size_and_the_apex_where_it_is_widest(pelott):
    turn = np.radians(pelott.turn_deg)
    ahead = np.array([-np.sin(turn), np.cos(turn)])
    across = np.array([np.cos(turn), np.sin(turn)])
    local = pad_outline(pelott) - np.array(pelott.centre_mm)
    assert np.ptp(local @ ahead) == pytest.approx(pelott.length_mm, rel=1e-4)
    assert np.ptp(local @ across) == pytest.approx(pelott.width_mm, rel=1e-4)
    widest = (local @ across).argmax()
    assert abs(local[widest] @ ahead) < 0.01 * pelott.length_mm


def test_outline_satisfies_equation_26():
    pelott = Pelott(centre_mm=(0, 0), length_mm=80, width_mm=50, egg_ratio=0.7)
    x, y = pad_outline(pelott).T
    y = y - y.min()
    # Undo the stretch to the asked width: with a = length, x of (26) at the same y.
    a, b = 80.0, 0.7 * 80.0
    expected = np.sqrt((a - b - 2 * y + np.sqrt(4 * b * y + (a - b) ** 2)) / 2 * y)
    assert np.abs(x) / 25 == pytest.approx(expected / expected.max(), abs=2e-3)


def test_ratio_zero_is_an_ellipse():
    x, y = pad_outline(Pelott(centre_mm=(3, 4), length_mm=60, width_mm=40, egg_ratio=0)).T
    assert ((x - 3) / 20) ** 2 + ((y - 4) / 30) ** 2 == pytest.approx(np.ones(len(x)))


def test_blunt_end_is_towards_the_toes():
    outline = pad_outline(Pelott(centre_mm=(0, 150), egg_ratio=0.8))
    near_front = outline[outline[:, 1] > outline[:, 1].max() - 5, 0]
    near_back = outline[outline[:, 1] < outline[:, 1].min() + 5, 0]
    assert np.ptp(near_front) > 1.25 * np.ptp(near_back)


def test_turn_is_counter_clockwise_seen_from_above():
    straight = Pelott(centre_mm=(0, 0), turn_deg=0)
    turned = Pelott(centre_mm=(0, 0), turn_deg=90)
    places = np.random.default_rng(1).uniform(-30, 30, (200, 2))
    rotated = places @ np.array([[0, 1], [-1, 0]])  # (x, y) -> (-y, x)
    assert pad_heights(turned, rotated) == pytest.approx(pad_heights(straight, places))


def test_nothing_changes_from_the_outline_on():
    pelott = Pelott(centre_mm=(12.3, 150.4), turn_deg=17)
    beyond = np.array(pelott.centre_mm) + 1.001 * (pad_outline(pelott) - pelott.centre_mm)
    assert np.all(pad_heights(pelott, beyond) == 0)
    inside = np.array(pelott.centre_mm) + 0.9 * (pad_outline(pelott) - pelott.centre_mm)
    assert np.all(pad_heights(pelott, inside) > 0)


@pytest.mark.parametrize("ratio", [0.0, 0.5, 0.9])
def test_slope_is_continuous_everywhere(ratio):
    pelott = Pelott(centre_mm=(0, 0), length_mm=60, width_mm=40, height_mm=8, egg_ratio=ratio)
    step = 0.05
    along = np.stack([np.full(1600, 0.37), np.arange(-800, 800) * step], axis=1)
    for line in (along, along[:, ::-1]):
        slope = np.diff(pad_heights(pelott, line)) / step
        assert np.abs(np.diff(slope)).max() < 0.05  # an edge would give ten times as much


def test_sigma_widens_the_hill():
    place = np.array([5.0, 0.0])
    narrow = Pelott(centre_mm=(0, 0), sigma_mm=(3, 3))
    assert float(pad_heights(narrow, place)) == pytest.approx(6 * np.exp(-0.5 * (5 / 3) ** 2))


LEAF = ((-14.0, -22.0), (10.0, -25.0), (16.0, 0.0), (9.0, 24.0), (-8.0, 20.0), (-18.0, 3.0))


def pad_of(shape: str, **changes) -> Pelott:
    size = {"length_mm": 60.0, "width_mm": 46.0, "height_mm": 5.0, "turn_deg": 25.0}
    corners = LEAF if shape in FREE else None
    return Pelott(centre_mm=(12.3, 150.4), shape=shape, outline_mm=corners, **{**size, **changes})


def places_about(pad: Pelott, step: float) -> np.ndarray:
    reach = np.arange(-45, 45 + step, step)
    x, y = np.meshgrid(pad.centre_mm[0] + reach, pad.centre_mm[1] + reach)
    return np.stack([x, y], axis=-1)


@pytest.mark.slow
@pytest.mark.parametrize("shape", PAD_SHAPES)
@pytest.mark.parametrize("blend_mm", [None, 3.0, 90.0])
@pytest.mark.parametrize("height_mm", [5.0, -2.0])
def test_every_shape_has_its_height_and_ends_at_its_outline(shape, blend_mm, height_mm):
    pad = pad_of(shape, blend_mm=blend_mm, height_mm=height_mm)
    places = places_about(pad, 1.0) + np.array([0.3, 0.4])
    apex = pad_heights(pad, np.array(pad.centre_mm)) / height_mm
    added = pad_heights(pad, places) / height_mm
    assert added.max() == pytest.approx(1, abs=0.02)
    assert added.max() <= 1
    assert added.min() == 0
    inside = inside_curve(pad_outline(pad), places)
    assert np.all(added[~inside] == 0)
    assert (added[inside] > 0).mean() > 0.85
    if shape != "horseshoe":
        assert float(apex) == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("shape", PAD_SHAPES)
def test_every_shape_has_a_continuous_slope(shape):
    pad = pad_of(shape)
    added = pad_heights(pad, places_about(pad, 0.1))
    for axis in (0, 1):
        bend = np.abs(np.diff(added, 2, axis=axis)) / 0.1  # change of slope from node to node
        assert bend.max() < 0.3  # a vertical edge would give 50, a kink of 45 degrees 1


@pytest.mark.parametrize("shape", PAD_SHAPES)
def test_mirrored_pad_is_the_mirror_image(shape):
    pad = pad_of(shape)
    places = places_about(pad, 1.0)
    there = pad_heights(pad.mirrored(), places * [-1, 1])
    assert np.abs(there - pad_heights(pad, places)).max() < 1e-6
    back = pad.mirrored().mirrored()
    assert np.abs(pad_heights(back, places) - pad_heights(pad, places)).max() < 1e-9


def test_horseshoe_is_open_towards_the_toes():
    pad = Pelott(centre_mm=(0.0, 40.0), shape="horseshoe", length_mm=60, width_mm=60, height_mm=3)
    spots = np.array([[0, 40], [0, 70], [0, 19], [21, 45], [-21, 45], [21, 58], [0, 9.9]], float)
    assert pad_heights(pad, spots) == pytest.approx([0, 0, 3, 3, 3, 3, 0], abs=1e-3)


def test_arch_support_is_steep_on_its_flat_side():
    pad = Pelott(centre_mm=(0, 0), shape="arch_support", length_mm=90, width_mm=45, height_mm=10)
    medial, lateral = pad_heights(pad, np.array([[12.0, 0.0], [-12.0, 0.0]]))
    assert 0 < medial < lateral < 10
    assert pad_outline(pad)[:, 0].max() == pytest.approx(0.35 * 45, rel=1e-3)


def test_blend_is_the_breadth_of_the_edge():
    bar = Pelott(centre_mm=(0, 0), shape="bar", length_mm=60, width_mm=80, blend_mm=6)
    heights = pad_heights(bar, np.array([[0, 30.1], [0, 27], [0, 23.9], [0, 0]]))
    assert heights == pytest.approx([0, 3, 6, 6], abs=0.05)
