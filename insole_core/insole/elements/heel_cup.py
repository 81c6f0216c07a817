"""The height of the heel's rim."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.insole.elements.correction import Correction, Sole
from insole_core.insole.elements.words import mm_message
from insole_core.insole.fields import Number, OfLength
from insole_core.insole.primitives.blending import smooth_hinge, smooth_step
from insole_core.insole.primitives.height_field import heel_floor_mm, row_count
from insole_core.messages import Message

_WALL_DEG = 80.0  # greatest mean inclination of a rim that is raised beside the scan
_WALL_MM = (2.5, 5.0)  # breadth over which such a rim rises, with little and with ample room
_LAND_MM = 1.0  # of the rim along the edge that has its full height
_ROUNDING_MM = 1.0  # height over which the limit and the surface blend


@dataclass(frozen=True, kw_only=True)
class HeelCup(Correction):
    """Height of the heel cup's rim above the heel's lowest point.

    A rim that is higher on the foot is lowered to it; a lower one is raised beside the foot.
    """

    type, name = "heel_cup", "Heel cup"
    tip = "Set the depth of the heel cup"
    stage, order = "sole", 30

    depth_mm: Annotated[
        float,
        Number("Depth", "Height of the rim over the lowest place of the heel", 0, 30, main=""),
    ] = 12.0
    fade_start: Annotated[
        float,
        OfLength(
            "Full up to",
            "Share of the foot's length up to which the cup has its full depth",
            before="fade_end",
        ),
    ] = 0.3
    fade_end: Annotated[
        float,
        OfLength("Ends at", "Share of the foot's length at which the cup ends", after="fade_start"),
    ] = 0.45

    @property
    def rim_depth_mm(self) -> float:
        """Its depth."""
        return self.depth_mm

    def shaped(self, sole: Sole) -> FloatArray:
        """Bring the rim of the heel to the depth, unless a designed rim does.

        A higher rim is lowered. Where the scan ends lower, a wall rises beside it without a step
        and reaches that height 1 mm before the edge of the insole and 5 mm beside the scan at the
        latest, unless it would be steeper than 80 degrees on average. The measured sole is never
        raised.
        """
        field, length_mm = sole.surface, sole.length_mm
        if sole.has_finish:
            return field.heights_mm
        count = row_count(field, self.fade_end * length_mm)
        rows = slice(0, count)
        beside_mm, room_mm = sole.beside_mm(count)
        limit = heel_floor_mm(field, length_mm) + self.depth_mm
        fade = 1 - smooth_step(field.y_mm[rows] / length_mm, self.fade_start, self.fade_end)
        fade = fade[:, None]
        changed = field.heights_mm.copy()
        changed[rows] -= smooth_hinge(field.heights_mm[rows] - limit, _ROUNDING_MM) * fade
        missing = np.maximum(limit - changed[rows], 0.0)
        breadth = np.clip(room_mm - _LAND_MM, *_WALL_MM)
        breadth = np.maximum(breadth, missing / np.tan(np.radians(_WALL_DEG)))
        changed[rows] += missing * smooth_step(beside_mm / breadth, 0.0, 1.0) * fade
        return changed

    def brief(self) -> Message:
        """Return its depth."""
        return mm_message(self.depth_mm)
