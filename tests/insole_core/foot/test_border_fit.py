"""How far a round border reaches, told by outlines in pictures and by a part of the surface."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.foot.border_fit import BorderFit, UsualBorder, fit_border
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import ContourConstraints
from insole_core.geometry.transforms import rigid, rotation_about

MEDIAL = np.array([1.0, 0.0, 0.0])
CENTRE_X, HEIGHT, RADIUS = 35.0, 17.0, 14.0
USUAL = UsualBorder((13, 13, 13, 6), (10, 10, 10, 5), (10, 10, 10, 5), 40, 12)
NOTHING = ContourConstraints(np.zeros((0, 3)), np.zeros((0, 3)))


def wall(angles_deg: FloatArray) -> ContourConstraints:
    """Tangents of a wall along y, round in its section, at angles from medial upwards."""
    angle = np.radians(np.tile(angles_deg, 60))
    normals = np.column_stack([np.cos(angle), np.zeros_like(angle), np.sin(angle)])
    y = np.repeat(np.linspace(140, 200, 60), len(angles_deg))
    places = np.column_stack([np.full_like(y, CENTRE_X), y, np.full_like(y, HEIGHT)])
    return ContourConstraints(places + RADIUS * normals, normals)


def fitted(surface: ContourConstraints, outlines: ContourConstraints) -> BorderFit:
    return fit_border(surface, outlines, MEDIAL, (150.0, 190.0), USUAL)


def test_outlines_from_both_sides_tell_the_reach() -> None:
    fit = fitted(NOTHING, wall(np.array([-25.0, 25.0])))
    assert fit.across_mm.min() > 150
    assert fit.across_mm.max() < 190
    assert fit.reach_mm == pytest.approx(CENTRE_X + RADIUS, abs=0.45)
    assert np.abs(fit.reach_mm - CENTRE_X - RADIUS).max() < fit.deviation_mm.max() < 0.7


def test_the_surface_below_makes_it_more_certain() -> None:
    surface, outlines = wall(np.array([-40.0, -30.0])), wall(np.array([-25.0, 25.0]))
    fit = fitted(surface, outlines)
    assert fit.reach_mm == pytest.approx(CENTRE_X + RADIUS, abs=0.3)
    assert fit.height_mm == pytest.approx(HEIGHT, abs=1.0)
    assert (fit.deviation_mm < fitted(NOTHING, outlines).deviation_mm).all()


def test_by_points_what_normals_say_does_not_count() -> None:
    surface, outlines = wall(np.arange(-40.0, 41.0, 10.0)), wall(np.array([-25.0]))
    turn = rotation_about(np.array([0.0, 1.0, 0.0]), 8.0)
    leaning = ContourConstraints(surface.points, surface.normals @ turn.T)
    fits = [
        fit_border(leaning, outlines, MEDIAL, (150.0, 190.0), replace(USUAL, by_points=told))
        for told in (True, False)
    ]
    by_points, by_normals = (np.abs(fit.reach_mm - CENTRE_X - RADIUS).max() for fit in fits)
    assert by_points < 0.2 < by_normals
    assert fits[0].height_mm == pytest.approx(HEIGHT, abs=1.0)


def test_points_tell_a_widest_place_far_below_the_usual_one() -> None:
    usual = UsualBorder((27, 27, 27, 8), (14, 14, 14, 8), (40, 40, 40, 20), 80, np.inf, True)
    surface, outlines = wall(np.arange(-40.0, 11.0, 5.0)), wall(np.array([-30.0]))
    fit = fit_border(surface, outlines, MEDIAL, (150.0, 190.0), usual)
    assert fit.reach_mm == pytest.approx(CENTRE_X + RADIUS, abs=0.3)
    assert fit.height_mm == pytest.approx(HEIGHT, abs=2.0)


def test_sections_that_change_along_the_border_are_followed_where_they_usually_do() -> None:
    straight, outlines = wall(np.arange(-40.0, 41.0, 10.0)), wall(np.array([-25.0]))
    rising = np.array([0.0, 0.0, 1.0]) * 5 * np.sin(straight.points[:, 1] / 6)[:, None]
    surface = ContourConstraints(straight.points + rising, straight.normals)
    raised = np.array([0.0, 0.0, 1.0]) * 5 * np.sin(outlines.points[:, 1] / 6)[:, None]
    outlines = ContourConstraints(outlines.points + raised, outlines.normals)
    apart, alike = (
        fit_border(surface, outlines, MEDIAL, (150.0, 190.0), replace(USUAL, alike_mm=way))
        for way in (8.0, 60.0)
    )
    height = HEIGHT + 5 * np.sin(apart.across_mm / 6)
    assert np.abs(apart.height_mm - height).max() < 1.5
    assert np.ptp(alike.height_mm) < 5 < np.ptp(apart.height_mm)
    off = [np.abs(fit.reach_mm - CENTRE_X - RADIUS).max() for fit in (apart, alike)]
    assert off[0] < 0.5 < off[1]


def test_an_outline_from_one_side_is_trusted_less() -> None:
    one, both = (fitted(NOTHING, wall(np.array(a))) for a in ([-25.0], [-25.0, 25.0]))
    off = np.abs(one.reach_mm - CENTRE_X - RADIUS)
    assert (one.deviation_mm > 2 * both.deviation_mm).all()
    assert (off < 2 * one.deviation_mm).all()


def test_a_place_far_along_the_ray_does_not_matter() -> None:
    outlines = wall(np.array([-25.0, 25.0]))
    rays = np.cross(outlines.normals, [0.0, 1.0, 0.0])
    slid = ContourConstraints(outlines.points + 6.0 * rays, outlines.normals)
    assert fitted(NOTHING, slid).reach_mm == pytest.approx(fitted(NOTHING, outlines).reach_mm)


def test_a_flap_does_not_count() -> None:
    outlines = wall(np.array([-25.0, 25.0]))
    flap = wall(np.array([-30.0, -20.0]))
    flap = ContourConstraints(flap.points + np.array([4.0, 0.0, 0.0]), flap.normals)
    assert fitted(flap, outlines).reach_mm == pytest.approx(CENTRE_X + RADIUS, abs=0.7)


def test_where_nothing_is_seen_nothing_is_claimed() -> None:
    fit = fitted(NOTHING, NOTHING)
    assert (fit.touched == 0).all()
    assert (fit.deviation_mm > 100).all()


def test_touches_move_with_their_surface() -> None:
    outlines = wall(np.array([10.0]))
    a2b = rigid(rotation_about(np.array([0.0, 0.0, 1.0]), 90.0), np.array([1.0, 2.0, 3.0]))
    moved = outlines.transformed(a2b)
    assert moved.points[0] == pytest.approx(a2b[:3, :3] @ outlines.points[0] + [1, 2, 3])
    assert moved.normals[0] == pytest.approx(a2b[:3, :3] @ outlines.normals[0])


BEND = 40.0


def arc(summit_mm: float, noise_mm: float = 0.0, seed: int = 0) -> BorderFit:
    """Strips every 2 mm across a border that is an arc as seen from below."""
    across = np.arange(-20.0, 21.0, 2.0)
    noise = np.random.default_rng(seed).normal(0, noise_mm, len(across)) if noise_mm else 0.0
    reach = 50 - (across - summit_mm) ** 2 / (2 * BEND) + noise
    one = np.ones_like(across)
    return BorderFit(across, reach, 15 * one, 0.3 * one, 4 * one)


@pytest.mark.parametrize("summit_mm", [-5.3, 0.0, 7.7])
def test_the_summit_of_an_arc_lies_between_the_strips(summit_mm: float) -> None:
    fit = arc(summit_mm)
    found = fit.summit(np.ones(21, bool), BEND)
    assert found.across_mm == pytest.approx(summit_mm, abs=1e-6)
    assert found.reach_mm == pytest.approx(50, abs=1e-6)
    assert abs(fit.across_mm[found.strip] - summit_mm) <= 1


def test_the_noise_of_one_strip_does_not_make_the_summit() -> None:
    """Over many draws a known bend halves at least what noise does to place and reach."""
    everything = np.ones(21, bool)
    fitted_off, farthest_off = np.zeros((60, 2)), np.zeros((60, 2))
    for seed in range(60):
        fit = arc(3.0, 0.25, seed)
        found = fit.summit(everything, BEND)
        fitted_off[seed] = found.across_mm - 3.0, found.reach_mm - 50
        best = fit.reach_mm.argmax()
        farthest_off[seed] = fit.across_mm[best] - 3.0, fit.reach_mm[best] - 50
    fitted_rms, farthest_rms = (np.sqrt((e**2).mean(axis=0)) for e in (fitted_off, farthest_off))
    assert (fitted_rms < 0.6 * farthest_rms).all()


def test_strips_that_do_not_count_are_passed_by() -> None:
    fit = arc(0.0)
    counts = fit.across_mm > 3
    found = fit.summit(counts, BEND)
    assert found.across_mm == pytest.approx(4)
    assert counts[found.strip]
    alone = fit.summit(fit.across_mm == 8, BEND)
    assert (alone.across_mm, alone.strip) == (pytest.approx(8), 14)


def test_a_straight_border_ends_towards_its_usual_place() -> None:
    fit = arc(0.0)
    flat = replace(fit, reach_mm=np.full(21, 50.0))
    found = flat.summit(np.ones(21, bool), 1e4, 6.5, 12.0)
    assert found.across_mm == pytest.approx(6.5, abs=0.1)
    assert found.reach_mm == pytest.approx(50, abs=0.01)
