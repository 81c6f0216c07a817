"""Pointer events in the foot's coordinates, and gestures: a drag as one generator."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass
from enum import Enum, auto
from inspect import GEN_RUNNING, getgeneratorstate
from typing import Any, TypeAlias

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_studio.scene.view_camera import Subject, ViewTransform

AnyGesture: TypeAlias = Generator[None, Any, None]
"""A gesture in a view, or one of a panel, which receives the values of that panel."""


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


Gesture = Generator[None, PointerEvent, None]
"""Started by the press; receives every move, and ends at the release."""


class RunningGesture:
    """Starts, feeds and ends one gesture at a time."""

    def __init__(self) -> None:
        self._gesture: AnyGesture | None = None

    def __bool__(self) -> bool:
        """Whether a gesture is running."""
        return self._gesture is not None

    def begin(self, gesture: AnyGesture) -> None:
        """Run a gesture up to its first wait."""
        self._gesture = gesture
        next(gesture)

    def send(self, event: Any) -> bool:
        """Pass an event to the gesture; return True if that ended it."""
        if self._gesture is None:
            return False
        try:
            self._gesture.send(event)
        except StopIteration:
            self._gesture = None
            return True
        return False

    def close(self) -> bool:
        """Cancel the gesture without effect; return False if none can be cancelled."""
        if self._gesture is None or getgeneratorstate(self._gesture) == GEN_RUNNING:
            return False  # called from within the running gesture itself
        self._gesture.close()
        self._gesture = None
        return True
