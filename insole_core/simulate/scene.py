"""The simulated scene: foot, reference system, bed and blue clutter, and rays cast into it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from insole_core.calibration.boards.printed_page import MARKER_MM
from insole_core.geometry.arrays import BoolArray, ByteArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.geometry.transforms import rotation_about
from insole_core.json_object import JsonObject
from insole_core.recording.manifest_json import parse_reference_system
from insole_core.recording.session import Marker, ReferenceSystem
from insole_core.resources import resource_path

_BLOCK_DEPTH_MM = 11.2
_MARKER_BLUE = (22, 52, 168)
_BRICK_GREY = (140, 140, 142)
_CLOTH_BLUE = (34, 66, 138)
_BED = (176, 178, 168)
_OUTWARD = {"sole": (0.0, 0.0, -1.0), "achilles": (0.0, -1.0, 0.0)}
"""Normal of the markers of each group, reference frame."""
_CLEARANCE_MM = 0.5
"""Distance of a shadow ray's start from its surface, so that it does not hit the surface itself."""


def load_reference_system(name: str = "lego-20") -> ReferenceSystem:
    """Read a reference system that comes with the product."""
    path = resource_path(f"reference_systems/{name}.json")
    return parse_reference_system(JsonObject.read(path))


def build_scene(
    foot: TriangleMesh, reference_system: ReferenceSystem, rng: np.random.Generator
) -> TriangleMesh:
    """Assemble the scene.

    Parameters
    ----------
    foot : mm, reference frame, with colours
        Or both feet as one mesh.
    reference_system
    rng
        For the positions of bed and clutter.

    Returns
    -------
    TriangleMesh, mm, reference frame, with colours
    """
    bricks = (_brick(marker) for marker in reference_system.markers)
    left = next((place.origin_mm for place in reference_system.feet), (0.0, 0.0, 0.0))
    return joined([foot, *bricks, _bed(rng), *_clutter(rng, np.array(left))])


def joined(meshes: Iterable[TriangleMesh]) -> TriangleMesh:
    """Concatenate coloured meshes."""
    parts = list(meshes)
    starts = np.cumsum([0, *(len(part.vertices) for part in parts[:-1])])
    return TriangleMesh(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate(
            [part.triangles + start for part, start in zip(parts, starts, strict=True)]
        ).astype(np.int32),
        np.concatenate([part.colors for part in parts if part.colors is not None]),
    )


def _brick(marker: Marker) -> TriangleMesh:
    """Return a grey block whose outward face is blue."""
    outward = np.array(_OUTWARD[marker.face])
    size = np.where(outward == 0, MARKER_MM, _BLOCK_DEPTH_MM)
    centre = np.array(marker.position_mm) - outward * _BLOCK_DEPTH_MM / 2
    colors = _six_faces(_BRICK_GREY)
    colors[np.argmax(_BOX_NORMALS @ outward)] = _MARKER_BLUE
    return _box(centre, size, colors)


def _bed(rng: np.random.Generator) -> TriangleMesh:
    """Return the end of the bed on which the lower leg rests."""
    centre = np.array([rng.uniform(-25, 25), rng.uniform(32, 42), 450.0])
    return _box(centre, np.array([660.0, 60.0, 480.0]), _six_faces(_BED))


def _clutter(rng: np.random.Generator, origin: FloatArray) -> list[TriangleMesh]:
    """Return blue objects that are not markers: a cloth, a cable, a dot, and a pen on the bed.

    Parameters
    ----------
    origin : (3,) float64, mm, reference frame
        Of the foot that they lie around.
    """
    things = [
        # centre, size, colour
        ((40, 262, 70), (140, 78, 4), _CLOTH_BLUE),
        ((0, 194, 40), (110, 3, 3), _MARKER_BLUE),
        ((-75, 132, 20), (5, 5, 3), _MARKER_BLUE),
        ((130, -3, 330), (9, 8, 120), _CLOTH_BLUE),
    ]
    boxes = []
    for centre, size, color in things:
        moved = origin + centre + rng.uniform(-6, 6, 3) * [1, 1, 0]
        turn = rotation_about(np.array([0.0, 0.0, 1.0]), rng.uniform(-8, 8))
        boxes.append(_box(moved, np.array(size, dtype=float), _six_faces(color), turn))
    return boxes


def _six_faces(color: tuple[int, int, int]) -> ByteArray:
    return np.full((6, 3), color, dtype=np.uint8)


