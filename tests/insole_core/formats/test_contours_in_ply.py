"""The outlines of a reconstructed foot travel with its file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from insole_core.formats.ply import write_ply
from insole_core.geometry.mesh import ContourConstraints
from insole_core.scans.mesh_file import read_mesh


def test_touches_come_back_from_a_file(left_mesh, tmp_path: Path) -> None:
    points = np.array([[1.0, 2.0, 3.0], [-40.5, 20.0, 12.25]])
    normals = np.array([[0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]])
    path = tmp_path / "foot.ply"
    write_ply(replace(left_mesh, touches=ContourConstraints(points, normals)), path)
    read = read_mesh(path).mesh
    assert read.touches is not None
    assert read.touches.points == pytest.approx(points)
    assert read.touches.normals == pytest.approx(normals, abs=1e-6)
    others = trimesh.load_mesh(path, process=False)
    assert len(others.faces) == len(left_mesh.triangles), "other programs read the mesh alone"


def test_a_mesh_without_touches_has_none(left_mesh, tmp_path: Path) -> None:
    path = tmp_path / "foot.ply"
    write_ply(left_mesh, path)
    assert b"touch" not in path.read_bytes()[:600]
    assert read_mesh(path).mesh.touches is None
