"""Distance from a pad to the metatarsal heads: one measure for warnings, snapping and display."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.foot.landmarks import Landmarks
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.pads.pad_form import PadForm
from insole_core.insole.pads.pad_heights import pad_outline

_SNAP_MM = 1.5


@dataclass(frozen=True, eq=False)
class Clearance:
    """Position of a pad's front edge relative to the line of the heads.

    Parameters
    ----------
    line : (3, 2) float64, mm, insole frame
        Heads 2, 3 and 4.
    front, nearest : (2,) float64, mm
        Foremost point of the pad and the point of the line in front of it.
    distance_mm
        Between the two; > 0 while the pad ends behind the heads.
    """

    line: FloatArray
    front: FloatArray
    nearest: FloatArray
    distance_mm: float


def clearance(pad: PadForm, line: FloatArray) -> Clearance:
    """Measure a pad against the line of metatarsal heads 2 to 4.

    Parameters
    ----------
    line : (3, 2) float64, mm, insole frame
    """
    across = line[2] - line[0]
    across = across / np.hypot(*across)
    ahead = np.array([-across[1], across[0]])
    ahead = ahead * np.sign(ahead[1])
    outline = pad_outline(pad)  # all points: fewer would not be mirrored with the pad
    front = outline[(outline @ ahead).argmax()]
    # The heads lie on an arc: the line is evaluated in front of the pad's foremost point.
    along = (line - line[0]) @ across
    height = (line - front) @ ahead
    order = along.argsort()
    distance = float(np.interp((front - line[0]) @ across, along[order], height[order]))
    return Clearance(line, front, front + distance * ahead, distance)


def snapped_mm(pad: PadForm, line: FloatArray, behind_heads_mm: float) -> FloatArray | None:
    """Return the way (2,) to a distance behind the heads; None if the pad is not almost there.

    Parameters
    ----------
    line : (3, 2) float64, mm, insole frame
        Heads 2 to 4.
    """
    found = clearance(pad, line)
    excess_mm = found.distance_mm - behind_heads_mm
    if abs(excess_mm) > _SNAP_MM:
        return None
    return excess_mm * (found.nearest - found.front) / (found.distance_mm or 1.0)


def behind_heads_mm(pad: PadForm, landmarks: Landmarks) -> float:
    """Return how far a pad's front edge lies behind the line of heads 2 to 4; < 0 in front of it.

    To snap a pad, move it ahead by the excess of this over the wanted distance.

    Parameters
    ----------
    landmarks
        Of the pad's foot, insole frame.
    """
    line = np.array([landmarks[f"metatarsal_head_{n}"].point[:2] for n in (2, 3, 4)])
    return clearance(pad, line).distance_mm
