from __future__ import annotations

import numpy as np
from small_range_meshes import CAMERA, flat, sheet_of

from insole_core.geometry.mesh import TriangleMesh
from insole_core.reconstruct.views.range_mesh import join, without_small_pieces


def test_a_full_lattice_gives_two_triangles_a_square() -> None:
    sheet = sheet_of(flat(600.0), (0, 0, -600))
    assert len(sheet.triangles) == 2 * 63 * 47


def test_triangles_face_the_sensor() -> None:
    depth = flat(600.0) + np.linspace(0, 40, 64) + np.linspace(-10, 10, 48)[:, None]
    mesh = join([sheet_of(depth, (0, 0, -600))])
    assert (mesh.triangle_normals[:, 2] < -0.5).all()


def test_a_missing_corner_leaves_half_a_square() -> None:
    depth = flat(600.0)
    depth[20, 30] = np.nan
    sheet = sheet_of(depth, (0, 0, -600))
    # Six triangles met there, or fewer where the diagonals ran past; four squares keep one half.
    assert len(sheet.triangles) == 2 * 63 * 47 - 4
    assert not (sheet.triangles == 20 * 64 + 30).any()


def test_a_jump_in_depth_is_no_surface() -> None:
    depth = flat(600.0)
    depth[:, 40:] = 700.0
    sheet = sheet_of(depth, (0, 0, -600))
    assert len(sheet.triangles) == 2 * 47 * (39 + 23)
    assert np.ptp(sheet.corners[:, :, 2], axis=1).max() == 0


def test_the_flatter_diagonal_halves_a_square() -> None:
    depth = flat(600.0)
    depth[11, 21] += 30.0  # one raised corner: its square is folded along the other diagonal
    ridge = np.abs(np.arange(48)[:, None] - np.arange(64)[None]) * 4.0
    triangles = sheet_of(600.0 + ridge, (0, 0, -600)).triangles
    v, u = np.divmod(triangles, CAMERA.width)
    along_valley = [
        set(zip(v[i], u[i], strict=True)) >= {(10, 10), (11, 11)} for i in range(len(v))
    ]
    assert sum(along_valley) == 2


def test_small_pieces_go_and_large_ones_stay() -> None:
    depth = flat(600.0)
    depth[:, 30] = np.nan
    depth[:8, :] = np.nan
    depth[2:5, 50:53] = 600.0
    sheet = sheet_of(depth, (0, 0, -600))
    left = without_small_pieces(sheet)
    assert len(sheet.triangles) - len(left.triangles) == 8
    assert left.corners[..., 0].min() < 0 < left.corners[..., 0].max()


def test_pieces_that_meet_corner_to_corner_are_two() -> None:
    depth = np.full((48, 64), np.nan)
    depth[0:30, 0:30] = 600.0
    depth[30:33, 30:33] = 600.0
    sheet = sheet_of(depth, (0, 0, -600))
    assert len(without_small_pieces(sheet).triangles) == 2 * 29 * 29


def test_an_empty_sheet_stays_empty() -> None:
    sheet = sheet_of(flat(np.nan), (0, 0, -600))
    assert len(without_small_pieces(sheet).triangles) == 0


def test_joining_keeps_only_what_is_used() -> None:
    depth = flat(600.0)
    depth[:, 10:] = np.nan
    sheet = sheet_of(depth, (0, 0, -600))
    mesh: TriangleMesh = join([sheet, sheet])
    assert len(mesh.vertices) == 2 * 48 * 10
    assert mesh.colors is not None
    assert mesh.colors.shape == mesh.vertices.shape
    assert mesh.triangles.max() == len(mesh.vertices) - 1
