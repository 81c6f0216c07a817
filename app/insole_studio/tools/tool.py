"""What a tool is: a few functions of the case and the pointer.

A drag is one generator. It is started with the press, receives every move, and ends at the release
with one `case.apply`. Closing it early leaves the case as it was.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import replace
from typing import Any, Protocol, TypeVar

from insole_core.cases.record import ReferencePlane
from insole_core.geometry.side import Side
from insole_core.insole.design import InsoleDesign, Pelott, Posting
from insole_studio.scene.camera import Subject
from insole_studio.scene.pointer import Handle, PointerEvent
from insole_studio.workbench.case import Case

Record = TypeVar("Record", Pelott, Posting, InsoleDesign, ReferencePlane)
Gesture = Generator[None, PointerEvent, None]


class Ground(Protocol):
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


class Tool(Protocol):
    """What the pointer does while this tool is chosen."""

    key: str

    def hint(self, case: Case) -> str:
        """Say in one short sentence what one can do now."""
        ...

    def handles(self, case: Case, ground: Ground) -> tuple[Handle, ...]:
        """Give the spots that can be grabbed."""
        ...

    def press(self, case: Case, event: PointerEvent, ground: Ground) -> Gesture | None:
        """Begin a gesture; None leaves the press to the camera."""
        ...

    def wheel(self, case: Case, event: PointerEvent, steps: float) -> bool:
        """Act on the wheel; False leaves it to the camera."""
        ...

    def nudge(self, case: Case, event: PointerEvent, right: int, up: int) -> bool:
        """Act on an arrow key; False when there is nothing to nudge."""
        ...


def with_number(value: Record, name: str, number: float) -> Record:
    """Give a record with one of its numbers replaced."""
    changes: dict[str, Any] = {name: number}
    return replace(value, **changes)


def rounded(value: float, step: float) -> float:
    """Give the nearest whole multiple of `step`."""
    return round(round(value / step) * step, 6)


def rise_mm(start: PointerEvent, now: PointerEvent) -> float:
    """Give how far the pointer went up on the screen since `start`, in mm of the picture."""
    return (start.pixel[1] - now.pixel[1]) * now.look.mm_per_px
