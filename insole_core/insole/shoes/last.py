"""The inside of a shoe from its last: laid on its sole, heel behind, and seen from below."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.outline.shoe_fit import middles
from insole_core.insole.prescription.outline import Shoe
from insole_core.insole.primitives.outline_curve import evenly_spread, smoothed_along

_TURNS = 180
_SOLE_DEG, _FACING_DEG = 25.0, 50.0
_PITCH_MM, _EVENING_MM, _POINTS = 0.5, 1.5, 120
_LENGTH_MM, _SLENDER = (80.0, 400.0), (0.2, 0.7)
_LEAST_SOLE = 0.35
"""Of the rectangle round the outline: a sole fills two thirds of it."""
_TIP, _CLEAR_MM = 0.04, 2.0
"""Share of the length that is the toe's tip; farther to a side it tells which foot."""


@dataclass(frozen=True, eq=False)
class LastOutline:
    """The edge of a last's sole.

    Parameters
    ----------
    edge_mm : (n, 2) float64
        In the shoe's frame, medial = +x if it is a last of `side`.
    side
        Which foot it is; None where its shape does not tell.
    """

    edge_mm: FloatArray
    side: Side | None

    def shoe(self, name: str, side: Side) -> Shoe:
        """Return the shoe of this last.

        Parameters
        ----------
        side
            Of the foot that the insole is for.

        Raises
        ------
        InputError
            When the last is of the other side.
        """
        if self.side is side.other:
            raise InputError(
                "{name} is a last for the {last_side} foot, and the insole is for the {side} one; "
                "choose the other last of the pair.",
                name=name,
                last_side=side.other,
                side=side,
            )
        edge = self.edge_mm if self.side is not None else self.edge_mm * [side.medial_sign, 1.0]
        return Shoe(name=name, inside_mm=tuple((float(x), float(y)) for x, y in edge))


def last_outline(last: TriangleMesh, name: str) -> LastOutline:
    """Find the edge of a last's sole.

    The sole is the largest part of the surface that faces one way square to the last's length.

    Parameters
    ----------
    last : mm, lying in any way
    name
        For errors.

    Raises
    ------
    InputError
        When the surface is no last.
    """
    ahead = _long_axis(last.vertices)
    down = _sole_direction(last, ahead, name)
    seen = last.triangle_normals @ down > np.cos(np.radians(_FACING_DEG))
    # Seen from above: x to the right when the toes point away.
    frame = np.stack([np.cross(ahead, -down), ahead])
    edge = _edge(last.vertices[last.triangles[seen]] @ frame.T, name)
    edge = _heel_behind(edge)
    _require_shoe(edge, name)
    edge = _in_its_frame(edge)
    tip = edge[edge[:, 1] > (1 - _TIP) * edge[:, 1].max(), 0].mean()
    if abs(tip) < _CLEAR_MM:
        return LastOutline(edge, None)
    side = Side.LEFT if tip > 0 else Side.RIGHT
    return LastOutline(edge * [side.medial_sign, 1.0], side)


def _long_axis(points: FloatArray) -> FloatArray:
    centred = points - points.mean(axis=0)
    return np.asarray(np.linalg.eigh(centred.T @ centred)[1][:, -1])


def _sole_direction(last: TriangleMesh, ahead: FloatArray, name: str) -> FloatArray:
    """Return the direction (3,) square to the length that most of the surface faces."""
    across = np.linalg.svd(ahead[None])[2][1:]
    angle = np.arange(_TURNS) * 2 * np.pi / _TURNS
    ways = np.cos(angle)[:, None] * across[0] + np.sin(angle)[:, None] * across[1]
    cosine = last.triangle_normals @ ways.T
    facing = np.clip(cosine - np.cos(np.radians(_SOLE_DEG)), 0, None)
    area = last.triangle_areas_mm2 @ facing
    if not area.any():
        raise _no_last(name)
    return np.asarray(ways[int(area.argmax())])


def _edge(triangles: FloatArray, name: str) -> FloatArray:
    """Return the outer edge (n, 2) of triangles (m, 3, 2), mm."""
    if not len(triangles):
        raise _no_last(name)
    low = triangles.min(axis=(0, 1)) - 5
    size = np.ceil((triangles.max(axis=(0, 1)) + 5 - low) / _PITCH_MM).astype(int)
    image = np.zeros((size[1], size[0]), np.uint8)
    shift = 4
    corners = np.rint((triangles - low) / _PITCH_MM * 2**shift).astype(np.int32)
    for corner in corners:
        cv2.fillConvexPoly(image, corner, 255, lineType=cv2.LINE_8, shift=shift)
    closed = cv2.morphologyEx(image, cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8))
    contours, _ = cv2.findContours(closed, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    edge = max(contours, key=cv2.contourArea)[:, 0] * _PITCH_MM + low
    area = cv2.contourArea(edge.astype(np.float32))
    if len(edge) < _POINTS or area < _LEAST_SOLE * float(np.prod(np.ptp(edge, axis=0))):
        raise _no_last(name)
    return smoothed_along(evenly_spread(edge, 8 * _POINTS), _EVENING_MM)


def _heel_behind(edge: FloatArray) -> FloatArray:
    """Turn an edge so that its wide end, the ball, is ahead."""
    y = (edge[:, 1] - edge[:, 1].min()) / np.ptp(edge[:, 1])
    rear, front = (np.ptp(edge[np.abs(y - share) < 0.05, 0]) for share in (0.33, 0.67))
    return edge if front >= rear else -edge


def _require_shoe(edge: FloatArray, name: str) -> None:
    width_mm, length_mm = np.ptp(edge, axis=0)
    fits = _LENGTH_MM[0] <= length_mm <= _LENGTH_MM[1]
    if not fits or not _SLENDER[0] < width_mm / length_mm < _SLENDER[1]:
        raise _no_last(name)


def _in_its_frame(edge: FloatArray) -> FloatArray:
    """Return places (_POINTS, 2), heel behind at y = 0, middles of heel and ball at x = 0."""
    for _ in range(3):
        heel, ball = middles(edge)
        turn = np.arctan2(*(ball - heel))
        rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        edge = (edge - heel) @ rotation.T
    edge = edge - [0, edge[:, 1].min()]
    return evenly_spread(edge, _POINTS)


def _no_last(name: str) -> InputError:
    return InputError(
        "{name} does not look like a last: no sole of a shoe is found on it; hand in the last as a "
        "surface with its sole.",
        name=name,
    )
