"""The colour of every vertex, from the colour images at full resolution."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from insole_core.geometry.arrays import ByteArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster
from insole_core.geometry.transforms import inverse, transform
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.parallel import for_views

_CLEARANCE_MM = 2.0
_SHARPNESS = 8
"""Power of the cosine by which views are blended: high, so that nearly everywhere one image
counts and pen strokes stay crisp; the seam is a narrow band where two views see equally well."""
_LEAST_COMMON = 50
_ROW = 4096


@dataclass(frozen=True, eq=False)
class _Look:
    """The vertices as seen by one view.

    Parameters
    ----------
    colors : (n, 3) float64
    weight : (n,) float64
        0 where the view does not see the vertex.
    """

    colors: FloatArray
    weight: FloatArray


def color_vertices(
    mesh: TriangleMesh, readings: list[DepthView], outside: TriangleMesh | None = None
) -> ByteArray:
    """Colour every vertex by the views that face it, after balancing the views.

    Parameters
    ----------
    mesh : mm, reference frame
    readings
        At least one.
    outside
        A coarser mesh of the same surface, used to find which vertices are hidden; by default the
        mesh itself.

    Returns
    -------
    (n, 3) uint8, RGB
    """
    caster = RayCaster(mesh if outside is None else outside)
    looks = for_views(lambda reading: _look(mesh, caster, reading), readings)
    gains = _balancing_gains(looks)
    total = sum(
        (
            look.weight[:, None] * gain * look.colors
            for look, gain in zip(looks, gains, strict=True)
        ),
        np.zeros((len(mesh.vertices), 3)),
    )
    weight = sum((look.weight for look in looks), np.zeros(len(mesh.vertices)))
    seen = weight > 0
    colors = np.full(total.shape, 128.0)
    colors[seen] = total[seen] / weight[seen, None]
    return np.asarray(np.clip(np.rint(colors), 0, 255), dtype=np.uint8)


def _look(mesh: TriangleMesh, caster: RayCaster, reading: DepthView) -> _Look:
    eye = reading.color2reference[:3, 3]
    way = eye - mesh.vertices
    cosine = np.einsum("nc,nc->n", mesh.vertex_normals, way) / np.linalg.norm(way, axis=1)
    camera = reading.sensor.color_camera
    pixels = camera.project(transform(inverse(reading.color2reference), mesh.vertices))
    within = ((pixels > 0) & (pixels < [camera.width - 1, camera.height - 1])).all(1)
    # Vertices that no view faces well still get the colour of the view that sees them best.
    weight = np.where(within, np.clip(cosine, 1e-3, 1) ** _SHARPNESS, 0)
    seen = within & (cosine > 0)
    seen[seen] = ~caster.is_blocked(mesh.vertices[seen], eye, _CLEARANCE_MM)
    weight = np.where(seen, weight, 1e-6 * weight)
    return _Look(_sample(reading.color, pixels), weight)


def _sample(color: ByteArray, pixels: FloatArray) -> FloatArray:
    """Look up colours (n, 3) at positions (n, 2) by bilinear interpolation."""
    # OpenCV takes maps of less than 32767 rows, so the positions are folded into a rectangle.
    rows = -(-len(pixels) // _ROW)
    folded = np.zeros((rows * _ROW, 2), np.float32)
    folded[: len(pixels)] = pixels
    found = cv2.remap(
        color, folded.reshape(rows, _ROW, 2), None, cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    )  # fmt: skip
    return np.asarray(found.reshape(-1, 3)[: len(pixels)], dtype=float)


def _balancing_gains(looks: list[_Look]) -> FloatArray:
    """Compute gains (views, 3) that make overlapping views agree; their product is 1.

    Least squares over the pairs of views on the logarithms of the mean colours in common.
    """
    count = len(looks)
    normal, right = np.full((count, count), 1.0), np.zeros((count, 3))
    for i, first in enumerate(looks):
        for j, second in enumerate(looks[:i]):
            common = np.minimum(first.weight, second.weight)
            if (common > 1e-3).sum() < _LEAST_COMMON:
                continue
            ratio = np.log((common @ first.colors + 1) / (common @ second.colors + 1))
            normal += _pair(count, i, j)
            right[i] -= ratio
            right[j] += ratio
    return np.asarray(np.exp(np.linalg.lstsq(normal, right, rcond=None)[0]))


def _pair(count: int, i: int, j: int) -> FloatArray:
    step = np.zeros(count)
    step[i], step[j] = 1, -1
    return np.outer(step, step)
