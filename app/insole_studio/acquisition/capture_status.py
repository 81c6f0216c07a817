"""What is known of sensors and of a running capture: values that go from process to process."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


@dataclass(frozen=True)
class DetectedSensor:
    """A sensor that is plugged in.

    Parameters
    ----------
    serial
        None where it could not be read.
    model
        ``1414``, ``1473`` or ``K4W``; None where only the motor answers.
    bus, place
        Number of its USB controller; its place there as the system writes it.
    problem
        Why it cannot be used, in one sentence; None where it can.
    """

    serial: str | None
    model: str | None
    bus: int
    place: str
    problem: str | None = None


class CapturePhase(Enum):
    """Where a sensor stands, then where a capture does."""

    FOUND = "found"
    WARMING_UP = "warming up"
    LIVE = "live"
    MOVING = "moving"
    TILTING = "tilting"
    SETTLING = "settling"
    CAPTURING = "capturing"
    VERIFYING = "verifying"
    DONE = "done"
    FAILED = "failed"
    CANCELLED = "cancelled"

    @property
    def is_end(self) -> bool:
        """Whether nothing follows without a new order."""
        return self in (CapturePhase.DONE, CapturePhase.FAILED, CapturePhase.CANCELLED)


@dataclass(frozen=True)
class ViewStatus:
    """How far one view is.

    Parameters
    ----------
    view, serial
    frames, wanted
        Depth frames that are taken, and asked for.
    finished
        Whether the view is on the disk, whole.
    warnings
        Sentences about what was captured.
    place
        Where the sensor stands for it: the view without the number of the burst.
    """

    view: str
    serial: str
    frames: int
    wanted: int
    finished: bool = False
    warnings: tuple[str, ...] = ()
    place: str = ""


@dataclass(frozen=True)
class CaptureStatus:
    """How far a capture is.

    Parameters
    ----------
    phase
    views
    sentence
        What goes on, what is to be done, or why it ended.
    names
        The views that it is about.
    """

    phase: CapturePhase
    views: tuple[ViewStatus, ...] = ()
    sentence: str = ""
    names: tuple[str, ...] = ()

    @property
    def fraction(self) -> float:
        """The share that is done."""
        wanted = sum(view.wanted for view in self.views)
        return sum(view.frames for view in self.views) / wanted if wanted else 0.0
