"""A damaged or hostile file of a format with parts is refused in one clear sentence."""

from __future__ import annotations

import base64
import io
import json
import re
import struct
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest
import trimesh
from PIL import Image
from tetrahedron import CORNERS, FACES, TETRA

from insole_core.errors import InputError
from insole_core.formats.reading import read_raw
from insole_core.formats.scan_content import file_content
from insole_core.formats.solid_content import SolidPart, write_solids
from insole_core.geometry.arrays import FloatArray, IndexArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.scans.mesh_file import read_mesh

LAUGHS = b'<!DOCTYPE x [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>'
OUTSIDE = b'<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/hostname">]>'

Change = Callable[[bytes], bytes]


def amf(folder: Path) -> bytes:
    path = folder / "sound.amf"
    write_solids([SolidPart(TETRA, "left")], path)
    return path.read_bytes()


def dae(folder: Path) -> bytes:
    content: bytes = trimesh.Trimesh(CORNERS, FACES, process=False).export(file_type="dae")
    return content


def gltf(corners: FloatArray, faces: IndexArray, *, parts: int = 1, nodes: int = 1) -> bytes:
    """Return a glTF of a mesh of equal parts, which several nodes place."""
    data = corners.astype("<f4").tobytes() + faces.astype("<u4").tobytes()
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    of_faces = {"buffer": 0, "byteOffset": 12 * len(corners), "byteLength": 4 * faces.size}
    root = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0] * nodes}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}] * parts}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(corners), "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": faces.size, "type": "SCALAR"},
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 12 * len(corners)}, of_faces],
        "buffers": [{"uri": uri, "byteLength": len(data)}],
    }
    return json.dumps(root).encode()


def many_nodes(_: bytes) -> bytes:
    return gltf(np.repeat(CORNERS, 1250, axis=0), FACES, nodes=5000)


def corner_of_another_part(_: bytes) -> bytes:
    return gltf(CORNERS, FACES + np.int32(1), parts=2)


def packed(*names: str) -> Change:
    def change(content: bytes) -> bytes:
        file = io.BytesIO()
        with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
            for name in names:
                archive.writestr(name, content)
        return file.getvalue()

    return change


def bomb(content: bytes) -> bytes:
    archive = bytearray(packed("foot.amf")(content))
    struct.pack_into("<I", archive, archive.rindex(b"PK\1\2") + 24, 700 * 2**20)
    return bytes(archive)


def swapped(old: bytes, new: bytes) -> Change:
    return lambda content: content.replace(old, new, 1)


def behind_head(more: bytes) -> Change:
    return lambda content: re.sub(rb"^(<\?.*?\?>|)", lambda head: head[0] + more, content, count=1)


def behind(more: bytes) -> Change:
    return lambda content: content.replace(b"</visual_scene>", more + b"</visual_scene>", 1)


def of_unit(metres: bytes) -> Change:
    unit = b'<unit name="unit"' + (b' meter="' + metres + b'"' if metres else b"") + b"/>"

    def change(content: bytes) -> bytes:
        return re.sub(rb"<unit[^>]*/>|(?=</asset>)", unit, content, count=1)

    return change


def instances(*names: bytes) -> bytes:
    return b"".join(b'<instance objectid="' + name + b'"/>' for name in names)


def constellation(name: bytes, *parts: bytes) -> bytes:
    return b'<constellation id="' + name + b'">' + instances(*parts) + b"</constellation>"


def many_corners(content: bytes) -> bytes:
    vertex = re.search(rb"<vertex>.*?</vertex>", content, re.DOTALL)
    assert vertex is not None
    content = content.replace(b"</vertices>", vertex[0] * 5000 + b"</vertices>")
    return content.replace(b"</amf>", constellation(b"9", *[b"2"] * 5000) + b"</amf>")


def many_triangles(content: bytes) -> bytes:
    content = re.sub(rb"<p>(.*?)</p>", lambda p: b"<p>" + p[1] + b" " * 2_000_000 + b"</p>",
                     content, flags=re.DOTALL)  # fmt: skip
    instance = re.search(rb"<instance_geometry.*?</instance_geometry>", content, re.DOTALL)
    assert instance is not None
    return content.replace(instance[0], instance[0] * 100)


def hiding_an_archive(content: bytes) -> bytes:
    end_of_archive = b"PK\5\6" + b"AA" * 9  # of any numbers that are letters
    text = re.sub(r"^<\?.*?\?>", "", content.decode())
    return ("\ufeff" + text + f"<!--{end_of_archive.decode('utf-16-le')}-->").encode("utf-16-le")


def in_itself(content: bytes) -> bytes:
    return behind(b'<node id="a"><instance_node url="#a"/></node>')(content)


