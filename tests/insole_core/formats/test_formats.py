"""What other programs read from the files: the same solid, in mm, with names and colours."""

from __future__ import annotations

import errno
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import trimesh
from tetrahedron import CORNERS, FACES

from insole_core.errors import OutputError, UsageError
from insole_core.formats.file_formats import SOLID_SUFFIXES
from insole_core.formats.solid_content import merged, write_solids
from insole_core.formats.stl import write_ascii_stl
from insole_core.formats.three_mf import CORE, OWN, SolidPart, write_3mf
from insole_core.geometry.mesh import TriangleMesh

COLORS = np.array([[255, 0, 0], [0, 255, 0], [0, 0, 255], [9, 8, 7]], np.uint8)
TETRA = TriangleMesh(CORNERS, FACES, COLORS)


def amf_by_hand(path: Path) -> trimesh.Trimesh:
    """What ISO/ASTM 52915 says of a file, since trimesh does not read AMF."""
    root = ElementTree.parse(path).getroot()
    assert root.get("unit") == "millimeter"
    places = [[float(axis.text or "") for axis in place] for place in root.iter("coordinates")]
    faces = [[int(corner.text or "") for corner in face] for face in root.iter("triangle")]
    return trimesh.Trimesh(places, faces)


@pytest.mark.parametrize("suffix", SOLID_SUFFIXES)
@pytest.mark.parametrize("name", ["insole", "Fuß – 足 'x' & y"])
def test_every_format_keeps_size_and_volume(suffix, name, tmp_path: Path):
    path = tmp_path / f"{name}{suffix}"
    write_solids([SolidPart(TETRA, "left")], path)
    read = amf_by_hand(path) if suffix == ".amf" else trimesh.load_mesh(path)
    assert read.bounds[1] == pytest.approx([10, 20, 30.125])
    assert read.volume == pytest.approx(TETRA.volume_mm3)
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_obj_and_ply_keep_colours(tmp_path: Path):
    for suffix in (".obj", ".ply"):
        path = tmp_path / f"foot{suffix}"
        write_solids([SolidPart(TETRA, "foot")], path)
        read = trimesh.load_mesh(path, process=False)
        assert np.array_equal(read.visual.vertex_colors[:, :3], COLORS)


def test_ply_paints_parts_without_colours_of_their_own(tmp_path: Path):
    plain = TriangleMesh(CORNERS, FACES)
    parts = [SolidPart(plain, "cover", (200, 10, 20)), SolidPart(plain, "shell", (1, 2, 3))]
    write_solids(parts, tmp_path / "i.ply")
    colors = trimesh.load_mesh(tmp_path / "i.ply", process=False).visual.vertex_colors[:, :3]
    assert colors.tolist() == [[200, 10, 20]] * 4 + [[1, 2, 3]] * 4


def test_ascii_stl_is_text_with_the_same_numbers(tmp_path: Path):
    path = tmp_path / "a.stl"
    write_ascii_stl(TETRA, path)
    assert path.read_text().startswith("solid ")
    read = trimesh.load_mesh(path)
    assert read.volume == pytest.approx(TETRA.volume_mm3)
    assert read.is_watertight


def test_3mf_keeps_zones_apart(tmp_path: Path):
    path = tmp_path / "zones.3mf"
    parts = [
        SolidPart(TETRA, 'heel "soft" <1>', (255, 128, 0), 15.0),
        SolidPart(TETRA.transformed(np.diag([1.0, 1, 1, 1])), "Längsgewölbe 足"),
    ]
    write_3mf(parts, path, "Åsa & Co")
    with zipfile.ZipFile(path) as archive:
        model = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
    assert model.get("unit") == "millimeter"
    objects = model.findall(f".//{{{CORE}}}object")
    assert [o.get("name") for o in objects] == [part.name for part in parts]
    bases = model.findall(f".//{{{CORE}}}base")
    assert bases[0].get("displaycolor") == "#FF8000"
    density = objects[0].find(f".//{{{CORE}}}metadata")
    assert density is not None
    assert density.get("name") == "insole:density_percent"
    assert density.text == "15"
    assert OWN.encode() in zipfile.ZipFile(path).read("3D/3dmodel.model")
    assert objects[1].find(f".//{{{CORE}}}metadata") is None
    assert len(trimesh.load(path).geometry) == 2


def test_other_formats_put_the_parts_side_by_side(tmp_path: Path):
    path = tmp_path / "pair.stl"
    away = np.eye(4)
    away[0, 3] = 50
    write_solids([SolidPart(TETRA, "left"), SolidPart(TETRA.transformed(away), "right")], path)
    read = trimesh.load_mesh(path)
    assert read.body_count == 2
    assert read.volume == pytest.approx(2 * TETRA.volume_mm3)
    assert merged([TETRA]) is TETRA


def test_unknown_format(tmp_path: Path):
    with pytest.raises(UsageError, match=r"choose \.stl, \.3mf, \.ply, \.obj"):
        write_solids([SolidPart(TETRA, "left")], tmp_path / "insole.step")


@pytest.mark.parametrize("suffix", SOLID_SUFFIXES)
def test_full_disk_leaves_the_old_file(suffix, tmp_path: Path, monkeypatch):
    path = tmp_path / f"insole{suffix}"
    path.write_text("of yesterday")

    def full(*_arguments, **_options):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "open", full)
    monkeypatch.setattr(zipfile.ZipFile, "writestr", full)
    with pytest.raises(OutputError, match="the disk is full"):
        write_solids([SolidPart(TETRA, "left")], path)
    monkeypatch.undo()
    assert path.read_text() == "of yesterday"
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("suffix", SOLID_SUFFIXES)
def test_places_that_cannot_be_written(suffix, tmp_path: Path):
    with pytest.raises(OutputError, match="its folder does not exist"):
        write_solids([SolidPart(TETRA, "left")], tmp_path / "no" / f"insole{suffix}")
    taken = tmp_path / f"folder{suffix}"
    taken.mkdir()
    with pytest.raises(OutputError, match="a folder of that name"):
        write_solids([SolidPart(TETRA, "left")], taken)
