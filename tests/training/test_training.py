"""The program that makes the weights: its examples are right, and it learns."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from insole_core.geometry.mesh import TriangleMesh, numbered_edges
from insole_core.reconstruct.fusion.neighbourhood import FEATURES
from training.feet import varied_foot
from training.network import drawn, fit
from training.random_objects import varied_thing
from training.views import Example, simulate_examples

pytestmark = pytest.mark.slow


def _enclosed_mm3(mesh: TriangleMesh) -> float:
    a, b, c = np.moveaxis(mesh.vertices[mesh.triangles], 1, 0)
    return float(np.einsum("nc,nc->n", a, np.cross(b, c)).sum() / 6)


@pytest.mark.parametrize("make", [varied_foot, varied_thing])
def test_things_are_closed_and_differ(make) -> None:  # type: ignore[no-untyped-def]
    one, other = make(np.random.default_rng(1)), make(np.random.default_rng(2))

    edges = np.sort(one.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    proper = edges[(one.vertices[edges[:, 0]] != one.vertices[edges[:, 1]]).any(axis=1)]
    _, number = numbered_edges(proper, len(one.vertices))
    assert (np.bincount(number) % 2 == 0).mean() > 0.99
    assert abs(_enclosed_mm3(one)) > 30_000
    assert abs(_enclosed_mm3(one) / _enclosed_mm3(other) - 1) > 0.01
    assert one.colors is not None


def test_examples_show_what_a_sensor_reports_beside_the_truth(tmp_path: Path) -> None:
    examples = simulate_examples(0)

    assert set(examples) == {"left", "right", "top"}
    for name, example in examples.items():
        error = (example.raw - example.true_raw)[example.cosine > 0.6]
        assert np.isfinite(error).sum() > 1000
        assert abs(np.nanmedian(error)) < 1, name
        assert 0.2 < np.nanstd(np.clip(error, -5, 5)) < 1.5
        assert (example.shading[np.isnan(example.raw)] == 0).all()
        assert np.abs(example.shading).max() <= 1
    assert any(np.ptp(example.shading) > 0.3 for example in examples.values())
    path = tmp_path / "example.npz"
    examples["left"].save(path)
    np.testing.assert_allclose(Example.load(path).raw, examples["left"].raw, atol=1e-4)


def test_a_network_learns_what_can_be_learnt() -> None:
    rng = np.random.default_rng(0)
    features = rng.standard_normal((6000, FEATURES)).astype(np.float32)
    features[:, :-1] *= 0.1
    errors = np.abs(features[:, -1]).astype(np.float32)
    losses: list[float] = []

    network = fit(
        drawn((FEATURES, 16, 8, 1), rng),
        features,
        errors,
        epochs=60,
        rng=rng,
        report=lambda _, loss: losses.append(loss),
    )

    assert len(losses) == 60
    assert np.mean((network.predict(features) - errors) ** 2) < 0.2 * errors.var()
