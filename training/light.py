"""How bright a foot looks to the colour camera: under any lamps, with any skin, with pen marks."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray
from insole_core.geometry.transforms import rotation_about, transform
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.neighbourhood import shading_of
from insole_core.simulate.scene import Hits, SceneCaster

_BEYOND = 26.0
"""Brightness of everything but the foot: nearly black."""
_UNSEEN = 0.15
"""Fraction of views whose picture carries no information, so that depth alone must do."""
_PATTERNS, _PEN_MARKS = 8, 4
_PEN_MM = 1.2
_ASIDE_MM = 0.7
_NOISE_LEVELS = 1.5


def varied_shading(reading: DepthView, foot: SceneCaster, rng: np.random.Generator) -> Float32Array:
    """Light the foot at random, and compare the brightness of every reading with its surroundings.

    Readings are off by millimetres, and the colour camera is beside the depth camera; so the
    brightness is looked up slightly beside the measured point, as in the product.

    Parameters
    ----------
    foot
        Casts rays onto the true surface.

    Returns
    -------
    (height, width) float32
    """
    levels = np.full(reading.raw.shape, _BEYOND)
    if rng.uniform() < _UNSEEN:
        return shading_of(levels, reading.known)
    eye_mm = reading.color2reference[:3, 3]
    places = reading.surface_points + rng.normal(0, _ASIDE_MM, 3)
    hits = foot.cast(eye_mm, places - eye_mm)
    seen = np.full(len(places), _BEYOND)
    seen[hits.ray] = _skin(hits, rng) * _lamps(hits, reading.color2reference, foot, rng)
    levels[reading.known] = np.clip(seen + rng.normal(0, _NOISE_LEVELS, len(seen)), 0, 255)
    return shading_of(levels, reading.known)


def _lamps(
    hits: Hits, color2reference: FloatArray, foot: SceneCaster, rng: np.random.Generator
) -> FloatArray:
    """Return the illumination (n,) of each place: ambient, and from one or two lamps."""
    ambient = rng.uniform(0.25, 0.65)
    light = np.zeros(len(hits.ray))
    count = int(rng.integers(1, 3))
    for _ in range(count):
        lamp_mm = transform(color2reference, rng.normal((0, -200, -100), (400, 300, 200)))
        way = lamp_mm - hits.points
        way /= np.linalg.norm(way, axis=1, keepdims=True)
        facing = np.clip(np.einsum("nc,nc->n", hits.normals, way), 0, 1)
        if rng.uniform() < 0.5:
            facing[foot.is_blocked(hits.points, lamp_mm)] *= rng.uniform(0, 0.6)
        light += facing / count
    return np.asarray(ambient + (1 - ambient) * light)


def _skin(hits: Hits, rng: np.random.Generator) -> FloatArray:
    """Return the reflectance (n,): darker and paler regions, and pen lines."""
    level = np.full(len(hits.ray), rng.uniform(60, 230))
    for wavelength_mm in rng.uniform(12, 90, _PATTERNS):
        direction = rng.standard_normal(3)
        direction *= 2 * np.pi / wavelength_mm / np.linalg.norm(direction)
        wave = np.cos(hits.points @ direction + rng.uniform(0, 7))
        level *= 1 + rng.uniform(0, 0.04) * wave
    for _ in range(int(rng.integers(0, _PEN_MARKS + 1))):
        level[_pen(hits.points, rng)] *= rng.uniform(0.15, 0.7)
    return level


def _pen(points: FloatArray, rng: np.random.Generator) -> BoolArray:
    """Return which points (n,) a cross, a ring or a line covers."""
    turn = rotation_about(np.array([0.0, 0.0, 1.0]), rng.uniform(0, 180))
    x, y, _ = ((points - points[rng.integers(len(points))]) @ turn).T
    size_mm, half_mm = rng.uniform(3, 15), _PEN_MM * rng.uniform(0.4, 1)
    lying = (np.abs(y) < half_mm) & (np.abs(x) < size_mm)
    standing = (np.abs(x) < half_mm) & (np.abs(y) < size_mm)
    ring = np.abs(np.hypot(x, y) - size_mm) < half_mm
    return np.asarray((lying, lying | standing, ring)[int(rng.integers(3))])
