"""The greatest pressure in each region of the sole."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from insole_core.foot.landmarks import HEADS, TOE_TIPS, Landmarks
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.pressure.laid_map import PressureMap

REGIONS = ("heel", "midfoot", "head_1", "head_2", "head_3", "head_4", "head_5", "hallux",
           "lesser_toes")  # fmt: skip
RELIEF_KPA = 200.0
"""Peak barefoot pressure from which on a foot at risk of ulcers is to be relieved.

There is no agreed threshold for barefoot pressure, so this is our default: the in-shoe value from
which Bus, Haspels and Busch-Westbroek (Diabetes Care 34, 2011, 1595-1600) chose regions to relieve.
The clinic may have another one.
"""
_HEEL = 0.31  # of the way from pternion to the tip of the 2nd toe
_HEADS_FROM = 0.08  # of the length, behind the heads' line
_TOES_FROM = 0.09
_MARGIN, _BORDER = 0.05, 0.1  # behind heel and ahead of toes; beside the outermost heads


def region_peaks(laid: PressureMap, landmarks: Landmarks) -> dict[str, float | None]:
    """Return the peak pressure of each of `REGIONS`, kPa; None where no sensor lies.

    Parameters
    ----------
    laid
        The map under its foot.
    landmarks
        Of the foot, insole frame.
    """
    region = regions_of(laid.placement.to_insole(laid.centres_mm.reshape(-1, 2)), landmarks)
    kpa = laid.kpa.ravel()
    peaks: dict[str, float | None] = {}
    for number, name in enumerate(REGIONS):
        inside = kpa[(region == number) & np.isfinite(kpa)]
        peaks[name] = float(inside.max()) if len(inside) else None
    return peaks


def overloaded_heads(
    peaks: Mapping[str, float | None], threshold_kpa: float = RELIEF_KPA
) -> tuple[int, ...]:
    """Return the metatarsal heads, 1 to 5, under which the peak reaches a threshold."""
    return tuple(
        number for number in range(1, 6) if (peaks.get(f"head_{number}") or 0.0) >= threshold_kpa
    )


def regions_of(
    points: FloatArray, landmarks: Landmarks, behind_heads: float = _HEADS_FROM
) -> IntArray:
    """Return the number in `REGIONS` of each point (n, 2), insole frame; -1 beside the foot.

    Parameters
    ----------
    behind_heads
        Share of the length by which the regions of the heads reach behind their line.
    """
    at = {name: mark.point[:2] for name, mark in landmarks.items()}
    heel_y = float(at["pternion"][1])
    length = float(at["toe_tip_2"][1]) - heel_y
    heads = np.array([at[name] for name in HEADS])
    order = np.argsort(heads[:, 0])
    line_y = np.interp(points[:, 0], heads[order, 0], heads[order, 1])
    along = points[:, 1] - line_y
    region = np.full(len(points), REGIONS.index("midfoot"))
    region[points[:, 1] < heel_y + _HEEL * length] = REGIONS.index("heel")
    nearest = np.abs(points[:, None, 0] - heads[None, :, 0]).argmin(axis=1)
    near = (along > -behind_heads * length) & (along <= _TOES_FROM * length)
    region[near] = REGIONS.index("head_1") + nearest[near]
    toes = along > _TOES_FROM * length
    tips = np.array([at[name][0] for name in TOE_TIPS])
    is_first = np.abs(points[:, None, 0] - tips[None]).argmin(axis=1) == 0
    region[toes & is_first] = REGIONS.index("hallux")
    region[toes & ~is_first] = REGIONS.index("lesser_toes")
    front = max(float(at[name][1]) for name in TOE_TIPS)
    least = (heads[:, 0].min() - _BORDER * length, heel_y - _MARGIN * length)
    greatest = (heads[:, 0].max() + _BORDER * length, front + _MARGIN * length)
    region[((points < least) | (points > greatest)).any(axis=1)] = -1
    return region
