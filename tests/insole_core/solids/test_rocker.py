"""A rocker eases the underside ahead of its line, by its slope, and leaves material."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import HEADS, find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import build_insole
from insole_core.insole.clinic_rules import load_rules
from insole_core.insole.elements import Rocker
from insole_core.insole.elements.rocker import LEAST_LEFT_MM
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.shell import Shell
from insole_core.insole.warnings.design_warnings import design_warnings
from insole_core.solids.solid import insole_solid
from insole_core.workflows.insole_builder import bare_key

ROCKER = Rocker(behind_heads_mm=6.0, slope_deg=8.0)
BEND_MM = 6.0


@pytest.fixture(scope="module", params=["left_foot", "right_foot"])
def foot(request: pytest.FixtureRequest) -> Foot:
    found: Foot = request.getfixturevalue(request.param)
    return found


def solid(foot: Foot, *rockers: Rocker, **keys: object) -> TriangleMesh:
    design = replace(InsoleDesign(foot.side, rockers, thickness_mm=14.0), **keys)
    return insole_solid(build_insole(foot, design))


def faces(mesh: TriangleMesh) -> tuple[FloatArray, FloatArray]:
    """Return the vertices of the top, and those of the bottom below them."""
    half = len(mesh.vertices) // 2
    return mesh.vertices[:half], mesh.vertices[half:]


def ahead_of_line(foot: Foot, xy: FloatArray) -> FloatArray:
    marks = find_landmarks(foot)
    first, fifth = (marks[name].point[:2] for name in (HEADS[0], HEADS[-1]))
    along = (fifth - first) / np.hypot(*(fifth - first))
    normal = np.array([-along[1], along[0]])
    normal = normal * np.sign(normal[1])
    return np.asarray((xy - first) @ normal + ROCKER.behind_heads_mm)


def test_the_underside_is_level_behind_the_line_and_has_the_slope_ahead(foot: Foot) -> None:
    _, bottom = faces(solid(foot, ROCKER))
    ahead = ahead_of_line(foot, bottom[:, :2])
    assert np.all(bottom[ahead < -BEND_MM - 1, 2] == 0)
    inclined = ahead > BEND_MM + 1
    assert inclined.sum() > 500
    asked = np.tan(np.radians(8.0)) * ahead[inclined]
    assert bottom[inclined, 2] == pytest.approx(asked, abs=0.1)  # walls are inclined


def test_the_upper_side_stays(foot: Foot) -> None:
    (top, _), (plain, _) = faces(solid(foot, ROCKER)), faces(solid(foot))
    assert top[:, 2] == pytest.approx(plain[:, 2], abs=1e-9)


@pytest.mark.parametrize("keys", [
    {}, {"bottom": "following"}, {"shell": Shell()}, {"thickness_mm": 3.0},
], ids=["flat", "following", "shell", "thin"])  # fmt: skip
def test_it_stays_sound_and_leaves_material(foot: Foot, keys: dict[str, object]) -> None:
    mesh = solid(foot, ROCKER, **keys)
    check = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    assert check.is_watertight
    assert check.is_winding_consistent
    assert check.body_count == 1
    assert check.volume > 1e4
    inside = mesh.vertices[: len(mesh.vertices) // 2]
    top, bottom = faces(mesh)
    well = ahead_of_line(foot, inside[:, :2]) > 10
    assert np.median((top - bottom)[well, 2]) >= LEAST_LEFT_MM - 1e-6


@pytest.mark.parametrize("bottom", ["flat", "following"])
def test_a_forefoot_too_thin_for_it_is_warned_of(foot: Foot, bottom: str) -> None:
    def said(thickness_mm: float) -> list[str]:
        design = InsoleDesign(foot.side, (ROCKER,), thickness_mm=thickness_mm, bottom=bottom)
        found = design_warnings(build_insole(foot, design), find_landmarks(foot), load_rules())
        return [w.sentence for w in found if "rocker" in w.sentence]

    (warned,) = said(4.0)
    assert "too thin for the rocker, which leaves 1.5 mm of material" in warned
    assert said(25.0) == []


def test_one_that_is_switched_off_changes_nothing(foot: Foot) -> None:
    off = solid(foot, replace(ROCKER, enabled=False))
    assert np.array_equal(off.vertices, solid(foot).vertices)


def test_it_is_the_same_for_the_other_foot_and_makes_another_body(foot: Foot) -> None:
    assert ROCKER.mirrored() == ROCKER
    plain = InsoleDesign(foot.side)
    assert bare_key(foot, plain) != bare_key(foot, plain.with_added(ROCKER))
