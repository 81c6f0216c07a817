"""What of an element can be grabbed in a view, without any window."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.insole.fields import Place

PLACE_STEP_MM, FINE_PLACE_STEP_MM = 0.1, 0.01


@dataclass(frozen=True)
class Grip:
    """A place at which an element can be grabbed.

    Parameters
    ----------
    name
        Unique within the element.
    place_mm
        Insole frame.
    hint, sentence
        What dragging it does; what was done, for the undo menu. English, as all texts here.
    kind
        "move", "size" or "corner", by which it is drawn.
    has_keys
        Whether the arrow keys pull it.
    notch_mm
        How far up the screen it is pulled by a notch of the wheel; 0 if not at all.
    """

    name: str
    place_mm: Place
    hint: str
    sentence: str
    kind: str = "size"
    has_keys: bool = False
    notch_mm: float = 0.0


@dataclass(frozen=True, eq=False)
class Pull:
    """How a grip is pulled.

    Parameters
    ----------
    start, now : (2,) float64, mm
        Places of the insole frame below the pointer when it was grabbed, and now; None where there
        is none.
    up_mm
        How far it has come up the screen, in mm of the image.
    by_key, is_fine
        Whether by an arrow key, and in small steps.
    """

    start: FloatArray | None = None
    now: FloatArray | None = None
    up_mm: float = 0.0
    by_key: bool = False
    is_fine: bool = False

    @property
    def moved_mm(self) -> FloatArray:
        """The way (2,) of the pointer over the insole; none while it is beside it."""
        if self.start is None or self.now is None:
            return np.zeros(2)
        return self.now - self.start

    @property
    def step_mm(self) -> float:
        """The step to which places are rounded."""
        return FINE_PLACE_STEP_MM if self.by_key else PLACE_STEP_MM


def place_at(place: FloatArray, step_mm: float = PLACE_STEP_MM) -> Place:
    """Return a position (x, y) rounded to whole steps."""
    return rounded(float(place[0]), step_mm), rounded(float(place[1]), step_mm)
