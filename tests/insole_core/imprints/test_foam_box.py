"""Imprints are recognised in foam boxes, cut at the edge of the foam, and turned into soles."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.imprints.foam_box import BoxScan, find_imprints
from tests.insole_core.imprints.boxes import deviations_mm, double_box, pressed, single_box

UP = np.array([0.0, 0.0, 1.0])


def found(mesh: TriangleMesh) -> BoxScan:
    box = find_imprints(mesh)
    assert box is not None
    return box


@pytest.mark.parametrize(
    ("depth_mm", "kind"),
    [
        (28.0, {}),
        (14.0, {}),
        (38.0, {"is_closed": True}),
        (28.0, {"table_mm": 100.0, "lip_mm": 6.0}),
        (22.0, {"noise_mm": 0.5, "curl_mm": 7.0}),
    ],
)
def test_an_imprint_is_the_sole_that_was_pressed_in(left_mesh, depth_mm, kind):
    box = found(single_box(left_mesh, depth_mm, cell_mm=1.2, **kind))

    (imprint,) = box.imprints
    assert box.is_hollow
    assert imprint.dorsal @ UP > 0.999
    assert imprint.depth_mm == pytest.approx(depth_mm, abs=1.0)
    away = deviations_mm(imprint.mesh, pressed(left_mesh, depth_mm))
    assert np.median(away) < 0.3
    assert np.quantile(away, 0.95) < (0.3 if "noise_mm" not in kind else 0.6)


def test_an_imprint_ends_where_the_foam_curls_over(left_mesh):
    (imprint,) = found(single_box(left_mesh, cell_mm=1.2, curl_mm=6.0)).imprints

    foot = pressed(left_mesh)
    below = foot.vertices[foot.vertices[:, 2] < 0]
    beyond = np.abs(imprint.mesh.bounds_mm - [below.min(axis=0), below.max(axis=0)])[:, :2]
    assert (
        beyond.max() < 2.5
    )  # of a cell and the noise; the foam is dragged down over 6 mm and more
    highest = imprint.mesh.vertices[:, 2].max()
    assert -6.5 < highest < 0


def test_an_imprint_faces_out_of_the_foot_however_the_file_does(left_mesh):
    box = single_box(left_mesh, cell_mm=1.5)
    for mesh, is_hollow in ((box, True), (box.flipped(), False)):
        scan = found(mesh)

        (imprint,) = scan.imprints
        assert scan.is_hollow is is_hollow
        facing = imprint.mesh.vertex_normals @ imprint.dorsal
        assert imprint.mesh.vertex_areas @ facing < -0.5 * imprint.mesh.area_mm2


def test_the_pose_of_the_box_does_not_matter(left_mesh):
    box = single_box(left_mesh, cell_mm=1.5, table_mm=80.0)
    (upright,) = found(box).imprints
    turn = rigid(rotation_about(np.array([1.0, 2.0, -0.5]), 130.0), np.array([300.0, -50.0, 20.0]))

    (turned,) = found(box.transformed(turn)).imprints

    assert turned.dorsal @ (turn[:3, :3] @ UP) > 0.9999
    assert turned.mesh.area_mm2 == pytest.approx(upright.mesh.area_mm2, rel=0.02)


@pytest.mark.parametrize("apart_mm", [150.0, 106.0])
def test_both_feet_of_a_box_are_told_apart(left_mesh, right_mesh, apart_mm):
    box = found(double_box([left_mesh, right_mesh], apart_mm, cell_mm=1.5))

    left, right = sorted(box.imprints, key=lambda imprint: float(imprint.centre[0]))
    assert right.centre[0] - left.centre[0] == pytest.approx(apart_mm, abs=6)
    assert left.mesh.area_mm2 == pytest.approx(right.mesh.area_mm2, rel=0.1)
    assert left.mesh.bounds_mm[1, 0] < right.mesh.bounds_mm[0, 0] + 1


def test_a_foot_is_no_imprint(left_mesh):
    floor = np.array([[x, y, 0.5] for x in (-150.0, 150.0) for y in (-200.0, 200.0)])
    count = len(left_mesh.vertices)
    sheet = np.array([[0, 1, 2], [2, 1, 3]], dtype=np.int32) + count
    on_floor = TriangleMesh(
        np.concatenate([left_mesh.vertices, floor]),
        np.concatenate([left_mesh.triangles, sheet]).astype(np.int32),
    )

    assert find_imprints(left_mesh) is None
    assert find_imprints(replace(left_mesh.flipped(), colors=None)) is None
    assert find_imprints(on_floor) is None
    assert find_imprints(on_floor.flipped()) is None
