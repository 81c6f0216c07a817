"""Pointer events in the foot's coordinates, so that tools depend neither on Qt nor the renderer."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_studio.scene.view_camera import Subject, ViewTransform


class Phase(Enum):
    """The phases of a gesture."""

    PRESS = auto()
    MOVE = auto()
    RELEASE = auto()


@dataclass(frozen=True)
class Handle:
    """A spot that can be dragged, mm, insole frame."""

    name: str
    position_mm: tuple[float, float, float]
    hint: str = ""
    kind: str = "size"


@dataclass(frozen=True)
class MarkedPoint:
    """A named point to be shown, mm, insole frame, with its confidence (0 to 1)."""

    text: str
    position_mm: tuple[float, float, float]
    confidence: float = 1.0


@dataclass(frozen=True, eq=False)
class PointerEvent:
    """The state of the pointer over a view at one moment.

    Parameters
    ----------
    phase
        Press, move or release.
    subject
        The view: foot or insole.
    look
        The view transform at this moment.
    pixel
        Position in the view (x, y).
    surface_mm
        Point of the surface under the pointer, (3,) mm, insole frame; None off the surface.
    handle
        Name of the handle under the pointer.
    fine, coarse
        Whether Ctrl or Shift is held.
    by_key
        Whether the pointer is driven by keys; it then refers to the selected object.
    before_mm
        Points (3,) of the surface over which it came here since the event before, oldest first: the
        hand is faster than the picture.
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
    before_mm: tuple[FloatArray, ...] = ()

    @property
    def touched_mm(self) -> tuple[FloatArray, ...]:
        """Points (3,) of the surface touched since the event before, the present one last."""
        return self.before_mm if self.surface_mm is None else (*self.before_mm, self.surface_mm)

    def on_level(self, z_mm: float) -> FloatArray | None:
        """Return the point (3,) under the pointer at a height; None if seen edge-on."""
        origin, direction = self.look.ray_at(*self.pixel)
        if abs(direction[2]) < 0.05:
            return None
        return np.asarray(origin + direction * ((z_mm - origin[2]) / direction[2]))

    def place_mm(self, z_mm: float) -> FloatArray | None:
        """Return the touched point, or beside the foot the one at the height `z_mm`."""
        return self.surface_mm if self.surface_mm is not None else self.on_level(z_mm)
