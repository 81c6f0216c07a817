"""Meshes that are damaged as files, and sound ones that are no feet."""

from __future__ import annotations

import random
import re
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import trimesh

from benchmarks import _fuzz_samples as samples
from benchmarks._fuzz_mutations import Mutation, byte_mutations
from benchmarks._fuzz_pool import Expected
from insole_core.formats.obj import write_obj
from insole_core.formats.ply import write_ply
from insole_core.formats.solid_content import SolidPart, write_solids
from insole_core.formats.stl import write_ascii_stl, write_stl
from insole_core.geometry.mesh import TriangleMesh


def sound_files() -> Iterator[tuple[str, bytes]]:
    """Yield the name and the content of the same foot in every format."""
    mesh = samples.foot_mesh()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_stl(mesh, folder / "binary.stl")
        write_ascii_stl(mesh, folder / "text.stl")
        write_ply(mesh, folder / "binary.ply")
        write_obj(mesh, folder / "text.obj")
        write_solids([SolidPart(mesh, "foot")], folder / "text.amf")
        for path in sorted(folder.iterdir()):
            yield path.name, path.read_bytes()
        plain = replace(mesh, colors=None)
        shape = trimesh.Trimesh(plain.vertices, plain.triangles, process=False)
        shape.export(folder / "text.ply", encoding="ascii")
        yield "text.ply", (folder / "text.ply").read_bytes()
        yield "scene.dae", bytes(shape.export(file_type="dae"))


def damaged_files(name: str, content: bytes, rng: random.Random) -> Iterator[Mutation]:
    for what, bad, expected in byte_mutations(content, rng, 30, 0):
        yield what, bad, expected
    body = _start_of_body(name, content)
    for share in (0.01, 0.2, 0.5, 0.7, 0.9, 0.97):
        at = body + int(share * (len(content) - body))
        yield f"cut at {share:.0%}", content[:at], _cut_is(name)
    if name.endswith(".ply"):
        yield from _ply_counts(content)
        yield from _ply_headers(content)
    if name == "binary.stl":
        for count in (0, 1, 10**6, 2**32 - 1):
            yield (
                f"{count} facets declared",
                content[:80] + np.uint32(count).tobytes() + content[84:],
                "refused",
            )
        yield "trailing bytes", content + b"end\n", "accepted"
        yield "trailing kilobytes", content + bytes(5000), "accepted"  # told, and not counted
        yield "solid in the header", b"solid" + content[5:], "accepted"
        yield "all NaN", content[:84] + b"\xff" * (len(content) - 84), "refused"
    if name.endswith(".obj"):
        lines = content.splitlines()
        for what, line in _obj_lines(lines):
            yield what, b"\n".join([*lines, line]), "refused"
        yield "index beyond", content + b"f 1 2 999999999\n", "refused"
        yield "1e308", content + b"v 1e308 0 0\nf 1 2 -1\n", "refused"
    if name in ("text.amf", "scene.dae"):
        yield from _xml(name, content)
    if name == "text.stl":
        yield "NaN", content.replace(b"vertex ", b"vertex nan ", 1), "refused"
        yield "word", content.replace(b"vertex ", b"vertex x ", 1), "refused"
        yield "two corners", content.replace(b"   vertex", b"   vortex", 1), "refused"


def _xml(name: str, content: bytes) -> Iterator[Mutation]:
    if name == "text.amf":
        yield "NaN", content.replace(b"<x>", b"<x>nan", 1), "refused"
        yield "corner beyond", content.replace(b"<v1>", b"<v1>9999999", 1), "refused"
        yield "two corners", re.sub(rb"<v3>\d+</v3>", b"", content, count=1), "refused"
    else:
        yield "NaN", re.sub(rb"(<float_array[^>]*>)", rb"\1nan ", content, count=1), "refused"
        yield "corner beyond", content.replace(b"<p>", b"<p>9999999", 1), "refused"
        yield "no positions", content.replace(b'"POSITION"', b'"OTHER"', 1), "refused"
    at = content.index(b"?>") + 2 if content.startswith(b"<?xml") else 0
    laughs = b'<!DOCTYPE x [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>'
    outside = b'<!DOCTYPE x SYSTEM "http://nowhere.invalid/x.dtd">'
    for what, head in (("entities", laughs), ("a type elsewhere", outside)):
        yield what, content[:at] + head + content[at:], "refused"
    last = content.rindex(b"</")
    yield "never closed", content[:last] + b"<x>" * 100_000 + content[last:], "refused"


