"""Every format gives the same foot: with its colours, in its place, the right way out."""

from __future__ import annotations

import base64
import io
import json
import sys
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from insole_core.errors import InputError
from insole_core.formats.reading import read_raw
from insole_core.formats.scan_content import file_content
from insole_core.formats.solid_content import SolidPart
from insole_core.formats.three_mf import write_3mf
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.scans.mesh_file import read_mesh
from insole_core.scans.scan_folder import holds_scans, scan_parts, side_of_name
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape


@pytest.fixture(scope="module")
def small_foot() -> TriangleMesh:
    """A left foot in few triangles."""
    return build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=5.0).mesh


def as_trimesh(mesh: TriangleMesh) -> trimesh.Trimesh:
    return trimesh.Trimesh(mesh.vertices, mesh.triangles, vertex_colors=mesh.colors, process=False)


def largest_distance_mm(mesh: TriangleMesh, foot: TriangleMesh) -> float:
    return float(cKDTree(foot.vertices).query(mesh.vertices)[0].max())


@pytest.mark.parametrize("suffix", [".off", ".3mf", ".glb", ".dae"])
def test_formats_of_other_programs_give_the_same_closed_surface(small_foot, tmp_path, suffix):
    path = tmp_path / f"foot{suffix}"
    as_trimesh(small_foot).export(path)
    read = read_mesh(path)
    assert read.unit == "mm"
    assert read.mesh.is_closed
    assert read.mesh.volume_mm3 == pytest.approx(small_foot.volume_mm3, rel=1e-5)
    assert largest_distance_mm(read.mesh, small_foot) < 1e-3


def test_a_gltf_with_its_buffer_beside_it_is_read_in_metres(small_foot, tmp_path):
    metres = replace(small_foot, vertices=small_foot.vertices / 1000)
    files = as_trimesh(metres).scene().export(file_type="gltf")
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    read = read_mesh(tmp_path / "model.gltf")
    assert read.unit == "m"
    assert largest_distance_mm(read.mesh, small_foot) < 1e-3
    assert read.mesh.colors is not None


def test_nodes_of_a_glb_move_turn_and_mirror_their_mesh(small_foot, tmp_path):
    scene = trimesh.Scene()
    turned = trimesh.transformations.rotation_matrix(0.7, [1, 2, 3], [10, 20, 30])
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    mirrored = replace(small_foot, vertices=small_foot.vertices * [-1, 1, 1]).flipped()
    scene.add_geometry(as_trimesh(mirrored), transform=turned @ mirror)
    scene.export(tmp_path / "foot.glb")
    read = read_mesh(tmp_path / "foot.glb")
    foot = small_foot.transformed(turned)
    assert largest_distance_mm(read.mesh, foot) < 1e-3
    assert read.mesh.volume_mm3 == pytest.approx(small_foot.volume_mm3, rel=1e-5)
    assert not any("inside out" in note for note in read.notes)


def test_three_mf_keeps_its_unit(small_foot, tmp_path):
    path = tmp_path / "foot.3mf"
    write_3mf([SolidPart(replace(small_foot, vertices=small_foot.vertices / 25.4), "foot")], path)
    content = {}
    with zipfile.ZipFile(path) as archive:
        content = {name: archive.read(name) for name in archive.namelist()}
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in content.items():
            archive.writestr(name, text.replace(b'unit="millimeter"', b'unit="inch"'))
    read = read_mesh(path)
    assert read.unit == "inch"
    assert largest_distance_mm(read.mesh, small_foot) < 1e-2


def halves(mesh: TriangleMesh) -> tuple[np.ndarray, np.ndarray]:
    """Texture coordinates (n, 2) and colours (n, 3): red in the left half, green in the right."""
    share = mesh.vertices[:, 1] - mesh.vertices[:, 1].min()
    share = share / share.max()
    colors = np.where((share < 0.5)[:, None], [200, 10, 20], [10, 180, 30])
    return np.column_stack([share, np.full(len(share), 0.25)]), colors


def write_picture(path: Path) -> None:
    """A picture whose lower left is red, lower right green, and all above blue."""
    picture = np.zeros((64, 64, 3), np.uint8)
    picture[:, :] = (255, 0, 0)
    picture[32:, :32] = (20, 10, 200)
    picture[32:, 32:] = (30, 180, 10)
    cv2.imwrite(str(path), picture)


def share_of_right_colors(mesh: TriangleMesh, foot: TriangleMesh) -> float:
    assert mesh.colors is not None
    expected = halves(foot)[1][cKDTree(foot.vertices).query(mesh.vertices)[1]]
    return float((np.abs(mesh.colors.astype(int) - expected).max(axis=1) < 8).mean())


