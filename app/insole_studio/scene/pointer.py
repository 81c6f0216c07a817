"""What the mouse did, in the terms of the foot: tools know neither Qt nor the renderer."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_studio.scene.view_camera import Subject, ViewTransform


class Phase(Enum):
    """The moments of a gesture."""

    PRESS = auto()
    MOVE = auto()
    RELEASE = auto()


@dataclass(frozen=True)
class Handle:
    """A spot that can be grabbed, mm, insole frame."""

    name: str
    position_mm: tuple[float, float, float]
    hint: str = ""
    kind: str = "size"


@dataclass(frozen=True)
class MarkedPoint:
    """A named place to be shown, mm, insole frame, and how sure it is (0 to 1)."""

    text: str
    position_mm: tuple[float, float, float]
    confidence: float = 1.0


@dataclass(frozen=True, eq=False)
class PointerEvent:
    """One moment of the pointer over a view.

    Parameters
    ----------
    phase
    subject
        Which view: the foot or the insole.
    look
        The view's camera at this moment.
    pixel
        Place in the view (x, y).
    surface_mm
        Where the pointer touches what is shown, (3,) mm in the insole frame; None beside it.
    handle
        Name of the handle under the pointer.
    fine, coarse
        Whether Ctrl or Shift is held.
    by_key
        Whether keys lead the pointer, which then means what is selected rather than what it is on.
    """

    phase: Phase
    subject: Subject
    look: ViewTransform
    pixel: tuple[float, float]
    surface_mm: FloatArray | None = None
    handle: str | None = None
    fine: bool = False
    coarse: bool = False
    by_key: bool = False

    def on_level(self, z_mm: float) -> FloatArray | None:
        """Give the place (3,) under the pointer at a height; None where one looks along it."""
        origin, direction = self.look.ray_at(*self.pixel)
        if abs(direction[2]) < 0.05:
            return None
        return np.asarray(origin + direction * ((z_mm - origin[2]) / direction[2]))

    def place_mm(self, z_mm: float) -> FloatArray | None:
        """Give the touched place, or where the pointer is at the height `z_mm` beside the foot."""
        return self.surface_mm if self.surface_mm is not None else self.on_level(z_mm)
