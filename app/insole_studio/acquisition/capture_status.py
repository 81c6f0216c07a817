"""The state of sensors and of a running capture, as values that pass between processes."""

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
        Number of its USB controller, and its port path as the operating system writes it.
    problem
        Why it cannot be used, in one sentence; None where it can.
    """

    serial: str | None
    model: str | None
    bus: int
    place: str
    problem: str | None = None


class CapturePhase(Enum):
    """The phase of a sensor, then those of a capture."""

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
        """Whether nothing follows without a new command."""
        return self in (CapturePhase.DONE, CapturePhase.FAILED, CapturePhase.CANCELLED)


@dataclass(frozen=True)
class ViewStatus:
    """The progress of one view.

    Parameters
    ----------
    frames, wanted
        Depth frames taken, and requested.
    finished
        Whether the view is complete on the disk.
    warnings
        Sentences about what was captured.
    place
        Position of the sensor: the view's name without the number of the burst.
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
    """The progress of a capture.

    Parameters
    ----------
    sentence
        What is going on, what the user has to do, or why the capture ended.
    names
        The views that `sentence` is about.
    """

    phase: CapturePhase
    views: tuple[ViewStatus, ...] = ()
    sentence: str = ""
    names: tuple[str, ...] = ()

    @property
    def fraction(self) -> float:
        """Return the fraction that is done, 0 to 1."""
        wanted = sum(view.wanted for view in self.views)
        return sum(view.frames for view in self.views) / wanted if wanted else 0.0
