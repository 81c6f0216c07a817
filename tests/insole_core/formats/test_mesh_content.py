"""A mesh file holds what it declares, or it is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh

from insole_core.errors import InputError
from insole_core.formats.obj import write_obj
from insole_core.formats.ply import write_ply
from insole_core.formats.stl import write_ascii_stl, write_stl
from insole_core.geometry.mesh import TriangleMesh
from insole_core.scans.mesh_file import read_mesh


def text_ply(mesh: TriangleMesh, path: Path) -> None:
    trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False).export(path, encoding="ascii")


WRITERS: dict[str, Callable[[TriangleMesh, Path], None]] = {
    "foot.ply": text_ply,
    "binary.ply": write_ply,
    "binary.stl": write_stl,
    "text.stl": write_ascii_stl,
    "foot.obj": write_obj,
}


@pytest.fixture
def content(
    request: pytest.FixtureRequest, left_mesh: TriangleMesh, tmp_path: Path
) -> tuple[Path, bytes]:
    path = tmp_path / request.param
    WRITERS[request.param](left_mesh, path)
    return path, path.read_bytes()


def refuse(path: Path, content: bytes, words: str) -> None:
    path.write_bytes(content)
    with pytest.raises(InputError, match=words):
        read_mesh(path)


@pytest.mark.parametrize("content", ["foot.ply"], indirect=True)
def test_a_ply_holds_as_much_as_it_declares(
    content: tuple[Path, bytes], left_mesh: TriangleMesh
) -> None:
    path, text = content
    refuse(path, text[: int(0.7 * len(text))], "damaged or cut off")
    refuse(path, text[: text.rindex(b"\n", 0, -1) + 1], "damaged or cut off")
    line = f"element face {len(left_mesh.triangles)}".encode()
    for declared in (b"1000000000", b"0", str(len(left_mesh.triangles) - 1).encode()):
        refuse(
            path, text.replace(line, b"element face " + declared), "does not hold exactly as many"
        )
    for declared in (b"-5", b"many", b"7" * 400, b""):
        refuse(path, text.replace(line, b"element face " + declared), "without a number")
    refuse(path, text.replace(line, line + b"\n" + line), "declares something twice")
    refuse(path, text.replace(b"end_header", b"no_header"), "no header of a PLY")


@pytest.mark.parametrize("content", ["binary.ply"], indirect=True)
def test_a_binary_ply_holds_as_much_as_it_declares(
    content: tuple[Path, bytes], left_mesh: TriangleMesh
) -> None:
    path, whole = content
    held = len(left_mesh.triangles)
    for declared in (held - 1, held + 1):
        wrong = whole.replace(f"face {held}".encode(), f"face {declared}".encode())
        refuse(path, wrong, "does not hold exactly as many")
    path.write_bytes(whole + b"\r\n" + bytes(2))
    assert len(read_mesh(path).mesh.triangles) == held


@pytest.mark.parametrize("content", ["binary.stl"], indirect=True)
def test_a_binary_stl_holds_as_much_as_it_declares(
    content: tuple[Path, bytes], left_mesh: TriangleMesh
) -> None:
    path, whole = content
    held = len(left_mesh.triangles)
    refuse(path, whole[: 84 + 50 * 99 + 7], f"declares {held} triangles and holds 99")
    refuse(path, whole + bytes(450) + b"x" * 50, f"declares {held} triangles and holds {held + 10}")
    for odd in (whole + b"end\n", b"solid" + whole[5:]):
        path.write_bytes(odd)
        assert len(read_mesh(path).mesh.triangles) == held


@pytest.mark.parametrize("content", ["text.stl"], indirect=True)
def test_a_text_stl_has_an_end(content: tuple[Path, bytes]) -> None:
    path, text = content
    refuse(path, text[: text.rindex(b" facet normal")], 'does not end in "endsolid"')


@pytest.mark.parametrize("content", ["foot.obj"], indirect=True)
def test_an_obj_counts_from_one(content: tuple[Path, bytes]) -> None:
    path, text = content
    for line in (b"f 0 1 2", b"f 1 2 0\r", b"f 3/1 0/2 4/3", b"f 1 2 -0"):
        refuse(path, text + line + b"\n", "corner 0, but an OBJ counts from 1")
    path.write_bytes(text + b"f 10 20 30\n")
    read_mesh(path)


def test_mixed_up_corners_are_no_surface(left_mesh: TriangleMesh, tmp_path: Path) -> None:
    corners = np.random.default_rng(1).permutation(left_mesh.triangles.ravel()).reshape(-1, 3)
    path = tmp_path / "foot.stl"
    write_stl(TriangleMesh(left_mesh.vertices, corners), path)
    with pytest.raises(InputError, match="their corners are mixed up"):
        read_mesh(path)
