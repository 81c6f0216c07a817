"""The base class of tools: functions of the case and the pointer.

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
from insole_core.geometry.side import Side
from insole_core.insole.elements import Correction
from insole_core.insole.fields import Place
from insole_core.insole.prescription.design import InsoleDesign
from insole_studio.document.case import Case
from insole_studio.scene.pointer import Gesture, Handle, PointerEvent
from insole_studio.scene.view_camera import Subject

NUDGE_MM = 0.5

Record = TypeVar("Record", bound=Correction | InsoleDesign | ReferencePlane)


@dataclass(frozen=True)
class ContextMenuItem:
    """An item of the context menu: its text and its action.

    An item that `removes` is also run by the Delete key.
    """

    text: str
    run: Callable[[], None]
    removes: bool = False


@dataclass(frozen=True, eq=False)
class Measure:
    """What a tool measures: lines (n, 3), mm, insole frame, and what is written at a place (3,)."""

    lines: tuple[FloatArray, ...]
    text: str
    place_mm: FloatArray


class SurfaceContext(Protocol):
    """The surface on which marks are drawn in one view: the skin or the insole."""

    @property
    def subject(self) -> Subject:
        """The view."""
        ...

    @property
    def side(self) -> Side:
        """The side of the foot."""
        ...

    def place(self, x_mm: float, y_mm: float) -> tuple[float, float, float]:
        """Return the point of the surface at a position.

        Parameters
        ----------
        x_mm, y_mm
            Position in the insole frame.

        Returns
        -------
        tuple of float
            The point (x, y, z), mm, insole frame.
        """
        ...

    def places(self, xy: FloatArray) -> FloatArray:
        """Return the points (n, 3) of the surface at positions (n, 2), mm, insole frame."""
        ...

    def covers(self, x_mm: float, y_mm: float) -> bool:
        """Return whether the surface covers a position of the insole frame."""
        ...

    def way(self, start: FloatArray, end: FloatArray) -> FloatArray | None:
        """Return the shortest way (n, 3) along the surface; None if its parts do not meet."""
        ...


class Tool:
    """What the pointer does while a tool is chosen; by default nothing but looking round.

    Methods take the open case and the pointer event; `surface` is that of the event's view.
    """

    key: ClassVar[str]
    turns_view: ClassVar[bool] = False
    """Whether a drag by the left button turns the view where there is nothing to drag: in other
    tools a drag that misses must not take away what the hand was aiming at."""
    draws: ClassVar[bool] = False
    """Whether a drag draws a line, of which no point may be left out."""

    def reset(self) -> None:
        """Forget what was set for the case before."""

    def hint(self, case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        raise NotImplementedError

    def handles(self, _case: Case, _surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the spots that can be dragged.

        Parameters
        ----------
        _case
            The open case.
        _surface
            Surface of the view for which the handles are.
        """
        return ()

    def start(self, _case: Case) -> Place | None:
        """Return where the keyboard cursor starts; None for the middle of the view."""
        return None

    @property
    def sketch(self) -> tuple[Place, ...]:
        """The line being drawn, in the insole frame."""
        return ()

    @property
    def selection(self) -> object:
        """What of the tool's own is selected; marks are drawn again when it changes."""
        return None

    @property
    def foot_step(self) -> FloatArray | None:
        """The transform (4, 4) by which the foot is being turned; None while it is not."""
        return None

    def press(self, _case: Case, _event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Start a gesture.

        Parameters
        ----------
        _case
            The open case.
        _event
            The press.
        _surface
            Surface of the event's view.

        Returns
        -------
        Gesture or None
            None where there is nothing to drag.
        """
        return None

    def own_step(self, _case: Case) -> str:
        """Return what Undo takes back before a step of the case; empty if there is nothing."""
        return ""

    def take_back(self) -> None:
        """Take that back."""

    def measure(self, _case: Case, _surface: SurfaceContext) -> Measure | None:
        """Return what is measured on the surface of a view; None if nothing is."""
        return None

    def double_click(self, _case: Case, _event: PointerEvent, _surface: SurfaceContext) -> bool:
        """Handle a double click; return False to leave it to the camera."""
        return False

    def offers(
        self, _case: Case, _event: PointerEvent, _surface: SurfaceContext
    ) -> tuple[ContextMenuItem, ...]:
        """Return the context menu items for a position.

        Parameters
        ----------
        _case
            The open case.
        _event
            Position of the pointer.
        _surface
            Surface of the event's view.
        """
        return ()

    def wheel(self, _case: Case, _event: PointerEvent, _steps: float) -> bool:
        """Handle the wheel; return False to leave it to the camera.

        Parameters
        ----------
        _case
            The open case.
        _event
            Position of the pointer.
        _steps
            Notches of the wheel, > 0 away from the user.
        """
        return False

    def nudge(self, _case: Case, _event: PointerEvent, _right: int, _up: int) -> bool:
        """Handle an arrow key; return False if nothing was moved.

        Parameters
        ----------
        _case
            The open case.
        _event
            The view transform, and the modifier keys.
        _right, _up
            Direction of the key: -1, 0 or 1.
        """
        return False


def nudge_mm(event: PointerEvent, right: int, up: int) -> FloatArray:
    """Return the step of an arrow key in the plane of the insole.

    Parameters
    ----------
    event
        The view transform, and the modifier keys.
    right, up
        Direction of the key in the image: -1, 0 or 1.

    Returns
    -------
    (2,) float64
        Length 0.5 mm; Shift × 10, Ctrl × 0.1.
    """
    distance = NUDGE_MM * (10.0 if event.coarse else 1.0) * (0.1 if event.fine else 1.0)
    step = (right * event.look.right + up * event.look.up)[:2]
    return np.asarray(step / max(float(np.linalg.norm(step)), 1e-9) * distance)


def with_number(value: Record, name: str, number: float) -> Record:
    """Return the record with one of its numbers replaced.

    Parameters
    ----------
    value
        The record.
    name
        Name of the attribute.
    number
        The new number.
    """
    changes: dict[str, Any] = {name: number}
    return replace(value, **changes)


def show_again(case: Case) -> None:
    """Let the views show what a tool draws, though the case stays as it is."""
    case.preview(case.record)
    case.end_preview()


def rise_mm(start: PointerEvent, now: PointerEvent) -> float:
    """Return the pointer's movement up the screen, in mm of the image.

    Parameters
    ----------
    start, now
        First and current event.
    """
    return (start.pixel[1] - now.pixel[1]) * now.look.mm_per_px
