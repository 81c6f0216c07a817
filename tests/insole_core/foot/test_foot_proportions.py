"""What has no size or proportions of a foot is refused with its numbers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import trimesh

from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.foot.foot_proportions import check_length
from insole_core.formats.units import UnitReading
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.solids.solid import insole_solid
from insole_core.workflows.scan_doubts import foot_text

make = trimesh.creation
Shape = Callable[[TriangleMesh], TriangleMesh]


def own(shape: trimesh.Trimesh) -> TriangleMesh:
    return TriangleMesh(np.array(shape.vertices, float), np.array(shape.faces, np.int32))


def scaled(factor: float) -> Shape:
    return lambda foot: replace(foot, vertices=foot.vertices * factor)


def heel_half(foot: TriangleMesh) -> TriangleMesh:
    y = foot.vertices[:, 1]
    return foot.part(y < y.min() + 0.5 * np.ptp(y))


NO_FEET: dict[str, tuple[Shape, str]] = {
    "box": (
        lambda _: own(make.box((90, 240, 60)).subdivide().subdivide()),
        "no proportions of a foot",
    ),
    "plate of 5 mm": (lambda _: own(make.box((90, 240, 5))), "no proportions of a foot: 2.."),
    "capsule": (lambda _: own(make.capsule(180, 35)), "no proportions of a foot"),
    "heel half": (heel_half, "no proportions of a foot"),
    "EU 55": (scaled(1.5), "a foot of 36. mm, and feet are 90 to 350 mm"),
    "doll": (scaled(0.35), "a foot of 8. mm"),
}


@pytest.mark.parametrize("what", NO_FEET)
def test_what_is_no_foot_is_refused(left_mesh: TriangleMesh, what: str) -> None:
    shape, words = NO_FEET[what]
    with pytest.raises(InputError, match=words):
        place_foot(shape(left_mesh), Side.LEFT, frame="unknown")


def test_the_guessed_length_of_a_foot_without_toes_is_not_told() -> None:
    with pytest.raises(InputError) as caught:
        check_length(420.0, 357.0)
    assert "357 mm of a foot without its toes" in str(caught.value)
    assert "420" not in str(caught.value)
    doubted = foot_text(UnitReading("cm", 420.0, 357.0))
    assert doubted == "357 mm (no foot)"


def test_a_finished_insole_is_no_foot(left_foot: Foot) -> None:
    insole = insole_solid(build_insole(left_foot, InsoleDesign(Side.LEFT, grid_mm=2.0)))
    with pytest.raises(InputError, match=r"mm thick on average .* as if it were an insole"):
        place_foot(insole, Side.LEFT, frame="unknown")


@pytest.mark.parametrize("factor", [0.5, 1.25])
def test_children_and_giants_have_feet(left_mesh: TriangleMesh, factor: float) -> None:
    foot = place_foot(scaled(factor)(left_mesh), Side.LEFT, frame="unknown")
    assert foot.length_mm == pytest.approx(246 * factor, rel=0.02)


def test_the_user_may_insist_on_proportions_and_on_a_length(left_mesh: TriangleMesh) -> None:
    block = own(make.box((90, 240, 60)))
    assert place_foot(block, Side.LEFT, frame="unknown", force=True).length_mm > 200
    long = scaled(1.45)(left_mesh)
    assert place_foot(long, Side.LEFT, frame="unknown", force=True).length_mm > 350
    with pytest.raises(InputError, match="feet are 90 to 350 mm"):
        place_foot(scaled(2.05)(left_mesh), Side.LEFT, frame="unknown", force=True)
