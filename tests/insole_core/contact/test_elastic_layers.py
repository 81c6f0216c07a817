"""How far layers sink under pressure that varies along them."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.contact.elastic_layers import Layer, compliance, uniform_compliance

WAVES = np.array([1e-6, 0.01, 0.05, 0.1, 0.3, 1.0, 3.0])


def johnson(layer: Layer, q: np.ndarray) -> np.ndarray:
    """The closed form of a layer that is glued to a rigid ground."""
    v, s = layer.poisson, q * layer.thickness_mm
    upper = (3 - 4 * v) * np.sinh(2 * s) - 2 * s
    lower = (3 - 4 * v) * np.cosh(2 * s) + 2 * s * s + 5 - 12 * v + 8 * v * v
    return np.asarray(2 * (1 - v * v) / layer.modulus_mpa / q * upper / lower)


@pytest.mark.parametrize("poisson", [0.0, 0.2, 0.3, 0.45])
def test_a_layer_and_the_same_in_two_parts_are_the_closed_form(poisson: float) -> None:
    whole = Layer(16.0, 0.2, poisson)
    parts = [Layer(6.0, 0.2, poisson), Layer(10.0, 0.2, poisson)]
    expected = johnson(whole, WAVES)
    np.testing.assert_allclose(compliance([whole], WAVES), expected, rtol=1e-4)
    np.testing.assert_allclose(compliance(parts, WAVES), expected, rtol=1e-4)
    assert uniform_compliance(parts) == pytest.approx(expected[0], rel=1e-6)


def test_a_stiff_layer_spreads_a_narrow_load_over_a_soft_one() -> None:
    soft, stiff = Layer(10.0, 0.2, 0.3), Layer(3.0, 1000.0, 0.35)
    alone, below = compliance([soft], WAVES), compliance([stiff, soft], WAVES)
    assert below[0] == pytest.approx(alone[0], rel=1e-3)
    assert below[4] < 0.05 * alone[4]
    assert (compliance([], WAVES) == 0).all()
