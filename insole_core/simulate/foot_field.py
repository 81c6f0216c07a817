"""The foot as an implicit function: negative inside, positive outside, roughly in mm.

A left foot (medial = +x) of the proportions of a 245 mm one: two lofts of superelliptic sections
(the foot body along y, heel and lower leg along z), the malleoli, and five toes of jointed cones,
joined by smooth unions. All tables below are in mm of that foot; y is counted from the heel's back.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray
from insole_core.simulate.foot_shape import FootShape

MODEL_LENGTH_MM = 245.0
LEG_HEIGHT_MM = 182.0
_MODEL_BALL_MM = 97.0
_MODEL_HEEL_MM = 69.0
_ROUNDING_MM = 10.4
"""Height of the arch due to the rounded section alone."""
_ARCH_GAIN = 1.3
"""Compensates for the parts filled by the smooth unions."""

_BODY = {
    # sections of the foot body from heel to web
    "y": (0, 30, 50, 73, 98, 122, 147, 167, 181, 196, 211, 235),
    "medial": (22, 25, 26, 27, 29, 33, 40, 45.5, 48, 47.5, 44, 42),
    "lateral": (-22, -27, -31, -34.5, -37.5, -41.5, -46, -48.5, -48, -45.5, -43, -40),
    "ridge": (0, 0, 0, 2, 5, 9, 13, 15, 16, 16, 15, 14),
    "top": (40, 50, 60, 70, 75, 63, 51, 42, 36, 31, 27, 24),
    "medial_seam": (22, 25, 30, 37, 41, 38, 29, 21, 18, 17, 16, 15),
    "lateral_seam": (18, 18, 18, 18, 17, 16, 15, 14, 14, 14, 14, 14),
    "sole": (9, 8, 6, 3.5, 2, 2, 1.5, 0.6, 0, 0.6, 2.5, 6),
    "arch": (0, 0, 0.08, 0.5, 0.95, 1, 0.66, 0.2, 0, 0, 0, 0),
}

_LEG = {
    # sections of heel and lower leg from the ground up; y is counted from the heel's back
    "z": (0, 8, 15, 24, 36, 50, 65, 80, 100, 125, 150, 190),
    "back": (2, 0.6, 0, 0.2, 2, 6, 11, 15.5, 19, 20, 18, 13),
    "waist": (33, 33, 33, 33, 34, 38, 46, 56, 62, 62, 60, 56),
    "front": (72, 72, 72, 74, 84, 96, 102, 101, 95, 92, 91, 92),
    "half_width": (33, 33, 33, 32.4, 31, 29.5, 28, 27, 26.5, 28, 31, 35.5),
    "power": (2.3, 2.3, 2.3, 2.3, 2.2, 2.0, 1.75, 1.62, 1.62, 1.75, 1.9, 2),
}

Toe = tuple[tuple[tuple[float, float, float, float], ...], float]
"""Three joints (x, y, z, radius), mm, and the ratio of height to width (1: round)."""

TOES: tuple[Toe, ...] = (
    # joints (x, y, z, radius) from the metatarsal head to the pulp, and the flattening of the toe
    (((31, 184, 15, 13.5), (31.5, 212, 12.5, 9.8), (30, 233.2, 10.5, 11.8)), 0.86),
    (((12, 190, 17, 8.5), (9.5, 214, 16, 6.6), (8, 233.5, 8.6, 7.6)), 0.95),
    (((-3.5, 184, 16.5, 8.5), (-7.5, 207, 15.5, 6.3), (-9, 225.3, 8.2, 7.2)), 0.95),
    (((-18, 175, 16, 8.5), (-23, 196, 14.5, 6.1), (-24.8, 213.2, 7.8, 6.8)), 0.95),
    (((-32, 165, 15, 8.5), (-37.5, 184, 12.5, 6.2), (-39.3, 200.2, 7.4, 6.6)), 0.95),
)

_MALLEOLI = (
    # centre and half axes; the lateral one lies lower and farther back
    ((22.5, 72, 82), (9.0, 15, 17)),
    ((-22.5, 60, 70), (9.0, 13, 18)),
)


@dataclass(frozen=True)
class FootField:
    """The implicit foot of a shape; mm, left foot, y from the heel's back.

    Parameters
    ----------
    shape
    toes
        Of the foot of 245 mm, medial to lateral.
    """

    shape: FootShape
    toes: tuple[Toe, ...] = TOES

    def sample(self, x: FloatArray, y: FloatArray, z: FloatArray) -> FloatArray:
        """Evaluate the field on a grid.

        Parameters
        ----------
        x, y, z : (nx,), (ny,), (nz,) float64, mm
            Equidistant coordinates.

        Returns
        -------
        (nx, ny, nz) float64, mm
            Roughly the signed distance, negative inside.
        """
        y_model = y * MODEL_LENGTH_MM / self.shape.length_mm
        X, Y, Z = x[:, None, None], y_model[None, :, None], z[None, None, :]
        width, shift = self._width_scale(Y), self._heel_shift(Z)
        behind, ahead = (X - shift) / width, (X - shift * _smooth_step((90 - Y) / 60)) / width
        body = _distance(self._body(ahead, Y, Z), x, y, z)
        leg = _distance(_leg(behind, Y, Z), x, y, z)
        foot = _smooth_union(body, leg, 14.0)
        for centre, half_axes in _MALLEOLI:
            foot = _smooth_union(foot, _ellipsoid((behind, Y, Z), centre, half_axes), 12.0)
        front, low = int(np.searchsorted(y_model, 150)), int(np.searchsorted(z, 50))
        grid = X / width[:, front:], Y[:, front:], Z[..., :low]
        toes = _toes(self.toes, grid)
        foot[:, front:, :low] = _smooth_union(foot[:, front:, :low], toes, 5.0)
        return np.asarray(np.maximum(foot, Z - LEG_HEIGHT_MM))

    def toe_tips(self) -> FloatArray:
        """Return the foremost point of every toe, (5, 3), mm, medial to lateral."""
        pulps = np.array([joints[-1] for joints, _ in self.toes])
        tips = pulps[:, :3] + np.array([0, 1, 0]) * pulps[:, 3:]
        return self._place(tips)

    def metatarsal_heads(self) -> FloatArray:
        """Return the points below the metatarsal heads, (5, 3), mm, medial to lateral."""
        heads = np.array([joints[0][:3] for joints, _ in self.toes], dtype=float)
        heads[:, 1] -= 3.0
        heads[:, 2] = 0.0
        return self._place(heads)

    def _place(self, points: FloatArray) -> FloatArray:
        scale = np.ones_like(points)
        scale[:, 0] = self._width_scale(points[:, 1])
        scale[:, 1] = self.shape.length_mm / MODEL_LENGTH_MM
        return points * scale

    def _width_scale(self, y: FloatArray) -> FloatArray:
        """Compute the width relative to the model's, blended from heel to ball."""
        heel = self.shape.heel_width_mm / _MODEL_HEEL_MM
        ball = self.shape.ball_width_mm / _MODEL_BALL_MM
        return heel + (ball - heel) * _smooth_step((y - 50) / 100)

    def _body(self, x: FloatArray, y: FloatArray, z: FloatArray) -> FloatArray:
        """Evaluate the foot from heel to web: 1 on the surface, less inside."""
        medial, lateral, ridge, top, medial_seam, lateral_seam, sole, arch = _profiles(_BODY, y)
        across = np.clip((x - lateral) / (medial - lateral), 0, 1)
        seam = lateral_seam + (medial_seam - lateral_seam) * across
        arch_height = _ARCH_GAIN * (self.shape.arch_height_mm - _ROUNDING_MM)
        ground = sole + arch_height * arch * _smooth_step((across - 0.12) / 0.75)
        seam = np.maximum(seam, ground + 8.0)
        upper = _section(x, ridge, medial, lateral) ** 2.2 + np.abs((z - seam) / (top - seam)) ** 2
        hollow = arch * across
        lower = _section(x, (medial + lateral) / 2, medial, lateral) ** (3.0 - 0.7 * hollow)
        lower = lower + np.abs((z - seam) / (seam - ground)) ** (2.6 - 0.6 * hollow)
        oblique = 27 * np.clip((22 - x) / 62, 0, 1) ** 1.3
        caps = np.clip((45 - y) / 40, 0, None) ** 2
        caps = caps + np.clip((y + oblique - 172) / 33, 0, None) ** 2.2
        return np.asarray(np.where(z > seam, upper, lower) + caps)

    def _heel_shift(self, z: FloatArray) -> FloatArray:
        """Compute the medial shift of a section; the leg above the ankle is upright."""
        slope = np.tan(np.radians(self.shape.rearfoot_eversion_deg))
        height = np.minimum(z, 60.0)
        return np.asarray(slope * (height - 10.0))


