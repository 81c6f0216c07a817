"""The continuation of what was measured: no step, no overshoot, no preference for a side."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import diags_array, eye_array, kron
from scipy.sparse.linalg import spsolve

from insole_core.insole.surface.inpainting import fill


def exact(heights: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Laplace's equation solved at once."""

    def line(count: int):
        main = np.r_[1.0, np.full(count - 2, 2.0), 1.0]
        return diags_array([main, -np.ones(count - 1), -np.ones(count - 1)], offsets=[0, 1, -1])

    rows, columns = heights.shape
    laplace = (kron(line(rows), eye_array(columns)) + kron(eye_array(rows), line(columns))).tocsr()
    free = ~known.ravel()
    z = np.where(known, heights, 0.0).ravel()
    z[free] = spsolve(laplace[free][:, free], -(laplace @ z)[free])
    return z.reshape(heights.shape)


@given(
    seed=st.integers(0, 1000),
    shape=st.tuples(st.integers(2, 40), st.integers(2, 40)),
    share=st.floats(0.01, 0.9),
    first=st.tuples(st.integers(-7, 7), st.integers(-7, 7)),
)
@settings(max_examples=60, deadline=None)
def test_known_stay_and_the_rest_lies_between(seed, shape, share, first):
    rng = np.random.default_rng(seed)
    heights = rng.uniform(-5, 30, shape)
    known = rng.random(shape) < share
    known.flat[0] = True
    filled = fill(np.where(known, heights, np.nan), known, first)
    assert np.array_equal(filled[known], heights[known])
    assert filled.min() >= heights[known].min() - 1e-9
    assert filled.max() <= heights[known].max() + 1e-9


def test_soap_film_over_a_hole_and_round_an_island():
    y, x = np.mgrid[-40:41, -30:31]
    heights = 0.01 * (x**2 - y**2) + 0.1 * x + 7  # harmonic, also on the grid
    known = np.hypot(x, y) > 20
    assert fill(heights * 1.0, known, (0, 0)) == pytest.approx(heights, abs=0.3)
    island = np.hypot(x, y) < 15
    assert fill(heights * 1.0, island, (0, 0)) == pytest.approx(exact(heights, island), abs=0.3)


def test_no_step_at_the_seam():
    y, x = np.mgrid[-60:61, -50:51]
    heights = 0.02 * (x - 0.3 * y)
    filled = fill(heights, np.hypot(x, 0.5 * y) < 20, (-60, -50))
    assert np.abs(np.diff(filled, axis=0)).max() < 0.05
    assert np.abs(np.diff(filled, axis=1)).max() < 0.05


@pytest.mark.parametrize("first", [(0, -30), (3, -31), (5, 4)])
def test_mirrored_field_is_filled_mirrored(first):
    rng = np.random.default_rng(2)
    heights = rng.uniform(0, 20, (47, 64))
    known = rng.random((47, 64)) < 0.2
    last = first[1] + 63
    mirrored = fill(heights[:, ::-1], known[:, ::-1], (first[0], -last))
    assert mirrored[:, ::-1] == pytest.approx(fill(heights, known, first), abs=1e-9)
