"""What a tool is: a few functions of the case and the pointer.

A drag is one generator. It is started with the press, receives every move, and ends at the release
with one `case.apply`. Closing it early leaves the case as it was.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Protocol, TypeVar

import numpy as np

from insole_core.cases.case_record import ReferencePlane
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.rounding import rounded
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import Correction, InsoleDesign, Place
from insole_studio.document.case import Case
from insole_studio.scene.gesture import Gesture
from insole_studio.scene.pointer import Handle, PointerEvent
from insole_studio.scene.view_camera import Subject

NUDGE_MM = 0.5
PLACE_STEP_MM = 0.1

Record = TypeVar("Record", bound=Correction | InsoleDesign | ReferencePlane)


@dataclass(frozen=True)
class ContextMenuItem:
    """One line of the menu under the pointer: its text and what it does.

    What `removes` is also meant by the Delete key.
    """

    text: str
    run: Callable[[], None]
    removes: bool = False


class SurfaceContext(Protocol):
    """What marks are drawn on in one view: the skin or the insole."""

    @property
    def subject(self) -> Subject:
        """Which view this is."""
        ...

    @property
    def side(self) -> Side:
        """Which foot."""
        ...

    def place(self, x_mm: float, y_mm: float) -> tuple[float, float, float]:
        """Put a place of the insole frame onto the surface."""
        ...

    def covers(self, x_mm: float, y_mm: float) -> bool:
        """Whether the surface is there at all."""
        ...


class Tool:
    """What the pointer does while this tool is chosen; the defaults leave it to the camera."""

    key: ClassVar[str]

    def hint(self, case: Case) -> str:
        """Say in one short sentence what one can do now."""
        raise NotImplementedError

    def handles(self, _case: Case, _surface: SurfaceContext) -> tuple[Handle, ...]:
        """Give the spots that can be grabbed."""
        return ()

    def start(self, _case: Case) -> Place | None:
        """Give where the pointer of the keys begins; None for amid the picture."""
        return None

    @property
    def sketch(self) -> tuple[Place, ...]:
        """What the hand is drawing just now, in the insole frame."""
        return ()

    @property
    def foot_step(self) -> FloatArray | None:
        """How the hand is moving the foot just now, (4, 4); None when it does not."""
        return None

    def press(self, _case: Case, _event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Begin a gesture; None leaves the press to the camera."""
        return None

    def double_click(self, _case: Case, _event: PointerEvent, _surface: SurfaceContext) -> bool:
        """Act on a double click; False leaves it to the camera."""
        return False

    def offers(
        self, _case: Case, _event: PointerEvent, _surface: SurfaceContext
    ) -> tuple[ContextMenuItem, ...]:
        """Give what can be done at a place, for the menu under the pointer."""
        return ()

    def wheel(self, _case: Case, _event: PointerEvent, _steps: float) -> bool:
        """Act on the wheel; False leaves it to the camera."""
        return False

    def nudge(self, _case: Case, _event: PointerEvent, _right: int, _up: int) -> bool:
        """Act on an arrow key; False when there is nothing to nudge."""
        return False


def nudge_mm(event: PointerEvent, right: int, up: int) -> FloatArray:
    """Give the step (2,) of an arrow key along the picture: 0.5 mm, Shift × 10, Ctrl × 0.1."""
    distance = NUDGE_MM * (10.0 if event.coarse else 1.0) * (0.1 if event.fine else 1.0)
    step = (right * event.look.right + up * event.look.up)[:2]
    return np.asarray(step / max(float(np.linalg.norm(step)), 1e-9) * distance)


def place_at(place: FloatArray, step_mm: float = PLACE_STEP_MM) -> Place:
    """Give a place (x, y) in whole steps."""
    return rounded(float(place[0]), step_mm), rounded(float(place[1]), step_mm)


def with_number(value: Record, name: str, number: float) -> Record:
    """Give a record with one of its numbers replaced."""
    changes: dict[str, Any] = {name: number}
    return replace(value, **changes)


def rise_mm(start: PointerEvent, now: PointerEvent) -> float:
    """Give how far the pointer went up on the screen since `start`, in mm of the picture."""
    return (start.pixel[1] - now.pixel[1]) * now.look.mm_per_px
