"""Scans as scanners leave them: coarse, noisy, torn, on glass; the foot is found."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.formats.ply import write_ply
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_about, rotation_angle_deg
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape
from insole_core.workflows.import_scan import examine_scan

TURN = rotation_about(np.array([1.0, 2.0, 0.5]), 140.0)


def joined(*meshes: TriangleMesh) -> TriangleMesh:
    first = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    triangles = [mesh.triangles + start for mesh, start in zip(meshes, first, strict=False)]
    return TriangleMesh(
        np.vstack([mesh.vertices for mesh in meshes]), np.vstack(triangles).astype(np.int32)
    )


def coarse(mesh: TriangleMesh) -> TriangleMesh:
    """2000 triangles."""
    import pyvista as pv

    surface = pv.PolyData.from_regular_faces(mesh.vertices, mesh.triangles)
    surface = surface.decimate(1 - 2000 / len(mesh.triangles))
    return TriangleMesh(np.asarray(surface.points, dtype=float), surface.regular_faces)


def with_outliers(mesh: TriangleMesh) -> TriangleMesh:
    """5 % of the vertices lie some 15 mm off."""
    rng = np.random.default_rng(3)
    off = rng.choice(len(mesh.vertices), len(mesh.vertices) // 20, replace=False)
    vertices = mesh.vertices.copy()
    vertices[off] += rng.normal(scale=15.0, size=(len(off), 3))
    return mesh.moved(vertices)


def with_hole(mesh: TriangleMesh) -> TriangleMesh:
    """Nothing was seen under the arch."""
    x, y, z = mesh.vertices.T
    middle = 0.45 * np.ptp(y)
    x_mm = np.median(x[(np.abs(y - middle) < 10) & (z < 40)])
    return mesh.part((np.hypot(x - x_mm, y - middle) > 22) | (z > 35))


def with_fins(mesh: TriangleMesh) -> TriangleMesh:
    """Double triangles, and edges with three of them."""
    rng = np.random.default_rng(3)
    double = mesh.triangles[rng.choice(len(mesh.triangles), 200, replace=False)]
    start, end, _ = mesh.triangles[rng.choice(len(mesh.triangles), 50, replace=False)].T
    tips = mesh.vertices[start] + 3 * mesh.vertex_normals[start]
    fins = np.column_stack([start, end, len(mesh.vertices) + np.arange(50)])
    triangles = np.vstack([mesh.triangles, double, double[:, ::-1], fins])
    return TriangleMesh(np.vstack([mesh.vertices, tips]), triangles.astype(np.int32))


def on_glass(mesh: TriangleMesh) -> TriangleMesh:
    """A sheet of glass below the foot, 60 mm larger on all sides."""
    least, most = mesh.bounds_mm[:, :2] + np.array([[-60.0], [60.0]])
    count = 30
    x, y = np.meshgrid(*np.linspace(least, most, count).T)
    corner = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    triangles = np.vstack(
        [
            np.column_stack([corner, corner + 1, corner + count]),
            np.column_stack([corner + 1, corner + count + 1, corner + count]),
        ]
    )
    sheet = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, -0.5)])
    return joined(mesh, TriangleMesh(sheet, triangles.astype(np.int32)))


def with_inner_layer(mesh: TriangleMesh) -> TriangleMesh:
    """Another surface 2 mm within."""
    return joined(mesh, mesh.moved(mesh.vertices - 2 * mesh.vertex_normals).flipped())


@pytest.fixture(scope="module")
def left_foot() -> Foot:
    """A left foot in fewer triangles than elsewhere."""
    mesh = build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=4.0).mesh
    return place_foot(mesh, Side.LEFT, frame="reference")


@pytest.mark.parametrize(
    ("rough", "said"),
    [
        (coarse, ""),
        (with_outliers, "points stuck out of the surface"),
        (with_hole, "The surface is open"),
        (with_fins, ""),
        (on_glass, "A flat sheet of"),
        (with_inner_layer, "it lies within the surface"),
    ],
)
def test_the_foot_is_found_and_what_was_left_out_is_said(
    left_foot: Foot, tmp_path: Path, rough: Callable[[TriangleMesh], TriangleMesh], said: str
) -> None:
    path = tmp_path / "scan.ply"
    write_ply(rough(left_foot.mesh).transformed(rigid(TURN, np.array([100.0, 50.0, 20.0]))), path)
    examination = examine_scan(path)
    (found,) = examination.feet
    likely = found.candidates[0]
    assert likely.side is Side.LEFT
    assert likely.length_mm == pytest.approx(left_foot.length_mm, rel=0.01)
    assert rotation_angle_deg(likely.source2insole[:3, :3] @ TURN) < 3
    assert said in " ".join((*examination.notes, *examination.left_out, *found.notes))
