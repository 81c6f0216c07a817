"""Feet of many shapes, and above all with many shapes of toes: what the network has to expect."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rotation_about
from insole_core.simulate.foot_field import TOES, Toe
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape

_CELL_MM = 1.7
_WAVES = 12
_ANKLE_MM = np.array([0.0, 0.0, 45.0])
_WEB_MM, _TOE_MM = 66.0, 50.0
"""Where toes begin, from the middle of the foot, and their approximate length."""
_TOGETHER, _BETWEEN_MM = 0.6, (0.5, 1.0)
"""Fraction of feet whose toes lie side by side, and mean and spread of the gaps between these:
most people's toes touch, and no depth sensor of this kind resolves such grooves.
"""
_MOVED = np.array([0.7, 1.0])
"""Fractions by which the middle and the last joint move with the pulp."""


def varied_foot(rng: np.random.Generator) -> TriangleMesh:
    """Draw a random left foot, as it may hang in front of the sensors, mm."""
    length_mm = rng.uniform(205, 285)
    shape = FootShape(
        length_mm,
        float(np.clip(length_mm * rng.uniform(0.36, 0.425), 71, 119)),
        float(np.clip(length_mm * rng.uniform(0.24, 0.29), 51, 79)),
        rng.uniform(11, 30),
        rng.uniform(-8, 10),
    )
    mesh = build_foot(shape, rng, _CELL_MM, _varied_toes(rng)).mesh
    places = _Toes.draw(rng).bend(mesh.vertices + _waves(mesh.vertices, rng))
    for axis, degrees in zip(np.eye(3), rng.normal(0, (7, 6, 7)), strict=True):
        places = (places - _ANKLE_MM) @ rotation_about(axis, degrees).T + _ANKLE_MM
    return TriangleMesh(places + rng.normal(0, 6, 3), mesh.triangles, mesh.colors)


def _varied_toes(rng: np.random.Generator) -> tuple[Toe, ...]:
    """Draw long and short, thick and thin, close and spread, straight and clawed toes."""
    together = rng.uniform() < _TOGETHER
    toes = _varied_one_by_one(rng, (0.92, 1.2) if together else (0.72, 1.15))
    return _side_by_side(toes, rng.normal(*_BETWEEN_MM, len(toes) - 1)) if together else toes


def _side_by_side(toes: tuple[Toe, ...], between_mm: FloatArray) -> tuple[Toe, ...]:
    """Move toes sideways until the gaps between neighbouring pulps have the given widths."""
    joints = np.array([toe[0] for toe in toes])
    breadth = (joints[:, 1, 3] + joints[:, 2, 3]) / 2
    apart = breadth[:-1] + joints[1:, 2, 3] + between_mm
    wanted = joints[0, 2, 0] - np.concatenate([[0.0], np.cumsum(apart)])
    moved = wanted - joints[:, 2, 0]
    joints[:, 1:, 0] += (moved - moved.mean())[:, None] * _MOVED
    return tuple(
        _toe(joint, flattening) for joint, (_, flattening) in zip(joints, toes, strict=True)
    )


def _varied_one_by_one(
    rng: np.random.Generator, thicknesses: tuple[float, float]
) -> tuple[Toe, ...]:
    small = _Manner(
        splay=rng.normal(0.01, 0.06),
        gap=rng.uniform(0.92, 1.15),
        reach=rng.uniform(0.85, 1.35),
        straight=rng.uniform(-0.6, 1.2),
        tall=rng.uniform(0.85, 1.6),
        thickness=rng.uniform(*thicknesses),
    )
    great = replace(
        small,
        reach=(1 + small.reach) / 2,
        tall=(1 + small.tall) / 2,
        thickness=rng.uniform(0.9, 1.1),
    )
    return tuple(_varied_toe(toe, rng, great if toe is TOES[0] else small) for toe in TOES)


@dataclass(frozen=True)
class _Manner:
    """How the toes of one foot differ from the model's: factors, and slopes across the foot."""

    splay: float
    gap: float
    reach: float
    straight: float
    tall: float
    thickness: float


def _varied_toe(toe: Toe, rng: np.random.Generator, manner: _Manner) -> Toe:
    joints, flattening = np.array(toe[0]), toe[1]
    base, ahead = joints[0, :3].copy(), joints[1:, :3] - joints[0, :3]
    ahead[:, 1] *= manner.reach * rng.uniform(0.88, 1.1)
    ahead[:, 0] = ahead[:, 0] * manner.gap + (manner.splay + rng.normal(0, 0.03)) * ahead[:, 1]
    ahead[:, 2] += rng.normal((-2 * manner.straight, 1.5 * manner.straight), (1.5, 1.2))
    joints[1:, :3] = base + ahead
    joints[1:, 3] *= manner.thickness * rng.uniform((0.75, 0.94), (1.08, 1.22))
    flat = float(np.clip(flattening * manner.tall * rng.uniform(0.9, 1.1), 0.75, 1.6))
    joints[1:, 2] += (flat - flattening) * joints[1:, 3]
    return _toe(joints, flat)


def _toe(joints: FloatArray, flattening: float) -> Toe:
    return tuple((x, y, z, radius) for x, y, z, radius in joints.tolist()), flattening


@dataclass(frozen=True)
class _Toes:
    """How the toes stand on the foot: spread, bent up, the great toe turned outwards."""

    spread: float
    up_mm: float
    outward_mm: float

    @staticmethod
    def draw(rng: np.random.Generator) -> _Toes:
        return _Toes(rng.normal(0.02, 0.05), rng.normal(0, 5), rng.uniform(-2, 10))

    def bend(self, places: FloatArray) -> FloatArray:
        """Bend points (n, 3) of a left foot, mm."""
        x, y, _ = places.T
        ahead = np.maximum(y - _WEB_MM, 0)
        medial = np.clip((x + 12) / 38, 0, 1)
        moved = places.copy()
        moved[:, 0] += ahead * self.spread * (x - 2) / 38
        moved[:, 0] -= self.outward_mm * (ahead / _TOE_MM) ** 1.3 * medial**2 * (3 - 2 * medial)
        moved[:, 2] += self.up_mm * (ahead / _TOE_MM) ** 2
        return moved


def _waves(places: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Return random displacements (n, 3) of a few tenths of a millimetre."""
    height_mm = rng.uniform(0.08, 0.3)
    moved = np.zeros_like(places)
    for wavelength_mm in rng.uniform(25, 90, _WAVES):
        direction = rng.standard_normal(3)
        direction *= 2 * np.pi / wavelength_mm / np.linalg.norm(direction)
        wave = np.cos(places @ direction + rng.uniform(0, 7))
        moved += height_mm * wave[:, None] * rng.standard_normal(3)
    return moved
