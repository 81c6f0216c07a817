"""What each of more than forty damaged or odd files gives: a foot, or one clear sentence.

Each is read in a process of its own with a limit on its memory. Fails if one ends in a traceback,
takes more than 20 s of processor time, or more than 1.5 GB.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import resource
import struct
import sys
import tempfile
import time
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import trimesh

from benchmarks._measure import print_table
from insole_core.errors import InsoleError
from insole_core.formats.solid_content import SolidPart, write_solids
from insole_core.formats.stl import write_stl
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape

MOST_SECONDS, MOST_BYTES = 20, 1_500_000_000
Case = tuple[str, str, Callable[[Path], None]]
"""What is odd, the name of the file, and what writes it."""


def foot() -> TriangleMesh:
    mesh = build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=4.0).mesh
    return TriangleMesh(mesh.vertices, mesh.triangles)


def content(suffix: str, mesh: TriangleMesh, encoding: str | None = None) -> bytes:
    shape = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    extra = {} if encoding is None else {"encoding": encoding}
    kind = "stl_ascii" if suffix == "stl" and encoding else suffix
    made = shape.export(file_type=kind, **({} if kind == "stl_ascii" else extra))
    return made.encode() if isinstance(made, str) else bytes(made)


def written(suffix: str, mesh: TriangleMesh) -> bytes:
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / f"foot.{suffix}"
        write_solids([SolidPart(mesh, "foot")], path)
        return path.read_bytes()


def cases(mesh: TriangleMesh) -> Iterator[Case]:  # noqa: PLR0915 - a table
    def put(data: bytes) -> Callable[[Path], None]:
        return lambda path: (path.write_bytes(data) and None) or None

    stl, text_stl = content("stl", mesh), content("stl", mesh, "ascii")
    ply, text_ply = content("ply", mesh), content("ply", mesh, "ascii")
    obj, off, glb = content("obj", mesh), content("off", mesh), content("glb", mesh)
    points = "".join("{:.4f} {:.4f} {:.4f}\n".format(*place) for place in mesh.vertices)
    yield "missing", "none.stl", lambda _path: None
    yield "empty", "empty.stl", put(b"")
    yield "blanks only", "blank.obj", put(b"  \n\n\t\n")
    yield "a folder without a scan", "folder", lambda path: path.mkdir()
    yield "STL cut off", "cut.stl", put(stl[: len(stl) // 2])
    yield "STL that declares 4 billion", "huge.stl", put(stl[:80] + b"\xff" * 4 + stl[84:])
    yield "STL, 'solid' in a binary head", "solid.stl", put(b"solid x".ljust(80) + stl[80:])
    yield "STL text, cut off", "text.stl", put(text_stl[: len(text_stl) // 2])
    yield "STL text in UTF-16", "utf16.stl", put(text_stl.decode().encode("utf-16"))
    yield "STL text, CRLF", "crlf.stl", put(text_stl.replace(b"\n", b"\r\n"))
    yield "STL with NaN", "nan.stl", put(stl[:96] + struct.pack("<f", np.nan) + stl[100:])
    yield "PLY under the name of an STL", "ply.stl", put(ply)
    yield "PLY cut off", "cut.ply", put(ply[: len(ply) * 2 // 3])
    yield (
        "PLY that declares 100 million points",
        "many.ply",
        put(ply.replace(f"vertex {len(mesh.vertices)}".encode(), b"vertex 100000000")),
    )
    yield (
        "PLY text that is said to be binary",
        "binary.ply",
        put(text_ply.replace(b"format ascii", b"format binary_little_endian")),
    )
    yield "PLY text, cut off", "text.ply", put(text_ply[: len(text_ply) // 2])
    yield (
        "PLY with a wrong corner",
        "corner.ply",
        put(text_ply.rstrip().rpartition(b"\n")[0] + b"\n3 0 1 99999999\n"),
    )
    yield "PLY with an unknown type", "type.ply", put(ply.replace(b"float x", b"quark x"))
    yield "OBJ cut off within a line", "cut.obj", put(obj[: len(obj) // 3 * 2 - 3])
    yield "OBJ with the corner 0", "zero.obj", put(obj + b"\nf 0 1 2\n")
    yield "OBJ with a word for a number", "word.obj", put(obj.replace(b"v ", b"v one ", 1))
    yield "OBJ with decimal commas", "comma.obj", put(obj.replace(b".", b","))
    yield "OBJ without its MTL", "mtl.obj", put(b"mtllib none.mtl\nusemtl skin\n" + obj)
    yield (
        "OBJ, MTL outside of the folder",
        "out.obj",
        put(b"mtllib ../../../../etc/passwd\nusemtl skin\n" + obj),
    )
    yield "OBJ, texture is no picture", "texture.obj", with_texture(obj, b"no picture")
    yield "OBJ, texture of 2 gigapixels", "bomb.obj", with_texture(obj, large_png())
    yield "OBJ in UTF-16", "utf16.obj", put(obj.decode().encode("utf-16"))
    yield (
        "OFF that declares 10⁹ points",
        "many.off",
        put(off.replace(f"{len(mesh.vertices)} ".encode(), b"999999999 ", 1)),
    )
    yield "OFF cut off", "cut.off", put(off[: len(off) // 2])
    yield "GLB cut off", "cut.glb", put(glb[: len(glb) // 2])
    yield "GLB of version 1", "one.glb", put(glb[:4] + struct.pack("<I", 1) + glb[8:])
    yield "GLB with 2³¹ points", "count.glb", put(changed(glb, many_points))
    yield "GLB with nodes in a circle", "circle.glb", put(changed(glb, circle))
    yield "GLB with Draco", "draco.glb", put(changed(glb, draco))
    yield "glTF with its buffer outside", "out.gltf", put(outside(glb))
    yield "glTF that is no JSON", "no.gltf", put(b'{"asset": {')
    yield "3MF that is no archive", "no.3mf", put(b"PK\3\4" + b"\0" * 500)
    yield "3MF bomb, 4 GB of zeros", "bomb.3mf", three_mf_bomb
    yield "3MF with entities in entities", "laughs.3mf", three_mf(laughs())
    yield "3MF without an item to build", "item.3mf", three_mf(b"<model><resources/></model>")
    yield "3MF with parts in a circle", "circle.3mf", three_mf(circular_model())
    amf, dae = written("amf", mesh), content("dae", mesh)
    yield "AMF cut off", "cut.amf", put(amf[: len(amf) // 2])
    yield "AMF that declares entities", "laughs.amf", put(laughs() + amf)
    yield "AMF with a corner beyond", "corner.amf", put(amf.replace(b"<v1>", b"<v1>9999999", 1))
    yield "AMF that is no archive", "no.amf", put(b"PK\3\4" + b"\0" * 500)
    yield "COLLADA cut off", "cut.dae", put(dae[: len(dae) // 2])
    yield "COLLADA that declares entities", "laughs.dae", put(laughs() + dae)
    yield "COLLADA with a corner beyond", "corner.dae", put(dae.replace(b"<p>", b"<p>9999999", 1))
    yield "COLLADA with a million elements", "many.dae", put(b"<a>" + b"<b/>" * 1_000_000 + b"</a>")
    yield "COLLADA, 300 MB of blanks", "blank.dae", put(b"<a>" + b" " * 300_000_000 + b"</a>")
    yield "zip with 3000 scans", "many.zip", many_scans
    yield "zip that leads out of itself", "slip.zip", slipping(stl)
    yield "XYZ with decimal commas", "comma.xyz", put(points.replace(".", ",").encode())
    yield (
        "XYZ, commas everywhere",
        "commas.xyz",
        put(points.replace(".", ",").replace(" ", ",").encode()),
    )
    yield "XYZ with lines of different lengths", "lines.xyz", put(points.encode() + b"1 2\n")
    yield "XYZ with ten points", "ten.xyz", put("\n".join(points.split("\n")[:10]).encode())
    yield "XYZ on a line", "line.xyz", put(b"".join(b"%d 0 0\n" % n for n in range(5000)))
    yield "PTS that declares more", "more.pts", put(b"99999999\n" + points.encode())
    yield "a picture under the name of a GLB", "picture.glb", put(b"\x89PNG\r\n\x1a\n" + b"\0" * 99)
    yield "no format of a scan", "part.step", put(b"ISO-10303-21;")
    yield "700 MB", "large.stl", lambda path: os.truncate(path, 700_000_000)
    yield "coordinates of 10³⁰⁰", "far.obj", put(b"v 1e300 0 0\n" + obj)
    yield "all corners mixed up", "mixed.stl", mixed_up(mesh)
    yield "a pipe", "pipe.stl", os.mkfifo


def with_texture(obj: bytes, picture: bytes) -> Callable[[Path], None]:
    def write(path: Path) -> None:
        (path.parent / "skin.png").write_bytes(picture)
        (path.parent / "skin.mtl").write_text("newmtl skin\nmap_Kd skin.png\n", encoding="ascii")
        vt = b"mtllib skin.mtl\nusemtl skin\nvt 0 0\n"
        lines = obj.splitlines()
        corners = [line.split()[1:] for line in lines if line.startswith(b"f ")]
        faces = [b"f " + b" ".join(c.split(b"/")[0] + b"/1" for c in line) for line in corners]
        kept = [line for line in lines if line.startswith(b"v ")]
        path.write_bytes(vt + b"\n".join([*kept, *faces]))

    return write


def large_png() -> bytes:
    head = struct.pack(">IIBBBBB", 46000, 46000, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + b"IHDR" + head + b"\0" * 16


def parsed(glb: bytes) -> tuple[dict[str, object], bytes]:
    size = struct.unpack_from("<I", glb, 12)[0]
    return json.loads(glb[20 : 20 + size]), glb[20 + size :]


def changed(glb: bytes, change: Callable[[dict[str, object]], None]) -> bytes:
    root, rest = parsed(glb)
    change(root)
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text + rest
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


def many_points(root: dict[str, object]) -> None:
    for accessor in root["accessors"]:  # type: ignore[attr-defined]
        accessor["count"] = 2**31


def circle(root: dict[str, object]) -> None:
    root["nodes"] = [{"children": [1]}, {"children": [0]}]
    root["scenes"] = [{"nodes": [0]}]


def draco(root: dict[str, object]) -> None:
    root["extensionsRequired"] = ["KHR_draco_mesh_compression"]


def outside(glb: bytes) -> bytes:
    root, _ = parsed(glb)
    root["buffers"] = [{"byteLength": 10, "uri": "../../secret.bin"}]
    return json.dumps(root).encode()


def three_mf(model: bytes) -> Callable[[Path], None]:
    def write(path: Path) -> None:
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("3D/3dmodel.model", model)

    return write


def three_mf_bomb(path: Path) -> None:
    with (
        zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive,
        archive.open("3D/3dmodel.model", "w", force_zip64=True) as file,
    ):
        for _ in range(1000):
            file.write(b"\0" * 4_000_000)


def laughs() -> bytes:
    entities = '<!ENTITY a "ha">' + "".join(
        f'<!ENTITY {chr(98 + n)} "{f"&{chr(97 + n)};" * 10}">' for n in range(12)
    )
    return f"<!DOCTYPE model [{entities}]><model>&m;</model>".encode()


def circular_model() -> bytes:
    return (
        b'<model><resources><object id="1"><components><component objectid="1"/>'
        b'<component objectid="1"/></components></object></resources>'
        b'<build><item objectid="1"/></build></model>'
    )


def many_scans(path: Path) -> None:
    with zipfile.ZipFile(path, "w") as archive:
        for number in range(3000):
            archive.writestr(f"scan {number}.stl", b"")


def slipping(stl: bytes) -> Callable[[Path], None]:
    def write(path: Path) -> None:
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("../../foot.stl", stl)

    return write


def mixed_up(mesh: TriangleMesh) -> Callable[[Path], None]:
    def write(path: Path) -> None:
        corners = np.random.default_rng(1).permutation(mesh.triangles.ravel()).reshape(-1, 3)
        write_stl(TriangleMesh(mesh.vertices, corners), path)

    return write


def outcome(path: Path) -> tuple[str, bool]:
    """What a file gives, and whether that is a foot or a sentence."""
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS + 1))
    start = time.process_time()
    try:
        read = read_mesh(path)
    except InsoleError as error:
        text, is_fine = str(error).replace(str(path), path.name), True
    except BaseException as error:  # noqa: BLE001 - what is reported here
        return f"{type(error).__name__}: {error}", False
    else:
        notes = " ".join(read.notes)
        text = f"READ, {len(read.mesh.triangles)} triangles. {notes}"
        is_fine = True
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    if peak > MOST_BYTES or time.process_time() - start > MOST_SECONDS:
        return f"{peak / 1e6:.0f} MB, {time.process_time() - start:.0f} s: {text}", False
    return text, is_fine


def main() -> None:
    rows, failed = [], 0
    mesh = foot()
    with tempfile.TemporaryDirectory() as name:
        for number, (what, file_name, write) in enumerate(cases(mesh)):
            path = Path(name) / str(number) / file_name
            path.parent.mkdir()
            if file_name == "large.stl":
                path.touch()
            write(path)
            with multiprocessing.get_context("fork").Pool(1) as pool:
                text, is_fine = pool.apply_async(outcome, (path,)).get(timeout=300)
            failed += not is_fine
            rows.append([number + 1, what, text.replace(name, "…")])
    print_table(["", "file", "what it gives"], rows)
    print(f"{len(rows)} files, {failed} that end otherwise than in a foot or a sentence")
    if failed:
        sys.exit(1)


if __name__ == "__main__":
    main()
