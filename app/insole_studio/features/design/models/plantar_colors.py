"""Paints a pressure map or a footprint over the sole of a foot, or over an insole."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.pressure.laid_map import FootprintPicture, PressureMap
from insole_studio.scene.coloring import Coloring, map_colors
from insole_studio.texts import tr

FADE_KPA = (5.0, 25.0)
"""Pressures below are not painted, and those between fade: there the foot or the insole shows."""
_LEAST_SPAN_KPA, _ROUND_KPA = 50.0, 50.0
_FACING, _HIGHEST_MM = -0.1, 30.0
_SKIN, _MATERIAL = (224.0, 190.0, 170.0), (222.0, 216.0, 202.0)


def painted_foot(
    shown: PressureMap | FootprintPicture, mesh: TriangleMesh, opacity: float
) -> Coloring:
    """Return the colours of a foot with a map over its sole.

    Parameters
    ----------
    shown
        The map or picture, under the foot.
    mesh : mm, insole frame
        The foot as shown.
    opacity
        0 to 1.
    """
    if mesh.colors is not None:
        base = mesh.colors.astype(np.float64)
    else:
        base = np.tile(_SKIN, (len(mesh.vertices), 1))
    is_sole = (mesh.vertex_normals[:, 2] < _FACING) & (mesh.vertices[:, 2] < _HIGHEST_MM)
    return _painted(shown, mesh.vertices, base, is_sole, opacity)


def painted_insole(
    shown: PressureMap | FootprintPicture, vertices: FloatArray, is_top: BoolArray, opacity: float
) -> Coloring:
    """Return the colours of an insole with a map over its upper side.

    Parameters
    ----------
    vertices : (n, 3) float64, mm, insole frame
    is_top : (n,) bool
        Which of them belong to the upper side.
    """
    base = np.tile(_MATERIAL, (len(vertices), 1))
    return _painted(shown, vertices, base, is_top, opacity)


def _painted(
    shown: PressureMap | FootprintPicture,
    vertices: FloatArray,
    base: FloatArray,
    where: BoolArray,
    opacity: float,
) -> Coloring:
    values = np.full(len(vertices), np.nan)
    colors = base.copy()
    points = vertices[where, :2]
    if isinstance(shown, PressureMap):
        limits, title, unit = (0.0, span_kpa(shown)), tr("Pressure"), "kPa"
        values[where] = shown.at(points)
        faded = np.interp(np.nan_to_num(values), FADE_KPA, (0.0, opacity))
        on = faded > 0
        colors[on] = map_colors(values[on], limits)
    else:
        limits, title, unit = (0.0, 1.0), "", ""
        seen, covered = shown.at(points)
        on = where.copy()
        on[where] = covered
        colors[on] = seen[covered]
        faded = np.where(on, opacity, 0.0)
    share = faded[:, None]
    colors = share * colors + (1 - share) * base
    return Coloring(values, limits, title, unit=unit, painted=colors.round().astype(np.uint8))


def span_kpa(shown: PressureMap) -> float:
    """Return the greatest value of the legend: the peak, rounded up to 50 kPa."""
    return max(float(np.ceil(shown.peak_kpa / _ROUND_KPA) * _ROUND_KPA), _LEAST_SPAN_KPA)
