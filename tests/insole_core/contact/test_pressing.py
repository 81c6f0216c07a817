"""Contacts with known answers."""

from __future__ import annotations

import numpy as np
import pytest

from benchmarks._contact_cases import (
    HAYES,
    LAYERED_PADS,
    HeelInsole,
    finite_element_ratios,
    heel_peak_kpa,
    heel_reliefs,
    punch_stiffness,
    sphere_load_ratio,
)
from benchmarks._layer_theory import punch_stiffness_by_theory, sphere_load_by_theory
from insole_core.contact.elastic_layers import Layer
from insole_core.contact.pressing import Bed, Support


@pytest.mark.parametrize(("poisson", "by_thickness"), [(0.3, 0.4), (0.3, 2.0), (0.45, 1.0)])
def test_a_flat_punch_on_a_layer_is_as_stiff_as_published(
    poisson: float, by_thickness: float
) -> None:
    found = punch_stiffness(poisson, by_thickness, nodes=20)
    assert found == pytest.approx(HAYES[poisson][by_thickness], rel=0.01)


@pytest.mark.parametrize("poisson", HAYES)
def test_published_stiffnesses_of_a_punch_are_those_of_theory(poisson: float) -> None:
    for by_thickness, published in HAYES[poisson].items():
        found = punch_stiffness_by_theory(poisson, by_thickness)
        assert found == pytest.approx(published, rel=0.007)


@pytest.mark.parametrize("share", [0.02, 0.05])
def test_theory_of_a_sphere_begins_as_the_published_series(share: float) -> None:
    """Dimitriadis et al., Biophys. J. 82, 2002: 1.133 of a layer that keeps its volume."""
    found = sphere_load_by_theory(0.4999, 1.0, share**2)
    assert found == pytest.approx(1 + 1.133 * share, abs=2 * share**2)


@pytest.mark.parametrize("thickness_mm", [30.0, 60.0])
def test_a_sphere_on_a_layer_carries_what_theory_says(thickness_mm: float) -> None:
    ratio = sphere_load_ratio(20.0, Layer(thickness_mm, 0.5, 0.3), load_n=5.0, step_mm=0.5)
    assert ratio == pytest.approx(1.0, abs=0.005)


@pytest.mark.parametrize("is_ball", [False, True])
def test_a_layered_pad_is_pressed_as_finite_elements_say(is_ball: bool) -> None:
    pad = LAYERED_PADS["tissue on foam"]
    sinking, peak = finite_element_ratios(pad, is_ball=is_ball, fine=20)
    assert sinking == pytest.approx(1.0, abs=0.05)
    assert peak == pytest.approx(1.0, abs=0.05)


def test_tissue_gets_as_stiff_as_it_is_compressed() -> None:
    layer, shape = Layer(10.0, 0.2, 0.0), (60, 60)
    support = Support(shape, 2.0, [Bed((layer,), np.ones(shape), layer.thickness_mm)])
    strains = []
    for mpa in (0.02, 0.2, 1.0):
        load_n = mpa * 60 * 60 * 4
        pressed = support.press(np.zeros(shape), load_n, (59.0, 59.0))
        strains.append(pressed.sinking_mm / layer.thickness_mm)
        middle = pressed.mpa[30, 30]
        strain = strains[-1]
        assert middle == pytest.approx(0.2 * strain / (1 - strain), rel=0.05)
    assert strains == sorted(strains)
    assert strains[-1] < 1


def test_load_centre_and_tilt_are_kept_where_the_load_lies_beside_the_middle() -> None:
    shape = (40, 30)
    x, y = 2.0 * np.arange(30), 2.0 * np.arange(40)[:, None]
    gap = ((x - 30) ** 2 + (y - 40) ** 2) / 60
    support = Support(shape, 2.0, [Bed((Layer(10.0, 0.2, 0.3),), np.ones(shape))])
    pressed = support.press(gap, 200.0, (33.0, 36.0))
    assert pressed.mpa.min() >= 0
    assert 0 < (pressed.mpa > 0).sum() < pressed.mpa.size
    forces = pressed.mpa * 4
    assert forces.sum() == pytest.approx(200.0, rel=1e-9)
    assert (forces * x).sum() / 200 == pytest.approx(33.0, abs=0.05)
    assert (forces * y).sum() / 200 == pytest.approx(36.0, abs=0.05)
    assert pressed.slope[0] > 0 > pressed.slope[1]


def test_the_published_order_and_relief_of_27_heel_insoles() -> None:
    """Goske, Erdemir, Petre, Budhabhatti and Cavanagh, J. Biomech. 39, 2006: 24 % and 44 %."""
    reliefs = heel_reliefs()
    means = {
        form: np.mean([relief for (kind, _, _), relief in reliefs.items() if kind == form])
        for form in ("flat", "half", "full")
    }
    assert means["flat"] == pytest.approx(-24, abs=10)
    assert means["full"] == pytest.approx(-44, abs=10)
    assert means["full"] < means["half"] < means["flat"]
    by_material = [
        np.mean([relief for (_, _, name), relief in reliefs.items() if name == material])
        for material in ("Poron Cushioning", "Microcel Puff Lite", "Microcel Puff")
    ]
    assert np.ptp(by_material) < np.ptp(list(means.values()))
    assert heel_peak_kpa(HeelInsole(0.0, 12.7)) < heel_peak_kpa(HeelInsole(0.0, 6.3))