def write_textured_obj(mesh: TriangleMesh, folder: Path) -> Path:
    uv, _ = halves(mesh)
    lines = ["mtllib my colours.mtl"]
    lines += ["v {:.5f} {:.5f} {:.5f}".format(*place) for place in mesh.vertices]
    lines += ["vt {:.5f} {:.5f}".format(*place) for place in uv]
    lines += ["vn 0 0 1", "usemtl skin"]
    corners = mesh.triangles + 1
    lines += ["f {0}/{0}/1 {1}/{1}/1 {2}/{2}/1".format(*corner) for corner in corners]
    (folder / "foot.obj").write_text("\r\n".join(lines))
    (folder / "my colours.mtl").write_text(
        "newmtl skin\r\nKd 1 1 1\r\nmap_Kd -s 1 1 1 skin.png\r\n"
    )
    write_picture(folder / "skin.png")
    return folder / "foot.obj"


def test_the_texture_of_an_obj_becomes_colours(small_foot, tmp_path):
    read = read_mesh(write_textured_obj(small_foot, tmp_path))
    assert read.mesh.is_closed
    assert share_of_right_colors(read.mesh, small_foot) > 0.99


@pytest.mark.parametrize("missing", ["skin.png", "my colours.mtl"])
def test_an_obj_without_its_texture_is_read_and_it_is_said(small_foot, tmp_path, missing):
    path = write_textured_obj(small_foot, tmp_path)
    (tmp_path / missing).unlink()
    read = read_mesh(path)
    assert read.mesh.colors is None
    assert any(missing in note and "is not beside the scan" in note for note in read.notes)


def test_a_texture_outside_of_the_folder_is_not_read(small_foot, tmp_path):
    folder = tmp_path / "scan"
    folder.mkdir()
    path = write_textured_obj(small_foot, folder)
    (folder / "skin.png").rename(tmp_path / "skin.png")
    (folder / "my colours.mtl").write_text("newmtl skin\nmap_Kd ../skin.png\n")
    assert read_mesh(path).mesh.colors is None


