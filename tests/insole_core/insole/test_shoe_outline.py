"""The outline of a shoe has its size, lies around the insole, and stands on its heel."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.cases.case_file import read_case
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.elements import HeelLift
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.outline.shoe_outline import shoe_outline
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Shell
from insole_core.insole.primitives.outline_curve import inside_curve
from insole_core.resources import resource_path
from insole_core.solids.solid import insole_solid


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


def test_a_size_by_a_foot_without_toes_is_a_guess(foot: Foot) -> None:
    y = foot.mesh.vertices[:, 1]
    toeless = replace(foot, mesh=foot.mesh.part(y < 0.75 * foot.length_mm))
    given = Outline(source="shoe_size", shoe_size_eu=44.0)
    assert shoe_outline(toeless, InsoleDesign(foot.side)).is_guess
    assert not shoe_outline(foot, InsoleDesign(foot.side)).is_guess
    assert not shoe_outline(toeless, InsoleDesign(foot.side, outline=given)).is_guess


def test_the_heel_stands_as_high_as_it_is_prescribed(foot: Foot) -> None:
    lifts = (HeelLift(height_mm=3.0), HeelLift(height_mm=5.0, enabled=False))
    design = InsoleDesign(foot.side, lifts, shell=Shell(heel_pitch_mm=12.0))
    shoe = shoe_outline(foot, design)
    assert (shoe.pitch_mm, shoe.lift_mm) == (12.0, 3.0)
    assert shoe.heel[0, 2] - shoe.heel[1, 2] == pytest.approx(12.0)
    behind = shoe.ground[:, 1] < 0.15 * foot.length_mm
    ahead = shoe.ground[:, 1] > 0.75 * foot.length_mm
    assert np.ptp(shoe.ground[ahead, 2]) < 0.01, "level from the ball on"
    assert shoe.ground[ahead, 2].mean() - shoe.ground[behind, 2].max() > 8.0


def test_the_insole_rests_on_the_inside_of_the_shoe(foot: Foot) -> None:
    design = InsoleDesign(foot.side, shell=Shell(heel_pitch_mm=20.0))
    solid = insole_solid(build_insole(foot, design))
    shoe = shoe_outline(foot, design)
    _, y, z = shoe.inside.T
    for share in (0.05, 0.15, 0.3, 0.5, 0.7, 0.9):
        here = np.abs(solid.vertices[:, 1] - share * foot.length_mm) < 1.0
        underside_mm = solid.vertices[here, 2].min()
        beside_mm = np.interp(share * foot.length_mm, *np.array(sorted(zip(y, z, strict=True))).T)
        assert beside_mm == pytest.approx(underside_mm, abs=0.15)


def test_the_other_side_is_its_mirror_image(foot: Foot) -> None:
    mesh = foot.mesh.moved(foot.mesh.vertices * [-1.0, 1.0, 1.0]).flipped()
    mirrored = replace(foot, side=foot.side.other, mesh=mesh)
    own = shoe_outline(foot, InsoleDesign(foot.side)).ground
    other = shoe_outline(mirrored, InsoleDesign(mirrored.side)).ground
    assert {foot.side, mirrored.side} == set(Side)
    low, high = own[:, 0].min(), own[:, 0].max()
    assert (other[:, 0].min(), other[:, 0].max()) == pytest.approx((-high, -low), abs=0.3)
    assert abs(high + low) > 1.0  # it is not symmetric itself
