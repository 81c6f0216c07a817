"""Objects that are not feet, so that the network does not take flat, smooth objects for feet."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rotation_about

_STEPS = 240
_GREY = 160


def varied_thing(rng: np.random.Generator) -> TriangleMesh:
    """Draw a random superellipsoid between a ball and a box or a plate, mm."""
    half_mm = rng.uniform((25, 40, 8), (60, 110, 60))
    roundness = 2 / rng.uniform(2, 12)
    around = np.linspace(-np.pi, np.pi, 2 * _STEPS, endpoint=False)
    up = np.linspace(-np.pi / 2, np.pi / 2, _STEPS)
    latitude, longitude = (axis.ravel() for axis in np.meshgrid(up, around, indexing="ij"))
    level, height = (_power(wave(latitude), roundness) for wave in (np.cos, np.sin))
    x, y = (_power(wave(longitude), roundness) * level for wave in (np.cos, np.sin))
    places = np.column_stack([x, y, height]) * half_mm
    for axis, degrees in zip(np.eye(3), rng.normal(0, 30, 3), strict=True):
        places = places @ rotation_about(axis, degrees).T
    middle = rng.uniform((-15, -30, 20), (15, 30, 60))
    colors = np.full((len(places), 3), _GREY, np.uint8)
    return TriangleMesh(places + middle, _lattice(_STEPS, 2 * _STEPS), colors)


def _power(wave: FloatArray, exponent: float) -> FloatArray:
    return np.asarray(np.sign(wave) * np.abs(wave) ** exponent)


def _lattice(rows: int, columns: int) -> np.ndarray:
    """Return the triangles between rows of points that are closed rings."""
    index = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    here, aside = index[:-1], np.roll(index, -1, axis=1)[:-1]
    above, across = index[1:], np.roll(index, -1, axis=1)[1:]
    halves = ((here, aside, above), (aside, across, above))
    return np.concatenate([np.stack(half, axis=-1).reshape(-1, 3) for half in halves])
