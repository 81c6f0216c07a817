"""Insoles with the elements of the library stay sound solids."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.insole.build import build_insole
from insole_core.insole.elements import ArchRaise, Correction, new_id
from insole_core.insole.elements.pad_places import placed_pad
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.solids.solid import insole_solid
from insole_core.workflows.pad_library import load_pads

TOGETHER = (
    ("reverse_mortons_extension", "heel_spur_recess", "relief_base_5", "toe_filler_2"),
    ("dancers_pad", "first_ray_cut_out", "cuboid_raise", "relief_toe_1", "relief_toe_3"),
    ("fifth_ray_cut_out", *(f"relief_head_{n}" for n in (1, 2, 3)), "forefoot_filler"),
)


def elements(foot: Foot, kinds: tuple[str, ...]) -> tuple[Correction, ...]:
    pads = [pad for pad in load_pads() if pad.kind in kinds]
    assert len(pads) == len(kinds)
    laid = (
        placed_pad(pad.template, pad.place, foot.side, find_landmarks(foot), 8.0) for pad in pads
    )
    return tuple(replace(pad, id=new_id()) for pad in laid)


@pytest.mark.parametrize(("side", "bottom"), [("left_foot", "flat"), ("right_foot", "following")])
@pytest.mark.parametrize("kinds", TOGETHER, ids=lambda kinds: kinds[0])
def test_an_insole_with_several_elements_is_watertight(
    request: pytest.FixtureRequest, side: str, kinds: tuple[str, ...], bottom: str
) -> None:
    foot: Foot = request.getfixturevalue(side)
    corrections = (*elements(foot, kinds), ArchRaise(target_mm=30.0))
    design = InsoleDesign(foot.side, corrections, thickness_mm=4.0, bottom=bottom)
    solid = insole_solid(build_insole(foot, design))
    mesh = trimesh.Trimesh(solid.vertices, solid.triangles, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.body_count == 1
    assert mesh.volume > 1e4
    assert np.isfinite(mesh.vertices).all()