def _box(
    centre: FloatArray, size: FloatArray, colors: ByteArray, turn: FloatArray | None = None
) -> TriangleMesh:
    """Return a box whose faces share no vertices, so that they keep their colours and normals."""
    corners = _BOX_CORNERS * size / 2
    vertices = centre + (corners if turn is None else corners @ turn.T)
    triangles = (np.arange(6)[:, None, None] * 4 + np.array([[0, 1, 2], [0, 2, 3]])).reshape(-1, 3)
    return TriangleMesh(vertices, triangles.astype(np.int32), np.repeat(colors, 4, axis=0))


def _box_faces() -> tuple[FloatArray, FloatArray]:
    """Return the corners (24, 3) of the faces of a box from -1 to 1, and their normals (6, 3)."""
    normals = np.concatenate([np.eye(3), -np.eye(3)])
    corners = []
    for normal in normals:
        side = np.roll(normal, 1)
        up = np.cross(normal, side)
        corners += [normal - side - up, normal + side - up, normal + side + up, normal - side + up]
    return np.array(corners), normals


_BOX_CORNERS, _BOX_NORMALS = _box_faces()


@dataclass(frozen=True, eq=False)
class Hits:
    """First hits of rays with a scene; only of the rays that hit something.

    Parameters
    ----------
    ray : (n,) int64
        Index of the ray.
    distance : (n,) float64
        In units of that ray's direction.
    points, normals : (n, 3) float64
        Position and unit surface normal towards the ray's origin, frame of the scene.
    colors : (n, 3) float64
        0 to 255, interpolated between the vertices.
    """

    ray: IntArray
    distance: FloatArray
    points: FloatArray
    normals: FloatArray
    colors: FloatArray


class Caster(Protocol):
    """A scene into which rays are cast."""

    def cast(self, origin: FloatArray, directions: FloatArray) -> Hits:
        """Find the first hits of rays (n, 3) from one origin (3,), mm, frame of the scene."""
        ...

    def is_blocked(self, points: FloatArray, target: FloatArray) -> BoolArray:
        """Return which points (n, 3) are hidden from a target (3,), mm, frame of the scene."""
        ...


class SceneCaster:
    """A coloured mesh, prepared for casting rays."""

    def __init__(self, scene: TriangleMesh) -> None:
        self._corners = scene.vertices[scene.triangles]
        self._normals = scene.vertex_normals
        colors = scene.colors
        self._colors = np.full(scene.vertices.shape, 200.0) if colors is None else colors
        self._triangles = scene.triangles
        self._caster = RayCaster(scene)

    def cast(self, origin: FloatArray, directions: FloatArray) -> Hits:
        """Find the first hits of rays from one origin.

        Parameters
        ----------
        origin : (3,) float64, mm, frame of the scene
        directions : (n, 3) float64
            Of any length.

        Returns
        -------
        Hits
        """
        met = self._caster.cast(origin, directions)
        ray, triangle = met.ray, met.triangle
        directions = directions[ray]
        distance, weights = _solve(self._corners[triangle], origin, directions)
        at = self._triangles[triangle]
        normals = np.einsum("nk,nkc->nc", weights, self._normals[at])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        facing = np.sign(-np.einsum("nc,nc->n", normals, directions))
        return Hits(
            ray,
            distance,
            origin + distance[:, None] * directions,
            normals * facing[:, None],
            np.einsum("nk,nkc->nc", weights, self._colors[at].astype(float)),
        )

    def is_blocked(self, points: FloatArray, target: FloatArray) -> BoolArray:
        """Return which points are hidden from a target.

        Parameters
        ----------
        points : (n, 3) float64, mm, frame of the scene
        target : (3,) float64, mm

        Returns
        -------
        (n,) bool
        """
        return self._caster.is_blocked(points, target, _CLEARANCE_MM)


def _solve(
    corners: FloatArray, origin: FloatArray, directions: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Compute ray length (n,) and barycentric weights (n, 3) in double (Moller & Trumbore 1997)."""
    edge1, edge2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    p = np.cross(directions, edge2)
    scale = 1 / np.einsum("nc,nc->n", edge1, p)
    offset = origin - corners[:, 0]
    u = np.einsum("nc,nc->n", offset, p) * scale
    q = np.cross(offset, edge1)
    v = np.einsum("nc,nc->n", directions, q) * scale
    weights = np.clip(np.stack([1 - u - v, u, v], axis=1), 0, 1)
    return np.einsum("nc,nc->n", edge2, q) * scale, weights / weights.sum(axis=1, keepdims=True)
