"""Whether the front of a surface shows toes, by the grooves between them on the back of the foot.

A shoe last and many prosthetic feet are like a foot in all else, and have none. Nor has a foot in a
sock, or one whose toes melted together in the scan; such a foot has an ankle, which a last has not.
"""

from __future__ import annotations

import numpy as np

from insole_core.foot.levelling import OUTLINE_HEIGHT_MM
from insole_core.foot.toes import prominences
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.sampling import EvenSurface

LEAST_RELIEF_MM = 1.0
"""Of toes; of feet whose toes show it is 3 to 14, of lasts and feet in socks up to 0.3."""
_BANDS = np.arange(0.80, 0.95, 0.01)  # of the length, each so long:
_BAND, _STRIP_MM = 0.03, 2.0
_SIDES = (12, 88)  # percentiles across, beyond which the back of the foot falls away
_LEAST_POINTS, _LEAST_STRIPS = 30, 8
_UPWARD, _MOST_HEIGHT = 0.5, 0.27  # the latter of the length; what is higher is a leg
_DEEPEST = 2  # bands that may have a deeper groove by chance
_ANKLE_HEIGHT, _REAR = (0.30, 0.34), 0.55  # shares of the length
_BALL, _LEAST_ANKLE = (0.65, 0.75), 0.55  # share of the length; of the width of the ball


def toe_relief_mm(foot: EvenSurface, length_mm: float) -> float | None:
    """Measure how deep the grooves between the toes are.

    Parameters
    ----------
    foot : mm, insole frame
    length_mm

    Returns
    -------
    float or None
        None where the backs of the toes were not scanned.
    """
    low = foot.points[:, 2] < _MOST_HEIGHT * length_mm
    back = low & (foot.normals[:, 2] > _UPWARD)
    points = foot.points[back]
    share = points[:, 1] / length_mm
    bands = (points[(share > start) & (share < start + _BAND)] for start in _BANDS)
    depths = [depth for band in bands if (depth := _groove_mm(band)) is not None]
    return sorted(depths, reverse=True)[_DEEPEST] if len(depths) > _DEEPEST else None


def has_ankle(foot: EvenSurface, length_mm: float) -> bool:
    """Return whether a surface is as wide as an ankle where a foot has it; a last is narrow there.

    Parameters
    ----------
    foot : mm, insole frame
    length_mm
    """
    x, y, z = (foot.points / length_mm).T
    ankle = (z > _ANKLE_HEIGHT[0]) & (z < _ANKLE_HEIGHT[1]) & (y < _REAR)
    ball = (y > _BALL[0]) & (y < _BALL[1]) & (z < OUTLINE_HEIGHT_MM / length_mm)
    return _width(x, ankle) >= _LEAST_ANKLE * _width(x, ball) > 0


def _width(x: FloatArray, chosen: BoolArray) -> float:
    return float(np.ptp(x[chosen])) if chosen.any() else 0.0


def _groove_mm(band: FloatArray) -> float | None:
    """Return the depth of the deepest groove along a band (n, 3) across the foot."""
    if len(band) < _LEAST_POINTS:
        return None
    x, y, z = (band - band.mean(axis=0)).T
    bent = np.column_stack([y, np.ones(len(y)), x, x**2])
    level = z - np.linalg.lstsq(bent, z, rcond=None)[0][0] * y  # its fall towards the tips
    low, high = np.percentile(x, _SIDES)
    strip = np.floor((x - low) / _STRIP_MM).astype(int)[(x > low) & (x < high)]
    count = np.bincount(strip)
    heights = np.bincount(strip, level[(x > low) & (x < high)])[count > 0] / count[count > 0]
    if len(heights) < _LEAST_STRIPS:
        return None
    ring = np.pad(heights, 1, mode="edge")
    smooth = (ring[:-2] + 2 * ring[1:-1] + ring[2:]) / 4
    return max(prominences(-smooth).values(), default=0.0)
