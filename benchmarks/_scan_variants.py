"""Scans of feet as clinics have them: turned, in other units, coarse, cut, with a leg."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import permutations, product
from pathlib import Path

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.scans.mesh_file import read_mesh
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import vary_shape

Variant = Callable[[Foot], TriangleMesh]
SHARED = Path(__file__).resolve().parents[2] / "shared" / "data" / "feet"
REAL = (
    ("dupontgu/left_foot.stl", Side.LEFT),
    ("dupontgu/right_foot.stl", Side.RIGHT),
    ("focus_template/template.obj", Side.LEFT),
    ("plantar_scan.obj", Side.RIGHT),
)
STOOD = ("foot3d_0044/mesh.obj", "foot3d_0044/colmap_mesh.obj")
"""Of one left foot, with its leg and without a sole; its pose is known as it is found upright."""
_ANKLE = 0.26  # height and place, shares of the length
_TRIANGLES = 2000
_FLOOR_MM, _SOLE_FACES = 3.0, -0.7
FIRST_SEED = int(os.environ.get("SEED", "0"))
"""Of the simulated feet."""


@dataclass(frozen=True, eq=False)
class KnownFoot:
    """A foot of known pose, and the variants of its scan that make sense."""

    name: str
    foot: Foot
    variants: dict[str, Variant]


def known_feet(simulated: int, folder: Path = SHARED) -> Iterator[KnownFoot]:
    """Return real feet, where the folder has them, and simulated ones of chance."""
    for name, side in REAL:
        if (folder / name).exists():
            mesh = read_mesh(folder / name).mesh
            foot = place_foot(mesh, side, frame="unknown")
            short = name.startswith("plantar")
            yield KnownFoot(name, foot, SOLE_VARIANTS if short else VARIANTS)
    for name in STOOD:
        if (folder / name).exists():
            mesh = read_mesh(folder / name).mesh
            foot = place_foot(mesh, Side.LEFT, frame="unknown")
            yield KnownFoot(name, foot, {"as it is": as_scanned(mesh)})
    for seed in range(FIRST_SEED, FIRST_SEED + simulated):
        rng = np.random.default_rng(seed)
        side = list(Side)[seed % 2]
        mesh = build_foot(vary_shape(rng, side), rng, cell_mm=3.0).mesh
        yield KnownFoot(f"simulated {seed}", place_foot(mesh, side, frame="reference"), VARIANTS)


def quarter_turns() -> Iterator[FloatArray]:
    """Return the 24 rotations (3, 3) of a cube, each a little further."""
    rng = np.random.default_rng(0)
    for order, signs in product(permutations(range(3)), product((-1, 1), repeat=3)):
        rotation = np.eye(3)[list(order)] * np.array(signs)[:, None]
        if np.linalg.det(rotation) > 0:
            yield rotation_about(rng.normal(size=3), rng.uniform(-15, 15)) @ rotation


def turned(mesh: TriangleMesh, rotation: FloatArray) -> TriangleMesh:
    return mesh.transformed(rigid(rotation, np.array([310.0, -150.0, 90.0])))


def as_it_is(foot: Foot) -> TriangleMesh:
    return foot.mesh


def as_scanned(scan: TriangleMesh) -> Variant:
    """Return the scan of a foot as it was before the foot was made of it."""
    return lambda foot: scan.transformed(foot.source2insole)


def decimated(foot: Foot) -> TriangleMesh:
    """Reduce a foot to 2000 triangles."""
    import pyvista as pv

    share = max(1 - _TRIANGLES / len(foot.mesh.triangles), 0.0)
    surface = pv.PolyData.from_regular_faces(foot.mesh.vertices, foot.mesh.triangles).decimate(
        share
    )
    return TriangleMesh(np.asarray(surface.points, dtype=float), surface.regular_faces)


def cut_above(share: float) -> Variant:
    """Return a variant that ends at a height, in shares of the length."""
    return lambda foot: foot.mesh.part(foot.mesh.vertices[:, 2] < share * foot.length_mm)


def without_toes(foot: Foot) -> TriangleMesh:
    return foot.mesh.part(foot.mesh.vertices[:, 1] < 0.82 * foot.length_mm)


def from_above(leg_mm: float, pointed_deg: float) -> Variant:
    """Return a variant without a sole, as scanned in standing on a floor that was left out."""

    def variant(foot: Foot) -> TriangleMesh:
        mesh = with_leg(leg_mm, pointed_deg)(foot)
        z = mesh.vertices[:, 2]
        sole = (mesh.vertex_normals[:, 2] < _SOLE_FACES) & (z < 0.12 * foot.length_mm)
        return mesh.part((z > _FLOOR_MM) & ~sole)

    return variant


def with_leg(leg_mm: float, pointed_deg: float) -> Variant:
    """Return a variant with a longer leg, the foot pointed by an angle from standing."""

    def variant(foot: Foot) -> TriangleMesh:
        ankle = _ANKLE * foot.length_mm
        x, y, z = foot.mesh.vertices.T
        top = max(z.max() - ankle, 1.0)
        over = np.clip(z - ankle, 0, None)
        lengthened = np.where(over > 0.5 * top, over * leg_mm / top, over)
        ramp = np.clip(over / (0.5 * top), 0, 1)
        long = over * (1 - ramp) + lengthened * ramp
        turn = np.radians(pointed_deg) * np.clip((z - 0.8 * ankle) / (0.5 * ankle), 0, 1)
        dy, dz = y - ankle, np.minimum(z, ankle) - ankle + long
        turn = np.where(y < 2.0 * ankle, turn, 0.0)
        bent = np.column_stack(
            [
                x,
                ankle + np.cos(turn) * dy - np.sin(turn) * dz,
                ankle + np.sin(turn) * dy * 0.3 + np.cos(turn) * dz,
            ]
        )
        return replace(foot.mesh, vertices=bent)

    return variant


SOLE_VARIANTS: dict[str, Variant] = {
    "as it is": as_it_is,
    "2000 triangles": decimated,
    "toes missing": without_toes,
}
VARIANTS: dict[str, Variant] = {
    **SOLE_VARIANTS,
    "cut at 0.15": cut_above(0.15),
    "cut at 0.22": cut_above(0.22),
    "cut at 0.30": cut_above(0.30),
    "leg 150, standing": with_leg(150, 0),
    "leg 300, pointed 30°": with_leg(300, 30),
    "leg 300, pointed 60°": with_leg(300, 60),
    "no sole, leg 150": from_above(150, 0),
    "no sole, leg 300, pointed 60°": from_above(300, 60),
}
