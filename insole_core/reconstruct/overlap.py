"""Where views overlap, their surfaces are blended by weight, and the better one remains."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.reconstruct.sheet import Sheet

_SMOOTHING_PIXELS = 9
_SAME_SURFACE_MM = 6.0
_MUCH_BETTER = 1.25
_FOUR_CORNERS = 0.999


@dataclass(frozen=True, eq=False)
class _Guide:
    """A sheet as other sheets see it.

    Parameters
    ----------
    sheet
    measured : (height, width) bool
        Pixels that belong to a triangle.
    normals : (height, width, 3) float64
        Of the smoothed surface, towards the sensor, reference frame.
    weights : (height, width) float64
        cos² of incidence / distance⁴: the inverse variance of a reading.
    """

    sheet: Sheet
    measured: BoolArray
    normals: FloatArray
    weights: FloatArray


def blend_overlaps(sheets: list[Sheet]) -> list[Sheet]:
    """Move every sheet to the weighted mean of all, and keep each part from the view that faces it.

    A view's weight is the inverse variance of its readings: cos² of the incidence over the fourth
    power of the distance. A triangle goes when another view that measured the same place has a
    weight that is a quarter larger; nearly equal views both stay, blended to the same surface.
    """
    guides = [_guide(sheet) for sheet in sheets]
    return [_blended(guide, [other for other in guides if other is not guide]) for guide in guides]


def _guide(sheet: Sheet) -> _Guide:
    measured = np.zeros(sheet.points.shape[:2], dtype=bool)
    measured.flat[sheet.triangles.ravel()] = True
    from_sensor = sheet.points - sheet.sensor2reference[:3, 3]
    distance = np.linalg.norm(from_sensor, axis=2)
    normals = _smooth_normals(sheet.points, measured)
    cosine = -np.einsum("ijk,ijk->ij", normals, from_sensor) / distance
    weights = np.where(measured, np.clip(cosine, 0.05, 1) ** 2 / distance**4, 0)
    return _Guide(sheet, measured, normals, np.nan_to_num(weights))


def _smooth_normals(points: FloatArray, measured: BoolArray) -> FloatArray:
    """Unit normals towards the sensor of the box-smoothed lattice; zero where there is none."""
    size = (_SMOOTHING_PIXELS, _SMOOTHING_PIXELS)
    count = cv2.blur(measured.astype(np.float64), size)
    held = np.where(measured[..., None], points, 0)
    smooth = cv2.blur(held, size) / np.maximum(count, 1e-9)[..., None]
    normals = np.cross(np.gradient(smooth, axis=0), np.gradient(smooth, axis=1))
    length = np.linalg.norm(normals, axis=2, keepdims=True)
    return np.where(measured[..., None] & (length > 0), normals / np.maximum(length, 1e-12), 0)


def _blended(guide: _Guide, others: list[_Guide]) -> Sheet:
    """Move the vertices of one sheet along their normals, and drop what others see better."""
    sheet, at = guide.sheet, guide.measured
    points, normals, own = sheet.points[at], guide.normals[at], guide.weights[at]
    total, shift, rival = own.copy(), np.zeros(len(own)), np.zeros(len(own))
    for other in others:
        gap_mm, weight = _gaps(points, normals, other)
        total += weight
        shift += weight * gap_mm
        rival = np.maximum(rival, weight)
    moved = sheet.points.copy()
    moved[at] = points + (shift / total)[:, None] * normals
    better = np.zeros(at.shape, dtype=bool)
    better[at] = rival > _MUCH_BETTER * own
    kept = ~better.ravel()[sheet.triangles].all(1)
    return replace(sheet, points=moved, triangles=sheet.triangles[kept])


def _gaps(points: FloatArray, normals: FloatArray, other: _Guide) -> tuple[FloatArray, FloatArray]:
    """Signed distances along the normals to another view's surface, and that view's weights.

    The weight is 0 where the other view measured nothing, or something else.
    """
    camera = other.sheet.camera
    seen = transform(inverse(other.sheet.sensor2reference), points)
    pixels = camera.project(seen).astype(np.float32)[:, None]
    layers = np.dstack(
        [np.where(other.measured[..., None], other.sheet.points, 0), other.weights, other.measured]
    ).astype(np.float32)
    found = _sample(layers, pixels)
    gap_mm = np.einsum("ij,ij->i", found[:, :3] - points, normals)
    same = (found[:, 4] > _FOUR_CORNERS) & (np.abs(gap_mm) < _SAME_SURFACE_MM)
    return np.where(same, gap_mm, 0), np.where(same, found[:, 3], 0)


def _sample(layers: Float32Array, pixels: Float32Array) -> FloatArray:
    parts = [
        cv2.remap(part, pixels, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT)[:, 0]
        for part in (layers[..., :3], layers[..., 3:])
    ]
    return np.concatenate([part.reshape(len(pixels), -1) for part in parts], axis=1).astype(float)