BAD: dict[str, tuple[str, Change, str]] = {
    "AMF cut off": (".amf", lambda content: content[: len(content) // 2], "damaged or cut off"),
    "AMF that is no XML": (".amf", lambda _: b"amf", "follow the rules of the format"),
    "AMF of another unit": (".amf", swapped(b"millimeter", b"parsec"), "unit parsec is none"),
    "AMF with laughs": (".amf", behind_head(LAUGHS), "declares entities"),
    "AMF that names a file": (".amf", behind_head(OUTSIDE), "declares entities"),
    "AMF, corner beyond": (".amf", swapped(b"<v1>0<", b"<v1>9<"), "corner that it does not hold"),
    "AMF, corner below": (".amf", swapped(b"<v1>0<", b"<v1>-1<"), "corner that it does not hold"),
    "AMF, huge corner": (".amf", swapped(b"<v1>0<", b"<v1>1e30<"), "follow the rules"),
    "AMF, word for a number": (".amf", swapped(b"<x>0.0", b"<x>one"), "follow the rules"),
    "AMF, corner is no number": (".amf", swapped(b"<v1>0<", b"<v1>nan<"), "follow the rules"),
    "AMF without a coordinate": (".amf", swapped(b"<x>0.00000</x>", b""), "lacks 'x'"),
    "AMF, corner between": (".amf", swapped(b"<v1>0<", b"<v1>0.9<"), "follow the rules"),
    "AMF of a type": (".amf", behind_head(b"<!DOCTYPE amf>"), "a type of its document"),
    "AMF, 5000 corners 5000 times": (".amf", many_corners, "far more corners"),
    "AMF, circle": (
        ".amf",
        swapped(b"</amf>", constellation(b"8", b"9") + constellation(b"9", b"9") + b"</amf>"),
        "contain each other",
    ),
    "AMF without objects": (".amf", lambda _: b"<amf></amf>", "holds no object"),
    "AMF, archive of two": (".amf", packed("a.amf", "b.amf"), "no model, or several"),
    "AMF, archive without one": (".amf", packed("a.txt"), "no model, or several"),
    "AMF bomb": (".amf", bomb, "larger than 572 MB"),
    "COLLADA cut off": (".dae", lambda content: content[: len(content) // 2], "damaged or cut off"),
    "COLLADA that is no XML": (".dae", lambda _: b"COLLADA", "follow the rules of the format"),
    "COLLADA of something else": (".dae", lambda _: b"<scene/>", "follow the rules"),
    "COLLADA with laughs": (".dae", behind_head(LAUGHS), "declares entities"),
    "COLLADA that names a file": (".dae", behind_head(OUTSIDE), "declares entities"),
    "COLLADA, word for a number": (".dae", swapped(b" 10 0", b" ten 0"), "not fit together"),
    "COLLADA, fewer numbers": (".dae", swapped(b" 30.125", b""), "not fit together"),
    "COLLADA, corner beyond": (".dae", swapped(b"<p>0", b"<p>7777"), "not fit together"),
    "COLLADA, source missing": (".dae", swapped(b'N" source="#', b'N" source="#no'), "the rules"),
    "COLLADA, unit of no length": (".dae", of_unit(b"-1"), "unit is no length"),
    "COLLADA, nodes in a circle": (".dae", in_itself, "contain each other"),
    "COLLADA, 100 000 parts": (".dae", behind(b"<node/>" * 100_000), "far more parts"),
    "COLLADA, 1 000 000 polygons": (".dae", behind(b"<p/>" * 1_000_001), "far more parts"),
    "COLLADA, large mesh 100 times": (".dae", many_triangles, "far too many"),
    "COLLADA, corner below": (".dae", swapped(b"<p>0", b"<p>-1"), "corner that it does not hold"),
    "COLLADA of a type": (".dae", behind_head(b"<!DOCTYPE COLLADA>"), "a type of its document"),
    "COLLADA that hides an archive": (".dae", hiding_an_archive, "hides a zip archive"),
    "COLLADA, archive": (".dae", packed("foot.dae"), "zip archive"),
    "glTF, 5000 corners 5000 times": (".gltf", many_nodes, "far more corners"),
    "glTF, corner of another part": (
        ".gltf",
        corner_of_another_part,
        "corner that it does not hold",
    ),
    "STL in the name of an AMF": (".amf", lambda _: b"solid x\n", "something else than its name"),
}
SOUND = {".amf": amf, ".dae": dae, ".gltf": lambda _: gltf(CORNERS, FACES)}


@pytest.mark.parametrize("what", BAD)
def test_a_bad_file_is_one_sentence(what: str, tmp_path: Path) -> None:
    suffix, change, words = BAD[what]
    path = tmp_path / f"foot{suffix}"
    path.write_bytes(change(SOUND[suffix](tmp_path)))
    with pytest.raises(InputError, match=re.escape(words)) as refused:
        read_raw(file_content(path))
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("suffix", "number"), [(".amf", b"<y>20.00000"), (".dae", b" 20 0")], ids=["AMF", "COLLADA"]
)
def test_a_coordinate_that_is_no_number_is_refused(
    suffix: str, number: bytes, tmp_path: Path
) -> None:
    path = tmp_path / f"foot{suffix}"
    nan = re.sub(rb"\d+", b"nan", number, count=1).replace(b".00000", b"")
    path.write_bytes(swapped(number, nan)(SOUND[suffix](tmp_path)))
    with pytest.raises(InputError, match=r"coordinates (that are not|in it are no) numbers"):
        read_mesh(path)


def test_an_amf_in_an_archive_is_moved_to_where_its_constellation_says(tmp_path: Path) -> None:
    place = b"""<constellation id="9"><instance objectid="2"><deltax>5</deltax><rz> 90 </rz>
        </instance></constellation></amf>"""
    content = amf(tmp_path).replace(b"</amf>", place).replace(b"millimeter", b"inch")
    path = tmp_path / "foot.amf"
    path.write_bytes(packed("foot.amf")(content))
    raw = read_raw(file_content(path))
    assert raw.unit == "inch"
    assert raw.vertices == pytest.approx(CORNERS @ [[0, 1, 0], [-1, 0, 0], [0, 0, 1]] + [5, 0, 0])


def test_bodies_of_one_assembly_are_one_object_of_an_amf(tmp_path: Path) -> None:
    layers = [SolidPart(TETRA, name, assembly="left") for name in ("cover", "base")]
    path = tmp_path / "layers.amf"
    write_solids([*layers, SolidPart(TETRA, "Fuß & <wedge>")], path, label="P-17")
    text = path.read_text(encoding="utf-8")
    assert text.count("<object ") == 2
    assert text.count("<volume ") == 3
    assert "Insole P-17" in text
    assert "Fuß &amp; &lt;wedge&gt;" in text
    assert len(read_raw(file_content(path)).triangles) == 3 * len(FACES)


def test_nodes_of_a_gltf_place_one_mesh_twice(tmp_path: Path) -> None:
    path = tmp_path / "foot.gltf"
    path.write_bytes(gltf(CORNERS, FACES, nodes=2))
    raw = read_raw(file_content(path))
    assert raw.vertices == pytest.approx(np.tile(CORNERS, (2, 1)))
    assert raw.triangles.tolist() == [*FACES.tolist(), *(FACES + 4).tolist()]


def test_constellations_of_an_amf_hold_each_other(tmp_path: Path) -> None:
    inner = constellation(b"3", b"2").replace(b"/>", b"><deltax>5</deltax></instance>")
    outer = constellation(b"2", b"3", b"3").replace(b"/>", b"><deltay>7</deltay></instance>", 1)
    path = tmp_path / "foot.amf"  # one is numbered as the object is
    path.write_bytes(amf(tmp_path).replace(b"</amf>", outer + inner + b"</amf>"))
    raw = read_raw(file_content(path))
    moves = np.array([[5.0, 0, 0], [5, 7, 0]])
    expected = (CORNERS + moves[:, None]).reshape(-1, 3)
    assert np.unique(raw.vertices, axis=0) == pytest.approx(np.unique(expected, axis=0))


SOUND_DAE: dict[str, Change] = {
    "a picture named as no number": swapped(
        b"</source>", b"</source><extra><init_from>Hernandez.png</init_from></extra>"),
    "a unit of another part": swapped(
        b"<library_geometries>",
        b'<library_geometries><asset><created>2026-01-01</created><modified>2026-01-01</modified>'
        b'<unit name="inch" meter="0.0254"/></asset>'),
    "100 000 polygons": swapped(
        b"</mesh>",
        b"<polygons><input semantic='VERTEX' source='#verts-array-vertices' offset='0'/>"
        + b"<p>0 1 2</p>" * 100_000 + b"</polygons></mesh>"),
}  # fmt: skip


@pytest.mark.parametrize("what", SOUND_DAE)
def test_a_sound_collada_is_read(what: str, tmp_path: Path) -> None:
    path = tmp_path / "foot.dae"
    path.write_bytes(SOUND_DAE[what](of_unit(b"0.001")(dae(tmp_path))))
    raw = read_raw(file_content(path))
    assert raw.unit == "mm"
    assert raw.vertices[raw.triangles[: len(FACES)]] == pytest.approx(CORNERS[FACES])


@pytest.mark.parametrize(("metres", "unit", "factor"), [
    (b"0.001", "mm", 1.0), (b"0.01", "cm", 1.0), (b"1", "m", 1.0), (b"0.0254", "inch", 1.0),
    (b"0.1", "m", 0.1), (b"", "m", 1.0),
])  # fmt: skip
def test_a_collada_states_its_unit(metres: bytes, unit: str, factor: float, tmp_path: Path) -> None:
    path = tmp_path / "foot.dae"
    path.write_bytes(of_unit(metres)(dae(tmp_path)))
    raw = read_raw(file_content(path))
    assert raw.unit == unit
    assert raw.vertices[raw.triangles] == pytest.approx(CORNERS[FACES] * factor)


def test_a_collada_that_states_no_unit_leaves_it_open(tmp_path: Path) -> None:
    path = tmp_path / "foot.dae"
    path.write_bytes(dae(tmp_path))
    assert read_raw(file_content(path)).unit is None


def test_a_node_of_a_collada_moves_and_mirrors_its_mesh(tmp_path: Path) -> None:
    matrix = b"<matrix>-1 0 0 5  0 1 0 0  0 0 1 0  0 0 0 1</matrix>"
    path = tmp_path / "foot.dae"
    path.write_bytes(re.sub(rb"<matrix.*?</matrix>|(?=<instance_geometry)", matrix,
                            dae(tmp_path), count=1, flags=re.DOTALL))  # fmt: skip
    raw = read_raw(file_content(path))
    mesh = TriangleMesh(raw.vertices, raw.triangles)
    assert mesh.bounds_mm == pytest.approx(np.array([[-5.0, 0, 0], [5, 20, 30.125]]))
    assert mesh.volume_mm3 == pytest.approx(TETRA.volume_mm3)


@pytest.mark.parametrize(
    "texture",
    [
        "skin.png",
        "deep.png",
        "../skin.png",
        "none.png",
        "cut.png",
        "head.png",
        "http://[skin.png",
    ],
)
def test_the_texture_of_a_collada_lies_beside_it(texture: str, tmp_path: Path) -> None:
    folder = tmp_path / "scan"
    folder.mkdir()
    picture = np.zeros((8, 8, 3), np.uint8)
    picture[:, :4] = (20, 10, 200)  # blue, green, red, as OpenCV has them
    for place in (folder, tmp_path):
        cv2.imwrite(str(place / "skin.png"), picture)
    cv2.imwrite(str(folder / "deep.png"), picture[..., 2].astype(np.uint16) * 257)
    whole = (folder / "skin.png").read_bytes()
    (folder / "cut.png").write_bytes(whole[:40])
    (folder / "head.png").write_bytes(whole[:33])
    material = trimesh.visual.material.PBRMaterial(baseColorTexture=Image.new("RGB", (8, 8)))
    uv = np.array([[0.1, 0.5], [0.9, 0.5], [0.1, 0.5], [0.9, 0.5]])
    shape = trimesh.Trimesh(
        CORNERS, FACES, process=False, visual=trimesh.visual.TextureVisuals(uv, material=material)
    )
    content: bytes = shape.export(file_type="dae")
    path = folder / "foot.dae"
    path.write_bytes(textured(content, texture.encode()))
    raw = read_raw(file_content(path))
    if texture not in ("skin.png", "deep.png"):
        assert raw.colors is None
        assert "is not beside the scan" in str(raw.notes[0])
        return
    assert raw.colors is not None
    assert raw.notes == ()
    reds = raw.colors[:, 0].reshape(-1, 3)
    assert (reds == np.where(np.isin(FACES, [0, 2]), 200, 0)).all()


def test_a_collada_is_read_without_what_the_bundle_leaves_out(tmp_path: Path) -> None:
    path = tmp_path / "foot.dae"
    path.write_bytes(dae(tmp_path))
    script = """
import sys
sys.modules.update(dict.fromkeys(("lxml", "networkx", "shapely", "jsonschema")))
from pathlib import Path
from insole_core.formats.reading import read_raw
from insole_core.formats.scan_content import file_content
print(len(read_raw(file_content(Path(sys.argv[1]))).triangles))
"""
    call = [sys.executable, "-c", script, str(path)]
    done = subprocess.run(call, check=True, capture_output=True, text=True)
    assert done.stdout.split() == ["4"]


def textured(content: bytes, name: bytes) -> bytes:
    """Give a COLLADA of trimesh, which writes no pictures, one of its own folder."""
    image = b'<library_images><image id="i"><init_from>' + name + b"</init_from></image>"
    effect = b"""<newparam sid="s"><surface type="2D"><init_from>i</init_from></surface></newparam>
        <newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>"""
    content = content.replace(b"<library_effects", image + b"</library_images><library_effects")
    content = content.replace(b"<profile_COMMON>", b"<profile_COMMON>" + effect)
    diffuse = b'<diffuse><texture texture="t" texcoord="UV"/></diffuse>'
    return re.sub(rb"<diffuse>.*?</diffuse>", diffuse, content, flags=re.DOTALL)
