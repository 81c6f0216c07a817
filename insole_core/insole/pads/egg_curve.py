"""The egg curve of the thesis's equation (26), scaled to length and width."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray

_OUTLINE_POINTS = 1440


def egg_curve(
    length_mm: float, width_mm: float, ratio: float, points: int = _OUTLINE_POINTS
) -> FloatArray:
    """Compute the outline of an egg about its apex, the blunt end towards +y.

    (26) in polar form about the pointed end, angle p from the egg's axis, with a = 1 and b = r:
    rho = cos p (1 - r sin^2 p). The apex stands where the egg is widest.

    Parameters
    ----------
    length_mm, width_mm
        Size along y and x.
    ratio
        r of (26), 0 to 1.

    Returns
    -------
    (points, 2) float64, mm, pad frame
        Counter-clockwise; the first point is not repeated.
    """
    p = (np.arange(points) + 0.5) / points * np.pi - np.pi / 2
    rho = np.cos(p) * (1 - ratio * np.sin(p) ** 2)
    unit = np.stack([rho * np.sin(p), rho * np.cos(p)], axis=1)[::-1]
    half, along = _polar(ratio, _widest_angle(ratio))
    size = np.array([width_mm / (2 * half), length_mm])
    return np.asarray((unit - np.array([0.0, along])) * size)


def _polar(ratio: float, p: float) -> tuple[float, float]:
    rho = np.cos(p) * (1 - ratio * np.sin(p) ** 2)
    return float(rho * np.sin(p)), float(rho * np.cos(p))


def _widest_angle(ratio: float) -> float:
    """Return the angle at which x = sin p cos p (1 - r sin^2 p) is greatest.

    With s = sin^2 p its derivative vanishes where 1 - (2 + 3 r) s + 4 r s^2 = 0.
    """
    linear = 2 + 3 * ratio
    # The form without cancellation holds for r = 0 (the circle) as well.
    s = 2 / (linear + np.sqrt(linear**2 - 16 * ratio))
    return float(np.arcsin(np.sqrt(s)))
