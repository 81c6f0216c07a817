"""The colour of simulated skin: redder where it bears load, paler in the arch, with a pen mark."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh

_SKIN = np.array([206.0, 158.0, 132.0])
_RED = np.array([10.0, -20.0, -16.0])
_PALE = np.array([16.0, 18.0, 16.0])
_DORSAL = np.array([-14.0, -12.0, -12.0])
_INK = np.array([26.0, 28.0, 62.0])
_MOTTLE = 7.0
_PEN_LENGTH_MM = 24.0
_PEN_WIDTH_MM = 3.4


def paint_skin(
    mesh: TriangleMesh, landmarks_mm: dict[str, FloatArray], rng: np.random.Generator
) -> TriangleMesh:
    """Colour the surface of a left foot.

    Parameters
    ----------
    mesh : mm, reference frame
    landmarks_mm
        As in `FootModel`; the positions of heel, ball and toes.
    rng
        For the mottling and the position of the pen mark.

    Returns
    -------
    TriangleMesh
        The same mesh with colours.
    """
    plantar = np.clip(0.35 - 0.9 * mesh.vertex_normals[:, 2], 0, 1)[:, None]
    colors = _SKIN + (1 - plantar) * _DORSAL
    colors = colors + plantar * _loaded(mesh.vertices, landmarks_mm)[:, None] * _RED
    colors = colors + plantar * _arch(mesh.vertices, landmarks_mm)[:, None] * _PALE
    colors = colors + _MOTTLE * _mottling(mesh.vertices, rng)[:, None] * np.array([0.5, 1, 1])
    head = landmarks_mm["metatarsal_head_2"]
    centre = head[:2] + np.array([-4.0, -26.0]) + rng.uniform(-3, 3, 2)
    inked = _pen_cross(mesh, centre, rng.uniform(-15, 15))
    colors[inked] = _INK
    return replace(mesh, colors=np.clip(colors, 0, 255).astype(np.uint8))


def _loaded(points: FloatArray, landmarks_mm: dict[str, FloatArray]) -> FloatArray:
    """Compute the load (n,) of points, 0 to 1: heel, metatarsal heads, toe pulps."""
    heel = landmarks_mm["pternion"] * [1, 1, 0] + [0, 32.0, 0]
    spots = [(heel, 26.0, 1.0)]
    for number in range(1, 6):
        spots.append((landmarks_mm[f"metatarsal_head_{number}"], 15.0, 0.8))
        tip = landmarks_mm[f"toe_tip_{number}"]
        spots.append((tip * [1, 1, 0] - [0, 8.0, 0], 8.0, 0.7))
    bell = [w * np.exp(-((points - p) ** 2).sum(1) / (2 * s * s)) for p, s, w in spots]
    return np.asarray(np.clip(np.sum(bell, axis=0), 0, 1))


def _arch(points: FloatArray, landmarks_mm: dict[str, FloatArray]) -> FloatArray:
    """Compute how far points (n,) lie in the medial arch, 0 to 1."""
    heel, head = landmarks_mm["pternion"], landmarks_mm["metatarsal_head_1"]
    centre = heel + 0.58 * (head - heel)
    return np.asarray(np.exp(-(((points - centre) / [26.0, 38.0, 30.0]) ** 2).sum(axis=1) / 2))


def _mottling(points: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Draw a smooth random pattern (n,) of unit strength: plane waves of 15 to 60 mm length."""
    count = 24
    direction = rng.standard_normal((3, count))
    direction /= np.linalg.norm(direction, axis=0)
    waves = points @ (direction * 2 * np.pi / rng.uniform(15, 60, count))
    return np.asarray(np.cos(waves + rng.uniform(0, 2 * np.pi, count)).sum(1) / np.sqrt(count / 2))


def _pen_cross(mesh: TriangleMesh, centre: FloatArray, turn_deg: float) -> BoolArray:
    """Return which vertices (n,) lie on the cross drawn on the sole."""
    turn = np.radians(turn_deg)
    along = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    offset = np.abs((mesh.vertices[:, :2] - centre) @ along.T)
    stroke = (offset.max(1) < _PEN_LENGTH_MM / 2) & (offset.min(1) < _PEN_WIDTH_MM / 2)
    return np.asarray(stroke & (mesh.vertex_normals[:, 2] < -0.3))