def _cut_is(name: str) -> Expected:
    """Return what is expected of a file that is cut off: OBJ has no end and no counts."""
    return "any" if name.endswith(".obj") else "refused"


def _start_of_body(name: str, content: bytes) -> int:
    if name.endswith(".ply"):
        return content.index(b"end_header") + 11
    return 84 if name == "binary.stl" else 0


def _ply_counts(content: bytes) -> Iterator[Mutation]:
    mesh = samples.foot_mesh()
    for element, true in (("vertex", len(mesh.vertices)), ("face", len(mesh.triangles))):
        line = f"element {element} {true}".encode()
        for count in (
            b"1000000000",
            b"0",
            b"-5",
            b"nan",
            b"",
            b"7" * 400,
            str(true + 1).encode(),
            str(true - 1).encode(),
        ):
            bad = content.replace(line, f"element {element} ".encode() + count)
            # Points without a face are a cloud, which a surface is laid through.
            is_cloud = (element, count) == ("face", b"0")
            yield f"{element} count {count[:12]!r}", bad, "any" if is_cloud else "refused"


def _ply_headers(content: bytes) -> Iterator[Mutation]:
    for old, new in (
        (b"property float x", b"property double x"),
        (b"property float x", b"property list uchar float x"),
        (b"property float x", b"property strange x"),
        (b"format ", b"format binary_big_endian 1.0\nformat "),
        (b"end_header", b""),
        (b"end_header", b"element face 9\nend_header"),
        (b"ply", b"plx"),
    ):
        yield f"{old!r} -> {new[:30]!r}", content.replace(old, new, 1), "any"


def _obj_lines(lines: list[bytes]) -> Iterator[tuple[str, bytes]]:
    yield "index 0", b"f 0 1 2"
    yield "index that is a word", b"f a b c"
    yield "index too negative", b"f -999999 -2 -1"
    yield "400 digits", b"f 1 2 " + b"7" * 400
    yield "corner NaN", b"v nan nan nan\nf 1 2 -1"


def bad_shapes() -> Iterator[Mutation]:
    """Yield solids that are no feet, and feet of impossible sizes, as binary STL."""
    make = trimesh.creation
    mesh = samples.foot_mesh()
    low = mesh.vertices[:, 1].min()
    length = float(np.ptp(mesh.vertices[:, 1]))
    heel = mesh.part(mesh.vertices[:, 1] < low + 0.5 * length)
    shapes: dict[str, tuple[TriangleMesh, Expected]] = {
        "foot": (mesh, "accepted"),
        "box": (_own(make.box((90, 240, 60))), "refused"),
        "box, finely": (
            _own(make.box((90, 240, 60)).subdivide().subdivide().subdivide()),
            "refused",
        ),
        "plate of 5 mm": (_own(make.box((90, 240, 5))), "refused"),
        "capsule": (_own(make.capsule(180, 35)), "refused"),
        "ball": (_own(make.icosphere(4, 100)), "refused"),
        "cylinder": (_own(make.cylinder(40, 240)), "any"),
        "finished insole": (_insole(), "refused"),
        "twice the size": (_scaled(mesh, 2.0), "refused"),
        "1.45 times": (_scaled(mesh, 1.45), "refused"),
        "a third of the size": (_scaled(mesh, 0.35), "refused"),
        "heel half": (heel, "refused"),
        "small child": (_scaled(mesh, 0.5), "refused"),  # asked for its unit
        "large man": (_scaled(mesh, 1.25), "accepted"),
    }
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "shape.stl"
        for what, (shape, expected) in shapes.items():
            write_stl(shape, path)
            yield what, path.read_bytes(), expected


def _own(shape: trimesh.Trimesh) -> TriangleMesh:
    return TriangleMesh(np.array(shape.vertices, float), np.array(shape.faces, np.int32))


def _scaled(mesh: TriangleMesh, factor: float) -> TriangleMesh:
    return replace(mesh, vertices=mesh.vertices * factor)


def _insole() -> TriangleMesh:
    from insole_core.insole.build import build_insole
    from insole_core.solids.solid import insole_solid

    return insole_solid(build_insole(samples.foot(), samples.design()))
