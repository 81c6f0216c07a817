"""Whole cases beside the standard one, by real events, from the scan to the files for the shop."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hands import Hands

from insole_core.cases.case_file import read_case
from insole_core.formats.obj import write_obj
from insole_core.formats.ply import write_ply
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott, Posting
from insole_core.resources import resource_path
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate import FootShape, build_foot
from insole_core.workflows.foot_landmarks import metatarsal_line

pytestmark = pytest.mark.slow

PAIR_ACTIONS, SINGLE_ACTIONS = 12, 9


@pytest.fixture
def real_foot() -> TriangleMesh:
    """The right foot of the example, which was captured."""
    current = read_case(resource_path("example/example.insole")).current
    assert current is not None
    return current.foot.mesh


@pytest.fixture
def right_foot() -> TriangleMesh:
    return build_foot(FootShape(side=Side.RIGHT), np.random.default_rng(2), cell_mm=4.0).mesh


def mirrored(mesh: TriangleMesh) -> TriangleMesh:
    return TriangleMesh(mesh.vertices * [-1, 1, 1], mesh.triangles[:, ::-1], mesh.colors)


def sole_alone(mesh: TriangleMesh) -> TriangleMesh:
    """What a plantar scanner sees: the low part of the foot that faces the glass, no colours."""
    seen = (mesh.vertex_normals[:, 2] < -0.05) & (mesh.vertices[:, 2] < 40.0)
    number = np.cumsum(seen) - 1
    inside = mesh.triangles[seen[mesh.triangles].all(axis=1)]
    return TriangleMesh(mesh.vertices[seen], number[inside].astype(np.int32))


def solid_of(path: Path) -> TriangleMesh:
    return read_mesh(path).mesh


def place_pelott(hands: Hands) -> None:
    hands.choose("tool_pelott")
    line = metatarsal_line(hands.app.case.record)
    assert line is not None
    x, y, _ = line[1]
    hands.click((x, y - 45.0))


def test_both_feet_are_prescribed_mirrored_and_exported_together(
    hands: Hands, real_foot: TriangleMesh, tmp_path: Path
) -> None:
    write_ply(real_foot, tmp_path / "right.ply")
    write_ply(mirrored(real_foot), tmp_path / "left.ply")
    hands.open(tmp_path / "left.ply", Side.LEFT)
    hands.choose("confirm_landmarks")
    place_pelott(hands)
    hands.choose("tool_posting")
    hands.app.case.select(None)
    hands.type("posting.rearfoot_deg", "4")
    hands.type("insole.thickness_mm", "4")

    hands.open(tmp_path / "right.ply", Side.RIGHT)
    hands.choose("confirm_landmarks")
    hands.take_notice("Prescribe it here, mirrored")
    hands.export(tmp_path / "insole.stl")

    left, right = hands.app.case.record.feet
    for foot, medial in ((left, 1), (right, -1)):
        pad, posting = foot.design.corrections
        assert isinstance(pad, Pelott)
        assert isinstance(posting, Posting)
        assert posting.rearfoot_deg == 4.0
        assert foot.design.thickness_mm == 4.0
        # Mirror images, of which each finds its ball for itself.
        assert pad.centre_mm[0] * medial == pytest.approx(
            left.design.corrections[0].centre_mm[0], abs=0.5
        )
    made = [solid_of(tmp_path / f"insole-{side}.stl") for side in ("left", "right")]
    sizes = [np.ptp(solid.vertices, axis=0) for solid in made]
    assert sizes[0] == pytest.approx(sizes[1], abs=0.5)
    assert hands.actions <= PAIR_ACTIONS
    print(f"{hands.actions} actions")


def test_a_sole_alone_becomes_an_insole(
    hands: Hands, right_foot: TriangleMesh, tmp_path: Path
) -> None:
    scan = tmp_path / "plantar.obj"
    write_obj(sole_alone(right_foot), scan)
    hands.open(scan, Side.RIGHT)
    (notice,) = hands.app.services.notices.notices
    assert "where nothing was measured it is continued" in notice.text
    hands.choose("confirm_landmarks")
    place_pelott(hands)
    hands.choose("add_heel_cup")
    hands.type("correction.depth_mm", "14")
    hands.type("insole.thickness_mm", "4")
    hands.export(tmp_path / "insole.stl")
    solid = solid_of(tmp_path / "insole-right.stl")
    assert np.ptp(solid.vertices[:, 1]) > 230
    assert solid.vertices[:, 2].min() == pytest.approx(0.0, abs=0.01)
    assert hands.actions <= SINGLE_ACTIONS
    print(f"{hands.actions} actions")
