"""Objects that are not feet, so that the network does not take flat, smooth objects for feet."""

from __future__ import annotations

import numpy as np
import trimesh

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rotation_about

_STEPS = 240
_GREY = 160
_STEPPED = 0.5
"""Fraction of the objects that have steps."""


def varied_thing(rng: np.random.Generator) -> TriangleMesh:
    """Draw a ball, a box, a plate or something between them, or several on top of each other, mm.

    The steps between them look to a sensor like the grooves between toes, and are none.
    """
    half_mm = rng.uniform((25, 40, 8), (60, 110, 60))
    roundness = 2 / rng.uniform(2, 12)
    things = [_superellipsoid(half_mm, roundness)]
    if rng.random() < _STEPPED:
        things += _steps(half_mm, rng)
    turn = np.eye(3)
    for axis, degrees in zip(np.eye(3), rng.normal(0, 30, 3), strict=True):
        turn = turn @ rotation_about(axis, degrees).T
    places = np.concatenate(things) @ turn + rng.uniform((-15, -30, 20), (15, 30, 60))
    one = _lattice(_STEPS, 2 * _STEPS)
    triangles = np.concatenate([one + n * len(things[0]) for n in range(len(things))])
    colors = np.full((len(places), 3), _GREY, np.uint8)
    return TriangleMesh(places, triangles.astype(np.int32), colors)


def varied_stack(rng: np.random.Generator) -> TriangleMesh:
    """Draw two to five boxes with sharp edges, each smaller than the last and below it, mm."""
    half_mm = rng.uniform((30, 60, 10), (65, 125, 40))
    boxes, below_mm = [trimesh.creation.box(2 * half_mm)], 0.0
    for _ in range(rng.integers(1, 5)):
        below_mm += rng.uniform(2, 28)
        smaller = half_mm * [rng.uniform(0.55, 1.0), rng.uniform(0.4, 0.95), 1]
        aside = (half_mm - smaller) * [*rng.uniform(-1, 1, 2), 0]
        moved = trimesh.transformations.translation_matrix(aside - [0, 0, below_mm])
        boxes.append(trimesh.creation.box(2 * smaller, transform=moved))
        half_mm = smaller
    stack = trimesh.util.concatenate(boxes)
    turn = np.eye(3)
    for axis, degrees in zip(np.eye(3), rng.normal(0, 12, 3), strict=True):
        turn = turn @ rotation_about(axis, degrees).T
    low_mm = rng.uniform((-10, -20, -10), (10, 20, 15))
    places = stack.vertices @ turn
    places += low_mm - [0, 0, places[:, 2].min()]
    colors = np.full((len(places), 3), _GREY, np.uint8)
    return TriangleMesh(places, np.asarray(stack.faces, np.int32), colors)


def _steps(half_mm: FloatArray, rng: np.random.Generator) -> list[FloatArray]:
    """Draw smaller bodies on the lower side of one, each a step of 2 to 25 mm below the last."""
    steps, below_mm = [], 0.0
    for _ in range(rng.integers(1, 4)):
        below_mm += rng.uniform(2, 25)
        smaller = half_mm * [rng.uniform(0.4, 1.05), rng.uniform(0.2, 0.8), 1]
        aside = half_mm * [*rng.uniform(-0.4, 0.4, 2), 0]
        steps.append(_superellipsoid(smaller, 2 / rng.uniform(4, 16)) + aside - [0, 0, below_mm])
    return steps


def _superellipsoid(half_mm: FloatArray, roundness: float) -> FloatArray:
    """Return points (n, 3) on closed rings, from the lower pole to the upper one."""
    around = np.linspace(-np.pi, np.pi, 2 * _STEPS, endpoint=False)
    up = np.linspace(-np.pi / 2, np.pi / 2, _STEPS)
    latitude, longitude = (axis.ravel() for axis in np.meshgrid(up, around, indexing="ij"))
    level, height = (_power(wave(latitude), roundness) for wave in (np.cos, np.sin))
    x, y = (_power(wave(longitude), roundness) * level for wave in (np.cos, np.sin))
    return np.asarray(np.column_stack([x, y, height]) * half_mm)


def _power(wave: FloatArray, exponent: float) -> FloatArray:
    return np.asarray(np.sign(wave) * np.abs(wave) ** exponent)


def _lattice(rows: int, columns: int) -> np.ndarray:
    """Return the triangles between rows of points that are closed rings."""
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    here, aside = index[:-1], np.roll(index, -1, axis=1)[:-1]
    above, across = index[1:], np.roll(index, -1, axis=1)[1:]
    halves = ((here, aside, above), (aside, across, above))
    return np.concatenate([np.stack(half, axis=-1).reshape(-1, 3) for half in halves])
