"""Scans of others, each of a kind of its own: what is in the file, and what it truly is."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import trimesh

from insole_core.foot.side_similarity import foot_borders
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape

_RINGS, _AROUND = 120, 72
_TOP_Y = (0.0, 0.02, 0.12, 0.30, 0.45, 0.60, 0.75, 0.90, 0.97, 1.0)
_TOP = (0.12, 0.28, 0.36, 0.36, 0.30, 0.23, 0.16, 0.11, 0.085, 0.05)
_CONE_Z, _CONE = (0.0, 0.16, 0.24, 0.36), (1.0, 1.0, 0.6, 0.38)
_UTM_M = np.array([451_234.5, 5_411_876.25, 312.0])
LENGTH_MM = 246.0


@dataclass(frozen=True)
class OddScan:
    """A file, and what is right to make of it.

    Parameters
    ----------
    kind
    name
        Of the file.
    content
    length_mm
        Of the foot in it; None where there is none that can be used.
    """

    kind: str
    name: str
    content: bytes
    length_mm: float | None = LENGTH_MM


def odd_scans() -> Iterator[OddScan]:
    """Return all kinds, the cheap ones first; the foot is a left one."""
    foot = simulated_foot()
    yield from _of_units(foot)
    yield from _far_away(foot)
    yield from _of_odd_bytes(foot)
    yield from _no_whole_foot(foot)
    yield from _no_scan()
    yield from clouds(foot)


def simulated_foot() -> TriangleMesh:
    mesh = build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=4.0).mesh
    return TriangleMesh(mesh.vertices, mesh.triangles)


def content(suffix: str, mesh: TriangleMesh) -> bytes:
    shape = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    made = shape.export(file_type=suffix)
    return made.encode() if isinstance(made, str) else bytes(made)


def obj(mesh: TriangleMesh) -> bytes:
    """As text with all digits."""
    lines = "".join("v {!r} {!r} {!r}\n".format(*row) for row in mesh.vertices.tolist())
    lines += "".join("f {} {} {}\n".format(*row) for row in (mesh.triangles + 1).tolist())
    return lines.encode()


def xyz(points: FloatArray, digits: int = 3) -> bytes:
    row = " ".join([f"%.{digits}f"] * 3) + "\n"
    return (row * len(points) % tuple(points.ravel().tolist())).encode()


def sampled(mesh: TriangleMesh, count: int) -> FloatArray:
    shape = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    return np.asarray(trimesh.sample.sample_surface(shape, count, seed=1)[0])


def last_form(length_mm: float, heel_mm: float = 18.0, height_mm: float = 95.0) -> TriangleMesh:
    """Return a left shoe last: no toes, a heel that is raised, a cone cut flat above."""
    share = np.clip(0.5 - 0.5 * np.cos(np.linspace(0.02, np.pi - 0.02, _RINGS)), 0.002, 0.998)
    medial, lateral = foot_borders(share) * length_mm
    half, middle = (medial - lateral) / 2, (medial + lateral) / 2
    angle = np.linspace(0, 2 * np.pi, _AROUND, endpoint=False)
    across, up = np.cos(angle), np.sin(angle)
    top = np.interp(share, _TOP_Y, _TOP) * length_mm
    z = np.where(up < 0, -3 * np.abs(up) ** 0.35, np.abs(up) ** 0.8 * top[:, None])
    narrow = np.interp(z / length_mm, _CONE_Z, _CONE)
    x = middle[:, None] + half[:, None] * narrow * np.sign(across) * np.abs(across) ** 0.6
    base = heel_mm * np.interp(share, (0, 0.25, 0.65), (1, 1, 0))
    base += 8 * np.clip((share - 0.7) / 0.3, 0, 1) ** 2
    y = np.broadcast_to(share[:, None] * length_mm, x.shape)
    rings = np.stack([x, y, np.minimum(z + base[:, None] + 3, height_mm)], axis=-1)
    return _lofted(rings)


def _lofted(rings: FloatArray) -> TriangleMesh:
    """Close rings (m, n, 3) to a body."""
    count, around = rings.shape[:2]
    ends = rings[[0, -1]].mean(axis=1)
    ring, next_ = np.arange(around), (np.arange(around) + 1) % around
    parts = []
    for start in range(0, (count - 1) * around, around):
        a, b = start + ring, start + next_
        parts += [np.column_stack([a, b, a + around]), np.column_stack([b, b + around, a + around])]
    first, last = count * around, (count - 1) * around
    parts.append(np.column_stack([next_, ring, np.full(around, first)]))
    parts.append(np.column_stack([last + ring, last + next_, np.full(around, first + 1)]))
    vertices = np.vstack([rings.reshape(-1, 3), ends])
    return TriangleMesh(vertices, np.vstack(parts).astype(np.int32))


def _scaled(mesh: TriangleMesh, length: float) -> TriangleMesh:
    return mesh.moved(mesh.vertices * length / LENGTH_MM)


def _of_units(foot: TriangleMesh) -> Iterator[OddScan]:
    yield OddScan("STL, mm", "mm.stl", content("stl", foot))
    yield OddScan("STL, cm", "cm.stl", content("stl", _scaled(foot, 24.6)))
    yield OddScan("STL, metres", "m.stl", content("stl", _scaled(foot, 0.246)))
    yield OddScan("STL, inches", "inch.stl", content("stl", _scaled(foot, 246 / 25.4)))
    yield OddScan("STL, 14 units long", "14.stl", content("stl", _scaled(foot, 14.0)), None)
    yield OddScan("STL, 6.65 units long", "6.stl", content("stl", _scaled(foot, 6.65)), None)
    yield OddScan("STL, 11 inches", "11.stl", content("stl", _scaled(foot, 11.0)), 279.4)
    yield OddScan("a child's foot, STL, mm", "child.stl", content("stl", _scaled(foot, 150)), 150.0)
    yield OddScan("glTF, metres", "m.glb", content("glb", _scaled(foot, 0.246)))
    yield OddScan("glTF, mm", "mm.glb", content("glb", foot))
    yield OddScan("glTF, cm", "cm.glb", content("glb", _scaled(foot, 24.6)))


def _far_away(foot: TriangleMesh) -> Iterator[OddScan]:
    far = foot.moved(foot.vertices + np.array([6e4, 4e4, 0.0]))
    yield OddScan("60 m away, OBJ, mm", "60m.obj", obj(far))
    yield OddScan("60 m away, STL, mm", "60m.stl", content("stl", far))
    farther = foot.moved(foot.vertices + np.array([6e5, -4e5, 900.0]))
    yield OddScan("700 m away, OBJ, mm", "700m.obj", obj(farther))
    utm = foot.moved(foot.vertices / 1000 + _UTM_M)
    yield OddScan("geo-coordinates, OBJ, metres", "utm.obj", obj(utm))
    yield OddScan("geo-coordinates, OBJ, mm", "utm_mm.obj", obj(utm.moved(utm.vertices * 1000)))
    coarse = foot.moved(foot.vertices + np.array([3e6, 0.0, 0.0]))
    yield OddScan("3 km away, STL, mm, steps of 0.25 mm", "3km.stl", content("stl", coarse))
    yield OddScan("geo-coordinates, STL, metres", "utm.stl", content("stl", utm), None)
    points = sampled(foot, 20_000) / 1000 + _UTM_M
    yield OddScan("geo-coordinates, XYZ, metres", "utm.xyz", xyz(points, digits=5))


def _of_odd_bytes(foot: TriangleMesh) -> Iterator[OddScan]:
    text, binary = obj(foot), content("stl", foot)
    yield OddScan("OBJ that ends in a zero byte", "nul.obj", text + b"\0")
    yield OddScan("STL with 5000 zero bytes behind", "nul.stl", binary + bytes(5000))
    yield OddScan("STL cut off", "cut.stl", binary[: len(binary) // 2], None)
    yield OddScan("OBJ, decimal commas", "comma.obj", text.replace(b".", b","), None)
    commas = content("stl_ascii", foot).replace(b".", b",")
    yield OddScan("STL text, decimal commas", "comma.stl", commas, None)
    points = xyz(sampled(foot, 20_000)).replace(b".", b",")
    yield OddScan("XYZ, decimal commas", "comma.xyz", points)
    both = TriangleMesh(foot.vertices, np.vstack([foot.triangles, foot.triangles[:, ::-1]]))
    yield OddScan("STL with two sides", "double.stl", content("stl", both))


def _no_whole_foot(foot: TriangleMesh) -> Iterator[OddScan]:
    for heel_mm, height_mm in ((18, 95), (40, 110), (8, 80)):
        kind = f"a last, heel of {heel_mm} mm" if heel_mm > 10 else "a prosthetic foot"
        mesh = last_form(265.0, heel_mm, height_mm)
        yield OddScan(kind, f"last_{heel_mm}.stl", content("stl", mesh), None)
    box = trimesh.creation.box((90, 250, 60))
    faces = np.asarray(box.faces, dtype=np.int32)
    block = TriangleMesh(np.asarray(box.vertices), faces)
    yield OddScan("a block", "block.stl", content("stl", block), None)
    both = TriangleMesh(block.vertices, np.vstack([faces, faces[:, ::-1]]))
    yield OddScan("a block with two sides", "block2.stl", content("stl", both), None)
    y, x = foot.vertices[:, 1], foot.vertices[:, 0]
    for share in (0.9, 0.83, 0.7):
        part = foot.part(y < y.min() + share * LENGTH_MM)
        yield OddScan(
            f"{share:.0%} of a foot, no toes", f"t{share}.stl", content("stl", part), None
        )
    yield OddScan("half a foot, lengthwise", "half.stl", content("stl", foot.part(x < 0)), None)
    front = foot.part(y > y.min() + 0.3 * LENGTH_MM)
    yield OddScan("a foot without its heel", "front.stl", content("stl", front), None)


def _no_scan() -> Iterator[OddScan]:
    pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 5\n"
    yield OddScan("a pointer of Git LFS", "lfs.stl", pointer, None)
    yield OddScan("PCD", "cloud.pcd", b"# .PCD v0.7\nFIELDS x y z\n", None)
    yield OddScan("Rhino", "model.3dm", b"3D Geometry File Format        5", None)
    yield OddScan("CSV", "table.csv", b"x,y,z\n" + b"1,2,3\n" * 5000, None)
    yield OddScan("a web page", "page.obj", b"<!DOCTYPE html>\n<html></html>", None)
    pliance = (
        b"mat type s2160_001\npressure values in kPa\ntime[secs] 4 5 6\n" + b"0 0 0 0\n" * 2000
    )
    yield OddScan("pressures of pliance", "walk.asc", pliance, None)
    yield OddScan("all points equal", "equal.xyz", b"10 20 30\n" * 5000, None)
    yield OddScan("XYZ, one endless line, 20 MB", "line.xyz", b"12.5 " * 4_000_000, None)


def clouds(foot: TriangleMesh) -> Iterator[OddScan]:
    """Return clouds of 10⁴ to 2·10⁶ points."""
    for count in (10_000, 58_000, 250_000, 1_000_000, 2_000_000):
        yield OddScan(f"{count} points", f"{count}.xyz", xyz(sampled(foot, count)))
    middles = sampled(foot, 900)  # as of a scanner that sees patches: many pieces
    near = np.random.default_rng(2).normal(scale=0.6, size=(58_000, 3)) * [1, 1, 0.02]
    yield OddScan(
        "58000 points in 900 clumps", "clumps.xyz", xyz(np.resize(middles, near.shape) + near)
    )