def _leg(x: FloatArray, y: FloatArray, z: FloatArray) -> FloatArray:
    """Evaluate heel and lower leg: 1 on the surface, less inside."""
    back, waist, front, half_width, power = _profiles(_LEG, z)
    along = np.where(y < waist, (waist - y) / (waist - back), (y - waist) / (front - waist))
    radius = np.abs(x / half_width) ** power + np.abs(along) ** power
    cap = np.clip((24 - z) / 24, 0, None) ** 3.0
    return np.asarray(radius**1.6 + cap)


def _toes(toes: tuple[Toe, ...], grid: tuple[FloatArray, FloatArray, FloatArray]) -> FloatArray:
    """Compute the union of the toes, not a smooth one, so that they stay separate."""
    fields = []
    for joints, flattening in toes:
        base, middle, pulp = (np.array(joint, dtype=float) for joint in joints)
        rear = _round_cone(grid, base, middle, flattening)
        fore = _round_cone(grid, middle, pulp, flattening)
        fields.append(_smooth_union(rear, fore, 4.0))
    return np.asarray(np.minimum.reduce(fields))


def _profiles(table: Mapping[str, tuple[float, ...]], at: FloatArray) -> list[FloatArray]:
    """Interpolate all rows of a table but the first, at coordinates along the first."""
    stations, *rows = (np.array(row, dtype=float) for row in table.values())
    inside = np.clip(at, stations[0], stations[-1])
    return [np.asarray(scipy.interpolate.PchipInterpolator(stations, row)(inside)) for row in rows]


