"""Pads and the line of the metatarsal heads: how far behind it they end, and where they snap."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from insole_core.cases.record import CaseRecord
from insole_core.geometry.arrays import FloatArray
from insole_core.insole.design import Pelott
from insole_core.insole.pads import pad_outline
from insole_studio.tools.tool import place_at
from insole_studio.workbench.landmarks import metatarsal_line

USUAL_MM = 8.0
"""Front edge behind the heads 2 – 4, where FIELD.md puts a pelott by default."""
SNAP_MM = 1.5
NEAR_MM = 30.0
SNAPPING = ("egg", "drop", "bar")


@dataclass(frozen=True, eq=False)
class Clearance:
    """How a pad's front edge lies to the line of the heads.

    Parameters
    ----------
    line : (3, 2) mm
        The heads 2, 3 and 4.
    front, nearest : (2,) mm
        The foremost place of the pad and the place of the line before it.
    distance_mm
        From the one to the other; > 0 while the pad ends behind the heads.
    """

    line: FloatArray
    front: FloatArray
    nearest: FloatArray
    distance_mm: float


def clearance(record: CaseRecord, pad: Pelott) -> Clearance | None:
    """Measure a pad against the line of the heads; None where it has nothing to do with it."""
    line = metatarsal_line(record) if pad.shape in SNAPPING else None
    if line is None:
        return None
    across = line[2, :2] - line[0, :2]
    across = across / np.hypot(*across)
    ahead = np.array([-across[1], across[0]])
    ahead = ahead * np.sign(ahead[1])
    outline = pad_outline(pad, 180)
    front = outline[(outline @ ahead).argmax()]
    # The heads stand in a bow: the line is taken at the place before the pad's front.
    along = (line[:, :2] - line[0, :2]) @ across
    height = (line[:, :2] - front) @ ahead
    order = along.argsort()
    distance = float(np.interp((front - line[0, :2]) @ across, along[order], height[order]))
    return Clearance(line[:, :2], front, front + distance * ahead, distance)


def snapped(record: CaseRecord, pad: Pelott) -> Pelott:
    """Put a pad that is nearly at the usual distance behind the heads exactly there."""
    found = clearance(record, pad)
    if found is None or abs(found.distance_mm - USUAL_MM) > SNAP_MM:
        return pad
    ahead = (found.nearest - found.front) / (found.distance_mm or 1.0)
    moved = np.array(pad.centre_mm) + (found.distance_mm - USUAL_MM) * ahead
    return replace(pad, centre_mm=place_at(moved, 0.01))
