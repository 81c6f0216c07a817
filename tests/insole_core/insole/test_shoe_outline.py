"""The outline of a shoe has its size, lies around the insole, and stands on its heel."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.cases.case_file import read_case
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.outline.outline_curve import inside_curve
from insole_core.insole.outline.shoe_outline import shoe_outline
from insole_core.insole.prescription.design import HeelLift, InsoleDesign, Outline, Shell
from insole_core.resources import resource_path


@pytest.fixture(scope="module")
def foot() -> Foot:
    foot = read_case(resource_path("example/example.insole")).foot
    assert foot is not None
    return foot


def test_it_has_the_size_of_the_foot_and_holds_the_insole(foot: Foot) -> None:
    design = InsoleDesign(foot.side)
    shoe = shoe_outline(foot, design)
    assert shoe.size_eu == 41.0
    assert np.ptp(shoe.inside[:, 1]) == pytest.approx(41 * 20 / 3, abs=0.1)
    insole = insole_outline(foot, design, {})
    assert inside_curve(shoe.inside[:, :2], insole).mean() > 0.9  # the waists differ a little
    assert inside_curve(shoe.ground[:, :2], insole).all()
    assert inside_curve(shoe.ground[:, :2], shoe.inside[:, :2]).all()
    assert (shoe.ground[:, 2] == 0).all()


def test_the_size_of_the_prescription_goes_before(foot: Foot) -> None:
    outline = Outline(source="shoe_size", shoe_size_eu=44.0)
    shoe = shoe_outline(foot, InsoleDesign(foot.side, outline=outline))
    assert (shoe.size_eu, shoe.inside_mm) == (44.0, pytest.approx(293.3, abs=0.1))


def test_the_heel_stands_as_high_as_it_is_prescribed(foot: Foot) -> None:
    lifts = (HeelLift(height_mm=3.0), HeelLift(height_mm=5.0, enabled=False))
    design = InsoleDesign(foot.side, lifts, shell=Shell(heel_pitch_mm=12.0))
    shoe = shoe_outline(foot, design)
    assert (shoe.pitch_mm, shoe.lift_mm) == (12.0, 3.0)
    assert shoe.heel[0, 2] - shoe.heel[1, 2] == 12.0
    back, front = shoe.ground[:, 1].argmin(), shoe.ground[:, 1].argmax()
    assert shoe.ground[back, 2] == -12.0
    assert shoe.ground[front, 2] == 0.0


def test_the_other_side_is_its_mirror_image(foot: Foot) -> None:
    mesh = foot.mesh.moved(foot.mesh.vertices * [-1.0, 1.0, 1.0]).flipped()
    mirrored = replace(foot, side=foot.side.other, mesh=mesh)
    own = shoe_outline(foot, InsoleDesign(foot.side)).ground
    other = shoe_outline(mirrored, InsoleDesign(mirrored.side)).ground
    assert {foot.side, mirrored.side} == set(Side)
    low, high = own[:, 0].min(), own[:, 0].max()
    assert (other[:, 0].min(), other[:, 0].max()) == pytest.approx((-high, -low), abs=0.3)
    assert abs(high + low) > 1.0  # it is not symmetric itself
