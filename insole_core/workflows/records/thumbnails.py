"""Small pictures of a foot and of its insole from below, for lists of visits.

They are drawn from heights over a grid, without a renderer, so that they can be made in any thread.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from insole_core.cases.case_record import FootRecord
from insole_core.compare.seen_surface import grid_over, height_map
from insole_core.errors import DesignError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.progress import SILENT, Progress
from insole_core.workflows.insole_builder import InsoleBuilder

Rgba = NDArray[np.uint8]

_PITCH_MM = 2.0
_SKIN, _MATERIAL = (214.0, 178.0, 158.0), (196.0, 202.0, 208.0)
_LIGHT = np.array([-0.4, 0.5, 0.77])
_LEAST_LIGHT = 0.35
_LEAST_BESIDE = 3
"""Of four neighbours that have a height, so that a node between them has one too."""


@dataclass(frozen=True, eq=False)
class Thumbnails:
    """Pictures of a foot and of its insole, heel below.

    Parameters
    ----------
    foot, insole : (h, w, 4) uint8
        Red, green, blue, opacity; 2 mm a pixel. The foot is seen from below, the insole from above;
        None where it cannot be built.
    """

    foot: Rgba
    insole: Rgba | None


def thumbnails(foot: FootRecord, progress: Progress = SILENT) -> Thumbnails:
    """Return the pictures of a foot and of the insole of its chosen variant.

    Raises
    ------
    Cancelled
    """
    sole = _picture(foot.foot.mesh, from_above=False, color=_SKIN)
    try:
        _insole, solid = InsoleBuilder().solid(foot.foot, foot.design, progress)
    except DesignError:
        return Thumbnails(sole, None)
    return Thumbnails(sole, _picture(solid, from_above=True, color=_MATERIAL))


def _picture(mesh: TriangleMesh, *, from_above: bool, color: tuple[float, float, float]) -> Rgba:
    """Return a surface as a shaded relief, toes above.

    From below it is mirrored as a sole is that one looks at.
    """
    heights = np.asarray(height_map(mesh, grid_over(mesh, _PITCH_MM), from_above=from_above))
    heights = _without_holes(heights)
    if not from_above:
        heights = -heights[:, ::-1]
    shade = _shade(heights[::-1])
    seen = np.isfinite(shade)
    picture = np.zeros((*heights.shape, 4), dtype=np.uint8)
    lit = np.nan_to_num(shade)[..., None] * np.array(color)
    picture[..., :3] = np.clip(lit, 0, 255)
    picture[..., 3] = np.where(seen, 255, 0)
    return picture


def _without_holes(heights_mm: FloatArray) -> FloatArray:
    """Return heights with single missing nodes filled: steep flanks are missed by some rays."""
    missing = ~np.isfinite(heights_mm)
    around = np.pad(heights_mm, 1, constant_values=np.nan)
    beside = np.stack([around[:-2, 1:-1], around[2:, 1:-1], around[1:-1, :-2], around[1:-1, 2:]])
    count = np.isfinite(beside).sum(axis=0)
    filled = missing & (count >= _LEAST_BESIDE)
    mean = np.nansum(beside, axis=0) / np.maximum(count, 1)
    return np.where(filled, mean, heights_mm)


def _shade(heights_mm: FloatArray) -> FloatArray:
    """Return how bright each node (row, column; toes above) is; NaN where there is no surface."""
    filled = np.where(np.isfinite(heights_mm), heights_mm, np.nanmean(heights_mm))
    down, across = np.gradient(filled, _PITCH_MM)
    normal = np.stack([-across, down, np.ones_like(filled)], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    light = _LIGHT / np.linalg.norm(_LIGHT)
    lit = _LEAST_LIGHT + (1.15 - _LEAST_LIGHT) * np.clip(normal @ light, 0, 1)
    return np.asarray(np.where(np.isfinite(heights_mm), lit, np.nan))
