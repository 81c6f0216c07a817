"""The egg-shaped pelott: outline (26), Gaussian neighbourhood (25), and a smooth edge.

The thesis cuts the Gaussian off at the outline, which leaves a step there. Here it is multiplied by
a window that falls to zero at the outline with zero slope, so that the skin meets no edge; outside
the outline nothing changes, and at the apex the height is exactly the one asked for.
"""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.blending import smooth_step
from insole_core.insole.design import Pelott

_OUTLINE_POINTS = 1440
_PLATEAU = 0.5  # share of the way to the outline that the window leaves untouched


def egg_outline(pelott: Pelott, points: int = _OUTLINE_POINTS) -> FloatArray:
    """Outline of a pelott, counter-clockwise, the first point not repeated.

    Returns
    -------
    (points, 2) float64, mm, insole frame
    """
    return _to_insole(_local_outline(pelott, points), pelott)


def pelott_heights(pelott: Pelott, xy: FloatArray) -> FloatArray:
    """Height that a pelott adds at places (..., 2) of the insole frame, mm."""
    xy = np.asarray(xy, dtype=float)
    local = (xy - np.array(pelott.centre_mm)) @ _turn(pelott)
    sigma = pelott.sigma_mm or (pelott.width_mm / 2, pelott.length_mm / 2)
    gauss = np.exp(-0.5 * ((local / np.array(sigma)) ** 2).sum(axis=-1))
    return np.asarray(pelott.height_mm * gauss * _window(pelott, local))


def _window(pelott: Pelott, local: FloatArray) -> FloatArray:
    """1 round the apex, 0 from the outline on, with a continuous slope between."""
    outline = _local_outline(pelott, _OUTLINE_POINTS)
    angle = np.arctan2(outline[:, 1], outline[:, 0])
    order = np.argsort(angle)
    reach = np.interp(
        np.arctan2(local[..., 1], local[..., 0]),
        angle[order],
        np.hypot(outline[order, 0], outline[order, 1]),
        period=2 * np.pi,
    )
    share = np.hypot(local[..., 0], local[..., 1]) / reach
    return 1 - smooth_step(share, _PLATEAU, 1.0)


def _local_outline(pelott: Pelott, points: int) -> FloatArray:
    """Outline about the apex, not turned.

    (26) in polar form about the pointed end, angle p from the egg's axis, with a = 1 and b = r:
    rho = cos p (1 - r sin^2 p). The apex stands where the egg is widest.
    """
    p = (np.arange(points) + 0.5) / points * np.pi - np.pi / 2
    rho = np.cos(p) * (1 - pelott.egg_ratio * np.sin(p) ** 2)
    unit = np.stack([rho * np.sin(p), rho * np.cos(p)], axis=1)[::-1]
    widest = _widest_angle(pelott.egg_ratio)
    half, along = _polar(pelott.egg_ratio, widest)
    size = np.array([pelott.width_mm / (2 * half), pelott.length_mm])
    return np.asarray((unit - np.array([0.0, along])) * size)


def _polar(ratio: float, p: float) -> tuple[float, float]:
    rho = np.cos(p) * (1 - ratio * np.sin(p) ** 2)
    return float(rho * np.sin(p)), float(rho * np.cos(p))


def _widest_angle(ratio: float) -> float:
    """Angle at which x = sin p cos p (1 - r sin^2 p) is greatest.

    With s = sin^2 p its derivative vanishes where 1 - (2 + 3 r) s + 4 r s^2 = 0.
    """
    linear = 2 + 3 * ratio
    # The form without cancellation holds for r = 0 (the circle) as well.
    s = 2 / (linear + np.sqrt(linear**2 - 16 * ratio))
    return float(np.arcsin(np.sqrt(s)))


def _turn(pelott: Pelott) -> FloatArray:
    """(2, 2) rotation, pelott to insole frame."""
    angle = np.radians(pelott.turn_deg)
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def _to_insole(local: FloatArray, pelott: Pelott) -> FloatArray:
    return np.asarray(local @ _turn(pelott).T + np.array(pelott.centre_mm))
