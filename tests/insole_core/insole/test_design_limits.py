"""What a window lets one put in is always a design that can be built."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from insole_core.errors import DesignError
from insole_core.geometry.side import Side
from insole_core.insole.elements import BrushStroke, HeelCup, Posting
from insole_core.insole.fields import LEAST_ZONE, range_beside
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_limits import check_design

ENDS = st.floats(LEAST_ZONE, 1.0)


@given(end=ENDS, share=st.floats(0.0, 1.0))
@pytest.mark.parametrize(("kind", "zone"), [(Posting, "blend"), (HeelCup, "fade")])
def test_any_begin_within_its_range_fits_its_end(kind, zone, end, share):
    part = replace(kind(), **{f"{zone}_start": 0.0, f"{zone}_end": end})
    allowed = range_beside(part, f"{zone}_start")
    start = allowed.least + share * (allowed.greatest - allowed.least)
    check_design(InsoleDesign(Side.LEFT, (replace(part, **{f"{zone}_start": start}),)))


def test_a_begin_beyond_its_range_is_refused():
    posting = Posting(blend_start=0.2, blend_end=0.5)
    assert range_beside(posting, "blend_start").greatest == pytest.approx(0.45)
    assert range_beside(posting, "blend_end").least == pytest.approx(0.25)
    with pytest.raises(DesignError, match=r"at least 0\.05 beyond blend_start"):
        check_design(InsoleDesign(Side.LEFT, (replace(posting, blend_start=0.46),)))


def test_smoothing_is_limited_and_pushing_is_not():
    stroke = BrushStroke(points_mm=((0.0, 100.0),), mode="smooth")
    assert range_beside(stroke, "strength").greatest == 1.0
    assert range_beside(replace(stroke, mode="push"), "strength").greatest == 10.0
