"""The messages between the window and the capture service."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from insole_core.messages import Message
from insole_core.recording.session import Manifest
from insole_studio.acquisition.capture_plan import CapturePlan
from insole_studio.acquisition.capture_status import CapturePhase, CaptureStatus

WARM_UP_S = 15 * 60.0
"""Depth drifts for this long after a sensor was switched on (docs/calibration.md); captures
may begin earlier.
"""


@dataclass(frozen=True)
class Start:
    """Carry out a plan.

    Parameters
    ----------
    folder
        Folder of the draft; an existing one is continued, and views in it are replaced.
    manifest
        The session's manifest without views.
    order
        Order of all views.
    """

    plan: CapturePlan
    folder: Path
    manifest: Manifest
    order: tuple[str, ...]


@dataclass(frozen=True)
class Cancel:
    """Cancel the running capture; finished views stay."""


@dataclass(frozen=True)
class Placed:
    """Confirm that the sensor that was to be moved by hand is in position."""


@dataclass(frozen=True)
class Find:
    """Search for sensors again."""


@dataclass(frozen=True)
class Tilt:
    """Tilt a sensor by a number of degrees; without one, level it by its accelerometer."""

    serial: str
    by_deg: float | None


@dataclass(frozen=True)
class Identify:
    """Make a sensor's LED blink, or light steadily again."""

    serial: str
    on: bool


@dataclass(frozen=True)
class Infrared:
    """Make a sensor send infrared pictures instead of colour, or colour again."""

    serial: str
    on: bool


@dataclass(frozen=True)
class Quit:
    """Switch everything off and end."""


Command = Start | Cancel | Placed | Find | Tilt | Identify | Infrared | Quit


@dataclass(frozen=True)
class SensorState:
    """The state of a sensor in the service.

    Parameters
    ----------
    bus
        Number of its USB controller.
    slot
        Its index in the shared frame buffer.
    fps
        Depth frames per second, recently.
    discarded
        Depth frames that arrived damaged since the start.
    warm_s
        How long it has been on.
    problem
        Why it sends nothing, in one sentence; None if it does.
    """

    serial: str
    model: str
    bus: int
    slot: int
    fps: float = 0.0
    discarded: int = 0
    warm_s: float = 0.0
    problem: str | None = None

    @property
    def phase(self) -> CapturePhase:
        """Whether it was found, is warming up, or is live."""
        if self.fps == 0:
            return CapturePhase.FOUND
        return CapturePhase.WARMING_UP if self.warm_s < WARM_UP_S else CapturePhase.LIVE


@dataclass(frozen=True)
class Sensors:
    """The state of all sensors, including those that cannot be used.

    Parameters
    ----------
    problem
        Why there are no sensors.
    """

    states: tuple[SensorState, ...]
    problem: str | None = None


@dataclass(frozen=True)
class Alive:
    """The service still runs; sent where it has had nothing to say for `ALIVE_PERIOD_S`."""


ALIVE_PERIOD_S = 1.0


Event = Sensors | CaptureStatus | Message
"""A `Message` says why a command could not be carried out."""
