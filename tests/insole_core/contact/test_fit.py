"""The tissue is fitted to a measured map, and what the fit did not see tells how well."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.contact.change import Assumptions, Loading
from insole_core.contact.fit import HELD_OUT, fit_tissue
from insole_core.contact.stance import Sole, shoe_floor
from insole_core.contact.tissue import Tissue
from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.pressure.laid_map import Placement, PressureMap

PITCH_MM = 5.0


@pytest.fixture(scope="module")
def loading(left_foot: Foot) -> Loading:
    return Loading(Sole.of(left_foot), 75)


@pytest.fixture(scope="module")
def plate(loading: Loading) -> PressureMap:
    """The map of a foot with a stiffer heel and a softer forefoot, its load a bit further back."""
    true = Assumptions(Tissue().scaled(heel=1.6, forefoot=0.6), moved_mm=(2.0, -5.0))
    pressed = loading.pressed(shoe_floor(loading.sole), true).mpa
    field = replace(loading.sole.field, heights_mm=1000 * pressed)
    x = np.arange(field.x_mm[0], field.x_mm[-1], PITCH_MM)
    y = np.arange(field.y_mm[0], field.y_mm[-1], PITCH_MM)[::-1]
    kpa = field.height_at(np.stack(np.meshgrid(x, y), axis=-1))
    middle = Placement(float(x[0] + x[-1]) / 2, float(y[0] + y[-1]) / 2)
    return PressureMap(kpa=kpa, pitch_mm=(PITCH_MM, PITCH_MM), placement=middle)


def test_the_tissue_of_a_measured_map_is_found(loading: Loading, plate: PressureMap) -> None:
    fitted = fit_tissue(loading, plate)
    usual, found = Tissue(), fitted.assumed.tissue
    assert found.heel_mpa == pytest.approx(1.6 * usual.heel_mpa, rel=0.15)
    assert found.forefoot_mpa == pytest.approx(0.6 * usual.forefoot_mpa, rel=0.15)
    assert fitted.assumed.moved_mm == pytest.approx((2.0, -5.0), abs=1.5)
    assert set(fitted.held_out) <= set(HELD_OUT)
    assert fitted.error_percent is not None
    assert fitted.error_percent < 12


def test_a_map_of_walking_is_refused(loading: Loading, plate: PressureMap) -> None:
    walking = replace(plate, kpa=2.3 * plate.kpa)
    with pytest.raises(InputError, match="walking"):
        fit_tissue(loading, walking)


def test_a_map_of_the_other_foot_is_refused(loading: Loading, plate: PressureMap) -> None:
    centre_mm = 2.0 * loading.sole.foot.side.medial_sign
    middle = plate.placement
    other = replace(
        plate,
        kpa=plate.kpa[:, ::-1],
        placement=replace(middle, x_mm=2 * centre_mm - middle.x_mm),
    )
    with pytest.raises(InputError, match="other foot"):
        fit_tissue(loading, other)
