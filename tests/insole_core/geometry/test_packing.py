"""Outlines packed into a rectangle lie apart, within it, and as they were."""

from __future__ import annotations

from itertools import combinations

import manifold3d
import numpy as np
import pytest

from insole_core.geometry.packing import Turn, pack, turned

GAP_MM, MARGIN_MM, SIZE_MM = 6.0, 4.0, (400.0, 500.0)
CAREFUL_MM = 0.01


def hooks(seed: int) -> list[np.ndarray]:
    """Outlines that are neither convex nor like their mirror image, of many sizes."""
    random = np.random.default_rng(seed)
    found = []
    for _ in range(20):
        wide, tall = random.uniform(20, 60), random.uniform(60, 160)
        thin = random.uniform(8, 15)
        corners = [(0, 0), (wide, 0), (wide, tall / 3), (wide - thin, tall / 3),
                   (wide - thin, thin), (thin, thin), (thin, tall), (0, tall)]  # fmt: skip
        found.append(np.array(corners) + random.uniform(-50, 50, 2))
    return found


def area_of(polygon: np.ndarray, grown_mm: float) -> manifold3d.CrossSection:
    area = manifold3d.CrossSection([polygon.tolist()])
    return area.offset(grown_mm, manifold3d.JoinType.Round)


@pytest.mark.parametrize("turns", [(0,), (0, 180), (0, 90, 180, 270)])
@pytest.mark.parametrize("seed", [1, 2])
def test_no_two_are_nearer_than_the_gap(seed: int, turns: tuple[Turn, ...]) -> None:
    outlines = hooks(seed)
    found = pack(outlines, SIZE_MM, gap_mm=GAP_MM, margin_mm=MARGIN_MM, turns=turns)
    laid = [p.applied(o) for p, o in zip(found, outlines, strict=True) if p is not None]
    assert len(laid) == len(outlines)
    grown = [area_of(polygon, GAP_MM / 2 - CAREFUL_MM) for polygon in laid]
    assert [a.area() for a in (one ^ other for one, other in combinations(grown, 2))] == (
        pytest.approx([0.0] * len(list(combinations(grown, 2))), abs=1e-6)
    )
    every = np.concatenate(laid)
    assert every.min() >= MARGIN_MM - CAREFUL_MM
    assert (every.max(axis=0) <= np.array(SIZE_MM) - MARGIN_MM + CAREFUL_MM).all()


def test_an_outline_is_turned_and_never_mirrored() -> None:
    (hook, *_) = hooks(1)
    x, y = hook.T
    area = float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
    for turn_deg in (0, 90, 180, 270):
        x, y = turned(hook, turn_deg).T
        assert float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) == pytest.approx(area)


def test_an_outline_of_just_the_free_size_has_room() -> None:
    square = np.array([(0.0, 0), (192, 0), (192, 192), (0, 192)]) + 0.3
    (found,) = pack([square], (200.0, 200.0), gap_mm=6, margin_mm=4)
    assert found is not None
    assert found.applied(square).min() == pytest.approx(4)
    assert found.applied(square).max() == pytest.approx(196)


def test_what_finds_no_room_is_left_out() -> None:
    square = np.array([(0.0, 0), (90, 0), (90, 90), (0, 90)])
    found = pack([square] * 5, (200.0, 200.0), gap_mm=6, margin_mm=4)
    assert sum(each is not None for each in found) == 4
    assert pack([square], (50.0, 200.0), gap_mm=6, margin_mm=4) == (None,)
