"""Binary STL: what another program reads is what was written, or nothing appears."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from insole_core.errors import OutputError
from insole_core.formats.stl import write_stl
from insole_core.geometry.mesh import TriangleMesh

WEDGE = TriangleMesh(
    np.array([[0, 0, 0], [3, 0, 0], [0, 2, 0], [0, 0, 1.25]]),
    np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], np.int32),
)


def test_trimesh_reads_back_the_same_solid(tmp_path):
    path = tmp_path / "wedge.stl"
    write_stl(WEDGE, path)
    read = trimesh.load_mesh(path)
    assert read.is_watertight
    assert read.is_winding_consistent
    assert read.volume == pytest.approx(WEDGE.volume_mm3)
    assert np.array_equal(read.triangles, WEDGE.vertices[WEDGE.triangles])


def test_layout_of_the_bytes(tmp_path):
    path = tmp_path / "wedge.stl"
    write_stl(WEDGE, path)
    content = path.read_bytes()
    assert len(content) == 84 + 4 * 50
    assert not content.startswith(b"solid")
    assert b"unit mm" in content[:80]
    assert int.from_bytes(content[80:84], "little") == 4
    assert np.frombuffer(content[84:96], "<f4") == pytest.approx([0, 0, -1])


def test_unwritable_place_leaves_nothing(tmp_path):
    with pytest.raises(OutputError, match="folder does not exist"):
        write_stl(WEDGE, tmp_path / "none" / "wedge.stl")
    assert list(tmp_path.iterdir()) == []
