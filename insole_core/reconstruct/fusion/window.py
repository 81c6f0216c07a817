"""What the sensor's window makes of a surface: it reports the mean of what lies in it."""

from __future__ import annotations

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.reconstruct.fusion.reading import Reading

WINDOW_PX = 9
"""Side of the square that the sensor compares with its pattern (Konolige & Mihelich)."""
_LARGEST_SPREAD_RAW = 16.0
"""Two pixels of disparity: beyond it parts of a window no longer match together."""
_NOISE_RAW = 0.15
"""Smaller corrections than this are as likely noise of the mesh as shape of the foot."""
_LARGEST_RAW = 2.0
_LEAST_LIGHT = 0.02


def without_window_error(reading: Reading, mesh: TriangleMesh) -> Reading:
    """Take out of a reading by how much the window's mean differs from its middle.

    The dots in a window count as they are lit, with the cosine of the incidence. So the side that
    faces the sensor counts more, rims appear nearer than they are, and rounded shapes flatter.

    Parameters
    ----------
    reading
    mesh
        The surface as far as it is known.
    """
    raw, light = _rendered(reading, mesh)
    error = _mean_minus_middle(raw, light)
    shrunk = np.sign(error) * np.maximum(np.abs(error) - _NOISE_RAW, 0)
    return reading.with_raw(reading.raw - np.clip(shrunk, -_LARGEST_RAW, _LARGEST_RAW))


def _rendered(reading: Reading, mesh: TriangleMesh) -> tuple[FloatArray, FloatArray]:
    """Raw numbers of the mesh, NaN beside it, and how brightly it is lit; both (height, width)."""
    rays = reading.directions(reading.pixels).reshape(-1, 3)
    hits = RayCaster(mesh).cast(reading.origin_mm, rays)
    corners = mesh.triangles[hits.triangle]
    places = np.einsum("nk,nkc->nc", hits.weights, mesh.vertices[corners])
    normals = np.einsum("nk,nkc->nc", hits.weights, mesh.vertex_normals[corners])
    rays = rays[hits.ray]
    lengths = np.linalg.norm(normals, axis=1) * np.linalg.norm(rays, axis=1)
    cosine = -np.einsum("nc,nc->n", normals, rays) / np.maximum(lengths, 1e-12)
    raw, light = np.full(reading.raw.shape, np.nan), np.zeros(reading.raw.shape)
    raw.flat[hits.ray] = reading.sensor.disparity.raw(reading.depth_along(places))
    light.flat[hits.ray] = np.clip(cosine, _LEAST_LIGHT, 1)
    return raw, light


def _mean_minus_middle(raw: FloatArray, light: FloatArray) -> FloatArray:
    known = np.isfinite(raw)
    if not known.any():
        return np.zeros_like(raw)
    values = np.where(known, raw - np.nanmedian(raw), 0)
    error = _sum(light * values) / np.maximum(_sum(light), 1e-9) - values
    return np.where(known & _is_one_surface(values, known), error, 0)


def _sum(image: FloatArray) -> FloatArray:
    size = (WINDOW_PX, WINDOW_PX)
    return np.asarray(
        cv2.boxFilter(image, -1, size, normalize=False, borderType=cv2.BORDER_CONSTANT)
    )


def _is_one_surface(values: FloatArray, known: BoolArray) -> BoolArray:
    kernel = np.ones((WINDOW_PX, WINDOW_PX), np.uint8)
    highest = cv2.dilate(np.where(known, values, -1e9), kernel)
    lowest = cv2.erode(np.where(known, values, 1e9), kernel)
    return np.asarray(highest - lowest < _LARGEST_SPREAD_RAW)
