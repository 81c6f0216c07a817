"""How much of a prediction counts in surroundings that were learnt, and in others."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.reconstruct.fusion.neighbourhood import Familiarity

SIZE = 406


@pytest.fixture(scope="module")
def learnt() -> tuple[Familiarity, np.ndarray]:
    rng = np.random.default_rng(3)
    spread = np.geomspace(3, 0.05, SIZE)
    turn = np.linalg.qr(rng.standard_normal((SIZE, SIZE)))[0]
    values = (rng.standard_normal((4000, SIZE)) * spread @ turn + 0.5).astype(np.float32)
    return Familiarity.of([values[:1500], values[1500:3000]]), values


def test_what_was_learnt_counts_whole(learnt: tuple[Familiarity, np.ndarray]) -> None:
    known, values = learnt
    assert known.share(values[3000:]).min() == 1


@pytest.mark.parametrize("along", [0, -1])
def test_what_is_unlike_anything_learnt_does_not_count(
    learnt: tuple[Familiarity, np.ndarray], along: int
) -> None:
    """Whether it is far along a main direction, or where hardly anything was seen."""
    known, values = learnt
    direction = np.linalg.svd(values - values.mean(axis=0), full_matrices=False)[2][along]
    far = known.middle + 80 * direction[None].astype(np.float32)
    assert known.share(far) == 0


def test_it_fades_in_between(learnt: tuple[Familiarity, np.ndarray]) -> None:
    known, values = learnt
    off = values[3000] - known.middle
    shares = [float(known.share((known.middle + k * off)[None])[0]) for k in np.linspace(1, 5, 41)]
    assert shares[0] == 1
    assert shares[-1] == 0
    assert 0 < shares[int(np.argmax(np.array(shares) < 1))] < 1
    assert (np.diff(shares) <= 0).all()
