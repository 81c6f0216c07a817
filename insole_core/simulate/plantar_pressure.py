"""What a pressure plate measures of a foot that stands on it, at a known place."""

from __future__ import annotations

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import HEADS, find_landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.pressure.alignment import SolePrint
from insole_core.pressure.laid_map import Placement, PressureMap, centres_mm

PLATE = (80, 80)
_SPOTS = ("heel_centre", *HEADS, "toe_tip_1")


def pressed(
    foot: Foot, place: Placement, rng: np.random.Generator, missing: str = "", pitch_mm: float = 5.0
) -> PressureMap:
    """Return what a plate measures of a foot that stands on it, with noise.

    Parameters
    ----------
    foot
    place
        Where the middle of the plate lies under the foot, and how it is turned.
    missing
        Nothing, "toes", "midfoot" or "rear".

    Returns
    -------
    PressureMap
        At its true place. The foot leans by a degree or so, presses more under some spots, and the
        sensors average over their area; pressures below 10 kPa are not measured.
    """
    print_ = SolePrint.of(foot)
    rows, columns = print_.heights_mm.shape
    x, y = np.meshgrid(np.arange(columns) * 2.0, np.arange(rows) * 2.0)
    x, y = x + print_.first_mm[0], y + print_.first_mm[1]
    lean = rng.normal(0, 0.012) * x + rng.normal(0, 0.008) * (y - 120)
    kpa = np.clip(rng.uniform(4, 8) + lean - print_.heights_mm, 0, None) * rng.uniform(30, 60)
    marks = find_landmarks(foot)
    for name in _SPOTS:
        at = marks[name].point
        spot = np.exp(-((x - at[0]) ** 2 + (y - at[1]) ** 2) / (2 * 14.0**2))
        kpa *= 1 + rng.uniform(-0.5, 1.2) * spot
    kpa[_is_missing(foot, y, missing)] = 0
    measured = _averaged(kpa, print_, place, pitch_mm)
    measured = (measured + rng.normal(0, 5, PLATE)) * rng.uniform(0.9, 1.1, PLATE)
    measured[measured < 10] = 0
    return PressureMap(np.round(measured / 2.5) * 2.5, (pitch_mm, pitch_mm), place)


def _is_missing(foot: Foot, y: FloatArray, missing: str) -> FloatArray:
    share = y / foot.length_mm
    return {
        "": np.zeros(y.shape, bool),
        "toes": share > 0.8,
        "midfoot": (share > 0.33) & (share < 0.6),
        "rear": share < 0.45,
    }[missing]


def _averaged(kpa: FloatArray, print_: SolePrint, place: Placement, pitch_mm: float) -> FloatArray:
    from scipy import ndimage

    centres = centres_mm(PLATE, (pitch_mm, pitch_mm)).reshape(-1, 2)
    offsets = (np.arange(3) - 1) / 3 * pitch_mm
    total = np.zeros(len(centres))
    for dx in offsets:
        for dy in offsets:
            cells = print_.cells(place.to_insole(centres + np.array([dx, dy])))
            total += ndimage.map_coordinates(kpa, cells, order=1, mode="constant")
    return total.reshape(PLATE) / 9
