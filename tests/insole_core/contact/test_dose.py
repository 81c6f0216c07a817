"""Which height of a pad changes the pressure as much as is asked."""

from __future__ import annotations

import pytest

from insole_core.contact.change import Assumptions, Loading, Told, changed
from insole_core.contact.designs import Shoe
from insole_core.contact.dose import DoseCurve, dose_curve, dosed
from insole_core.contact.hardness import foam
from insole_core.contact.stance import Sole
from insole_core.foot.foot import Foot
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.materials import read_materials


def test_the_dose_of_a_target_lies_on_the_curve() -> None:
    curve = DoseCurve((0.0, 2.0, 4.0), (0.0, -10.0, -40.0))
    assert curve.reaching(-20.0) == pytest.approx(2.0 + 2.0 / 3)
    assert curve.reaching(-10.0) == pytest.approx(2.0)
    assert curve.reaching(-50.0) is None
    assert curve.reaching(10.0) is None


def test_a_pad_whose_doses_differ_by_less_than_one_is_sure_to_has_none() -> None:
    curve = DoseCurve((0.0, 2.0, 4.0), (-20.0, -22.0, -21.0))
    assert curve.span == (-22.0, -20.0)
    for limits, is_within in (((-24.0, -16.0), True), ((-22.5, -21.0), False), (None, False)):
        assert curve.is_within(Told(-22.0, limits)) is is_within


@pytest.mark.parametrize("height_mm", [4.0, -4.0])
def test_the_doses_of_a_pad_begin_without_it_and_those_of_a_recess_go_down(
    left_foot: Foot, height_mm: float
) -> None:
    sole, shoe = Sole.of(left_foot), Shoe(read_materials(), body=foam(35))
    pad = Pelott(centre_mm=(0.0, 30.0), length_mm=40, width_mm=36, height_mm=height_mm)
    design = InsoleDesign(left_foot.side, (pad,), thickness_mm=10, grid_mm=2.0)
    loading = Loading(sole, 75)
    doses = dosed(design, pad)[:4]
    grounds = [(dose, shoe.built(sole, one)) for dose, one in doses]
    known = changed(loading, grounds[0][1], grounds[0][1], Assumptions())
    curve = dose_curve(loading, known, grounds, "heel")
    assert curve is not None
    assert [dose * height_mm >= 0 for dose in curve.doses_mm] == [True] * 4
    assert curve.percents[0] == pytest.approx(0.0, abs=1.0)
    if height_mm > 0:
        assert list(curve.percents) == sorted(curve.percents)
        assert curve.percents[-1] > 20
    assert abs(curve.doses_mm[-1]) == pytest.approx(4.0)