def _smooth_step(share: FloatArray) -> FloatArray:
    """Interpolate smoothly from 0 (at 0 and below) to 1 (at 1 and above)."""
    inside = np.clip(share, 0, 1)
    return np.asarray(inside * inside * (3 - 2 * inside))


def _section(
    x: FloatArray, centre: FloatArray, medial: FloatArray, lateral: FloatArray
) -> FloatArray:
    """Compute the position across a section: 0 at its centre, 1 at either border."""
    return np.where(x > centre, (x - centre) / (medial - centre), (centre - x) / (centre - lateral))


def _distance(level: FloatArray, x: FloatArray, y: FloatArray, z: FloatArray) -> FloatArray:
    """Compute the first-order distance to the surface on which `level` is one."""
    root = np.sqrt(level)
    slope = np.linalg.norm(np.gradient(root, x, y, z), axis=0)
    return np.asarray((root - 1) / np.maximum(slope, 1e-3))


def _smooth_union(a: FloatArray, b: FloatArray, blend_mm: float) -> FloatArray:
    """Compute a union whose seam is rounded over `blend_mm` (polynomial smooth minimum)."""
    overlap = np.maximum(blend_mm - np.abs(a - b), 0) / blend_mm
    return np.asarray(np.minimum(a, b) - overlap**2 * blend_mm / 4)


def _ellipsoid(
    grid: tuple[FloatArray, FloatArray, FloatArray],
    centre: tuple[float, float, float],
    half_axes: tuple[float, float, float],
) -> FloatArray:
    parts = zip(grid, centre, half_axes, strict=True)
    square = np.asarray(sum(((at - middle) / axis) ** 2 for at, middle, axis in parts))
    return np.asarray((np.sqrt(square) - 1) * min(half_axes))


def _round_cone(
    grid: tuple[FloatArray, FloatArray, FloatArray],
    start: FloatArray,
    end: FloatArray,
    flattening: float,
) -> FloatArray:
    """Evaluate two spheres (x, y, z, radius) and the cone between them, flattened in z."""
    axis = end[:3] - start[:3]
    offsets = [at - first for at, first in zip(grid, start, strict=False)]
    along = sum(offset * part for offset, part in zip(offsets, axis, strict=True))
    share = np.clip(along / (axis @ axis), 0, 1)
    dx, dy, dz = (offset - share * part for offset, part in zip(offsets, axis, strict=True))
    radius = start[3] + share * (end[3] - start[3])
    return np.asarray(np.sqrt(dx**2 + dy**2 + (dz / flattening) ** 2) - radius)