@pytest.mark.parametrize("where", ["inside", "data"])
def test_the_texture_of_a_glb_becomes_colours(small_foot, tmp_path, where):
    write_picture(tmp_path / "skin.png")
    picture = (tmp_path / "skin.png").read_bytes()
    uv, _ = halves(small_foot)
    arrays = [
        small_foot.vertices.astype("<f4").tobytes(),
        np.column_stack([uv[:, 0], 1 - uv[:, 1]]).astype("<f4").tobytes(),
        small_foot.triangles.astype("<u4").tobytes(),
        picture,
    ]
    starts = np.cumsum([0, *map(len, arrays)])
    image = {"bufferView": 3, "mimeType": "image/png"}
    if where == "data":
        image = {"uri": "data:image/png;base64," + base64.b64encode(picture).decode()}
    count = len(small_foot.vertices)
    root = {
        "asset": {"version": "2.0"},
        "meshes": [{"primitives": [
            {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}
        ]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [image],
        "buffers": [{"byteLength": int(starts[-1])}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": int(start), "byteLength": len(array)}
            for start, array in zip(starts[:-1], arrays, strict=True)
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5126, "count": count, "type": "VEC2"},
            {"bufferView": 2, "componentType": 5125, "count": 3 * len(small_foot.triangles),
             "type": "SCALAR"},
        ],
    }  # fmt: skip
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    binary = b"".join(arrays)
    binary += b"\0" * (-len(binary) % 4)
    chunks = b"".join(
        len(chunk).to_bytes(4, "little") + kind + chunk
        for kind, chunk in ((b"JSON", text), (b"BIN\0", binary))
    )
    head = b"glTF" + (2).to_bytes(4, "little") + (12 + len(chunks)).to_bytes(4, "little")
    (tmp_path / "foot.glb").write_bytes(head + chunks)
    assert share_of_right_colors(read_mesh(tmp_path / "foot.glb").mesh, small_foot) > 0.99


def points_with(columns: list[str], mesh: TriangleMesh) -> np.ndarray:
    assert mesh.colors is not None
    parts = {"xyz": mesh.vertices, "rgb": mesh.colors, "normals": mesh.vertex_normals}
    return np.column_stack([parts[name] for name in columns])


def comma(text: str) -> str:
    return text.replace(".", ",")


FORMS: dict[str, tuple[str, list[str], Callable[[str], str]]] = {
    "points": ("foot.xyz", ["xyz"], str),
    "commas": ("foot.xyz", ["xyz", "normals"], comma),
    "head": ("foot.asc", ["xyz", "rgb", "normals"],
             lambda text: "// X Y Z R G B Nx Ny Nz\n" + text),
    "separated": ("foot.asc", ["xyz", "normals", "rgb"], lambda text: text.replace(" ", ", ")),
    "semicolons": ("foot.asc", ["xyz"], lambda text: comma(text.replace(" ", ";"))),
    "pts": ("foot.pts", ["xyz", "rgb"], lambda text: f"{text.count(chr(10))}\n{text}"),
}  # fmt: skip


def write_points(form: str, mesh: TriangleMesh, folder: Path) -> Path:
    name, columns, change = FORMS[form]
    text = io.StringIO()
    kinds = [kind for column in columns for kind in 3 * ["%d" if column == "rgb" else "%.4f"]]
    np.savetxt(text, points_with(columns, mesh), kinds)
    (folder / name).write_text(change(text.getvalue()))
    return folder / name


@pytest.mark.parametrize("form", FORMS)
def test_points_are_read_from_texts_of_any_form(
    small_foot: TriangleMesh, tmp_path: Path, form: str
) -> None:
    columns = FORMS[form][1]
    raw = read_raw(file_content(write_points(form, small_foot, tmp_path)))
    np.testing.assert_allclose(raw.vertices, small_foot.vertices, rtol=0, atol=1e-4)
    assert (raw.colors is not None) == ("rgb" in columns)
    assert raw.colors is None or np.array_equal(raw.colors, small_foot.colors)
    assert (raw.normals is not None) == ("normals" in columns)
    if raw.normals is not None:
        np.testing.assert_allclose(raw.normals, small_foot.vertex_normals, rtol=0, atol=1e-4)


@pytest.mark.parametrize("form", ["points", "head"])
def test_points_become_a_surface_that_faces_outwards(
    left_mesh: TriangleMesh, tmp_path: Path, form: str
) -> None:
    read = read_mesh(write_points(form, left_mesh, tmp_path))
    assert read.mesh.volume_mm3 == pytest.approx(left_mesh.volume_mm3, rel=0.02)
    assert largest_distance_mm(read.mesh, left_mesh) < 3.0
    assert (read.mesh.colors is not None) == ("rgb" in FORMS[form][1])
    assert any("A surface was laid through" in note for note in read.notes)


def test_points_far_from_all_others_are_left_out(small_foot, tmp_path):
    stray = np.random.default_rng(3).uniform(-400, 400, (len(small_foot.vertices) // 20, 3))
    trimesh.PointCloud(np.concatenate([small_foot.vertices, stray])).export(tmp_path / "foot.ply")
    read = read_mesh(tmp_path / "foot.ply")
    assert np.ptp(read.mesh.vertices, axis=0) == pytest.approx(
        np.ptp(small_foot.vertices, axis=0), abs=4.0
    )
    assert any("far from all others were left out" in note for note in read.notes)


@pytest.mark.parametrize(
    ("name", "side"),
    [
        ("left_foot", Side.LEFT), ("Fuss rechts", Side.RIGHT), ("scan-L", Side.LEFT),
        ("Pied_Droit", Side.RIGHT), ("höger", Side.RIGHT), ("RightFoot2", Side.RIGHT),
        ("both left and right", None), ("roller", None), ("scan 2", None), ("Leftover", None),
        ("R_Svensson_1", None), ("Fuss der Patientin", None),
    ],
)  # fmt: skip
def test_names_tell_the_side_only_by_whole_words(name, side):
    assert side_of_name(name) is side


@pytest.mark.parametrize("packed", [False, True])
def test_a_folder_or_archive_with_both_feet(small_foot, tmp_path, packed):
    right_mesh = replace(small_foot, vertices=small_foot.vertices * [-1, 1, 1]).flipped()
    folder = tmp_path / "visit"
    folder.mkdir()
    as_trimesh(small_foot).export(folder / "Anna left.stl")
    as_trimesh(right_mesh).export(folder / "Anna right.stl")
    place = folder
    if packed:
        place = tmp_path / "visit.zip"
        with zipfile.ZipFile(place, "w") as archive:
            for path in folder.iterdir():
                archive.write(path, f"visit/{path.name}")
    assert holds_scans(place)
    assert [part.side for part in scan_parts(place)] == [Side.LEFT, Side.RIGHT]
    read = read_mesh(place, side=Side.RIGHT)
    assert largest_distance_mm(read.mesh, right_mesh) < 1e-3
    both = read_mesh(place)
    assert both.second is not None
    assert largest_distance_mm(both.mesh, small_foot) < 1e-3
    assert largest_distance_mm(both.second.mesh, right_mesh) < 1e-3
    with pytest.raises(InputError, match="two scans of the left foot"):
        scan_parts(folder_with(tmp_path / "twice", "left a.stl", "left b.stl"))


@pytest.mark.parametrize(
    ("names", "sides"),
    [
        (["L/scan.stl", "R/scan.stl"], [Side.LEFT, Side.RIGHT]),
        (["Anna Left/scan.stl"], [None]),
        (["left/a.stl", "left/b.stl"], [None, None]),
        (["left/a right.stl", "right/b left.stl"], [Side.LEFT, Side.RIGHT]),
        (["left/a left right.stl", "right/b.stl"], [None, Side.RIGHT]),
    ],
)
def test_a_folder_tells_a_side_only_beside_one_of_the_other_side(tmp_path, names, sides):
    for name in names:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    assert [part.side for part in scan_parts(tmp_path)] == sides


def folder_with(folder: Path, *names: str) -> Path:
    folder.mkdir()
    for name in names:
        (folder / name).touch()
    return folder


@pytest.mark.parametrize(("suffixes", "read"), [
    ((".asc", ".pts", ".xyz"), ".xyz"), ((".asc", ".pts"), ".asc"), ((".glb", ".gltf"), ".glb"),
])  # fmt: skip
def test_of_one_scan_in_several_forms_the_first_named_is_read(tmp_path, suffixes, read):
    folder = folder_with(tmp_path / "visit", *(f"scan{suffix}" for suffix in suffixes))
    assert [part.path.suffix for part in scan_parts(folder)] == [read]


def test_an_archive_with_one_scan_and_its_texture(small_foot, tmp_path):
    write_textured_obj(small_foot, tmp_path)
    place = tmp_path / "phone.zip"
    with zipfile.ZipFile(place, "w") as archive:
        for name in ("foot.obj", "my colours.mtl", "skin.png"):
            archive.write(tmp_path / name, f"export/{name}")
    assert share_of_right_colors(read_mesh(place).mesh, small_foot) > 0.99


def test_quads_and_relative_corners_of_an_obj(tmp_path):
    box = trimesh.creation.box([260, 100, 90])
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    corners = box.bounds[[0, 1]]
    places = [[corners[i][0], corners[j][1], corners[k][2]]
              for i in (0, 1) for j in (0, 1) for k in (0, 1)]  # fmt: skip
    text = "".join("  v {} {} {} 1.0\n".format(*place) for place in places)
    text += "".join("f " + " ".join(f"{n - 8}//1" for n in quad) + "\n" for quad in quads[:3])
    text += "".join("f " + " ".join(f"{n + 1}" for n in quad) + "\n" for quad in quads[3:])
    (tmp_path / "box.obj").write_text(text)
    mesh = read_mesh(tmp_path / "box.obj").mesh
    assert mesh.is_closed
    assert mesh.volume_mm3 == pytest.approx(260 * 100 * 90)


@pytest.mark.parametrize("encoding", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_a_ply_with_quads_triangles_and_other_properties(tmp_path, encoding):
    places = np.array([[i, j, k] for i in (0, 260) for j in (0, 100) for k in (0, 90)], float)
    faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7],
             [1, 7, 3]]  # fmt: skip
    head = (
        f"ply\nformat {encoding} 1.0\ncomment a box\nelement vertex 8\nproperty double x\n"
        "property double y\nproperty double z\nproperty uchar quality\nelement face 7\n"
        "property uchar flags\nproperty list uchar int vertex_indices\nend_header\n"
    )
    order = ">" if "big" in encoding else "<"
    if encoding == "ascii":
        body = "".join("{} {} {} 7\n".format(*place) for place in places)
        body += "".join(f"1 {len(face)} {' '.join(map(str, face))}\n" for face in faces)
        content = (head + body).encode()
    else:
        content = head.encode()
        content += b"".join(place.astype(order + "f8").tobytes() + b"\7" for place in places)
        content += b"".join(
            bytes([1, len(face)]) + np.array(face, order + "i4").tobytes() for face in faces
        )
    (tmp_path / "box.ply").write_bytes(content)
    mesh = read_mesh(tmp_path / "box.ply").mesh
    assert mesh.is_closed
    assert mesh.volume_mm3 == pytest.approx(260 * 100 * 90)


def write_usdz(mesh: TriangleMesh, path: Path, *, metres: float | None, more: str = "") -> None:
    """A scan as phones write it: lying on its back, y up, a texture, corners of their own."""
    usd, geometry, shade = (pytest.importorskip(f"pxr.{n}") for n in ("Usd", "UsdGeom", "UsdShade"))
    sdf = pytest.importorskip("pxr.Sdf")
    scene = path.with_suffix(".usdc")
    stage = usd.Stage.CreateNew(str(scene))
    geometry.SetStageUpAxis(stage, geometry.Tokens.y)
    if metres is not None:
        geometry.SetStageMetersPerUnit(stage, metres)
    root = geometry.Xform.Define(stage, "/Scan")
    root.AddTranslateOp().Set((3.0, 0.0, 1.0))
    surface = geometry.Mesh.Define(stage, "/Scan/Foot")
    scale = 0.001 / (metres or 1.0)
    surface.CreatePointsAttr((scale * mesh.vertices - [3.0, 0.0, 1.0]).astype(np.float32))
    surface.CreateFaceVertexCountsAttr(np.full(len(mesh.triangles), 3))
    surface.CreateFaceVertexIndicesAttr(mesh.triangles.ravel())
    corners = geometry.PrimvarsAPI(surface).CreatePrimvar(
        "st", sdf.ValueTypeNames.TexCoord2fArray, geometry.Tokens.faceVarying
    )
    corners.Set(halves(mesh)[0][mesh.triangles.ravel()].astype(np.float32))
    material = shade.Material.Define(stage, "/Scan/Material")
    shader = shade.Shader.Define(stage, "/Scan/Material/Surface")
    picture = shade.Shader.Define(stage, "/Scan/Material/Picture")
    shader.CreateIdAttr("UsdPreviewSurface")
    picture.CreateIdAttr("UsdUVTexture")
    picture.CreateInput("file", sdf.ValueTypeNames.Asset).Set("./textures/foot.png")
    color = picture.CreateOutput("rgb", sdf.ValueTypeNames.Float3)
    shader.CreateInput("diffuseColor", sdf.ValueTypeNames.Color3f).ConnectToSource(color)
    material.CreateSurfaceOutput().ConnectToSource(
        shader.CreateOutput("surface", sdf.ValueTypeNames.Token)
    )
    shade.MaterialBindingAPI.Apply(surface.GetPrim()).Bind(material)
    if more:
        stage.GetRootLayer().subLayerPaths.append(more)
    stage.GetRootLayer().Save()
    write_picture(path.with_suffix(".png"))
    with zipfile.ZipFile(path, "w") as archive:
        archive.write(scene, "foot.usdc")
        archive.write(path.with_suffix(".png"), "textures/foot.png")
    scene.unlink()
    path.with_suffix(".png").unlink()


@pytest.mark.parametrize(
    ("metres", "unit"), [(1.0, "m"), (0.01, "cm"), (0.001, "mm"), (0.5, "m"), (None, "m")]
)
def test_a_usdz_of_a_phone_keeps_colours_unit_and_place(small_foot, tmp_path, metres, unit):
    path = tmp_path / "scan.usdz"
    write_usdz(small_foot, path, metres=metres)
    read = read_mesh(path)
    assert read.unit == unit
    assert largest_distance_mm(read.mesh, small_foot) < 2e-2
    assert share_of_right_colors(read.mesh, small_foot) > 0.98
    raw = read_raw(file_content(path))
    assert raw.unit == (None if metres is None else unit)


def test_a_usdz_reads_no_file_beside_it_and_what_is_damaged_is_told(small_foot, tmp_path):
    path = tmp_path / "scan.usdz"
    write_usdz(small_foot, path, metres=1.0, more=str(tmp_path / "other.usda"))
    with pytest.raises(InputError, match="put together from other files"):
        read_raw(file_content(path))
    for content in (b"PXR-USDC" + bytes(200), b"#usda 1.0\ndef Mesh {", b""):
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("foot.usdc" if content.startswith(b"PXR") else "foot.usda", content)
        with pytest.raises(InputError, match="damaged or cut off"):
            read_raw(file_content(path))
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("readme.txt", "nothing")
    with pytest.raises(InputError, match="holds no scene"):
        read_raw(file_content(path))


def test_a_usdz_without_its_library_says_what_to_do(small_foot, tmp_path, monkeypatch):
    path = tmp_path / "scan.usdz"
    write_usdz(small_foot, path, metres=1.0)
    monkeypatch.setitem(sys.modules, "pxr", None)
    monkeypatch.delitem(sys.modules, "insole_core.formats.usd", raising=False)
    with pytest.raises(InputError, match=r"library pxr, which.*export the scan as \.glb"):
        read_raw(file_content(path))
