"""What the window and the capture service say to each other."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from insole_core.messages import Message
from insole_core.recording.session import Manifest
from insole_studio.acquisition.capture_plan import CapturePlan
from insole_studio.acquisition.capture_status import CapturePhase, CaptureStatus

WARM_UP_S = 15 * 60.0
"""So long depth drifts after a sensor was switched on (docs/calibration.md); captures may begin."""


@dataclass(frozen=True)
class Start:
    """Carry a plan out.

    Parameters
    ----------
    plan
    folder
        Of the draft; one that exists goes on, and views in it are replaced.
    manifest
        Without views.
    order
        Of all views.
    """

    plan: CapturePlan
    folder: Path
    manifest: Manifest
    order: tuple[str, ...]


@dataclass(frozen=True)
class Cancel:
    """End the running capture; finished views stay."""


@dataclass(frozen=True)
class Placed:
    """The sensor that was to be moved by hand is in its place."""


@dataclass(frozen=True)
class Find:
    """Look for sensors again."""


@dataclass(frozen=True)
class Tilt:
    """Tilt a sensor: by so many degrees, or, without a number, level by its accelerometer."""

    serial: str
    by_deg: float | None


@dataclass(frozen=True)
class Identify:
    """Let a sensor's light blink, or shine again."""

    serial: str
    on: bool


@dataclass(frozen=True)
class Infrared:
    """Let a sensor send infrared pictures in place of colour, or colour again."""

    serial: str
    on: bool


@dataclass(frozen=True)
class Quit:
    """Switch everything off and end."""


Command = Start | Cancel | Placed | Find | Tilt | Identify | Infrared | Quit


@dataclass(frozen=True)
class SensorState:
    """A sensor as the service has it.

    Parameters
    ----------
    serial, model
    bus
        Number of its USB controller.
    slot
        Its number on the frame board.
    fps
        Depth frames a second, lately.
    discarded
        Depth frames that arrived damaged since it was started.
    warm_s
        How long it has been in use.
    problem
        Why it sends nothing, in one sentence; None where it sends.
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
        """Whether it was found, warms up, or is live."""
        if self.fps == 0:
            return CapturePhase.FOUND
        return CapturePhase.WARMING_UP if self.warm_s < WARM_UP_S else CapturePhase.LIVE


@dataclass(frozen=True)
class Sensors:
    """The sensors now, those that cannot be used among them.

    Parameters
    ----------
    states
    problem
        Why there are none.
    """

    states: tuple[SensorState, ...]
    problem: str | None = None


Event = Sensors | CaptureStatus | Message
"""A `Message` says why an order could not be carried out."""
