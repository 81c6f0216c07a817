"""What passes between the window and the capture service: messages, and the state of sensors."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path

from insole_core.messages import Message
from insole_core.recording.session import Manifest
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.capture_plan import CapturePlan

WARM_UP_S = 15 * 60.0
"""Depth drifts for this long after a sensor was switched on (docs/calibration.md); captures
may begin earlier.
"""


class Capability(Enum):
    """What not every family of sensors can do."""

    TILT = "tilt"
    """It has a motor, and knows where down is."""
    BLINK = "blink"
    """It has a light that can blink."""
    INFRARED = "infrared"
    """It sends infrared pictures in the place of colour."""
    PAIR = "pair"
    """It sends the pair of infrared pictures that its depth comes from, beside colour."""
    TIMED = "timed"
    """It tells when each picture was taken, rather than when it arrived."""
    TOGETHER = "together"
    """Its light helps others of its family rather than disturb them, so all are taken at once."""
    PRESET = "preset"
    """It can judge its own depth more or less strictly."""
    LASER = "laser"
    """The power of its projector can be set."""
    HAS_PAIR = "has pair"
    """It can be set to send the pair of infrared pictures."""


class Preset(Enum):
    """How strictly a sensor judges its own depth."""

    HIGH_ACCURACY = "high-accuracy"
    """Few wrong readings, and more gaps."""
    HIGH_DENSITY = "high-density"
    """Few gaps, and more wrong readings."""


@dataclass(frozen=True)
class Tuning:
    """What is set of a sensor.

    Parameters
    ----------
    preset
        None where it has none, or one that the program does not know.
    laser_mw
        Power of its projector; None where it cannot be set.
    pair
        Whether it sends the pair of infrared pictures; None where it cannot.
    """

    preset: Preset | None = None
    laser_mw: float | None = None
    pair: bool | None = None

    def of_what_sets(self, change: Tuning) -> Tuning:
        """Return what is set here of that which a change sets."""
        return Tuning(
            None if change.preset is None else self.preset,
            None if change.laser_mw is None else self.laser_mw,
            None if change.pair is None else self.pair,
        )


UNTUNED = Tuning()
"""Of a sensor of which nothing can be set."""


@dataclass(frozen=True)
class LaserRange:
    """The power that a projector can be set to, mW."""

    least_mw: float
    greatest_mw: float
    step_mw: float


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
class Tune:
    """Set what can be set of a sensor; what is None in it stays."""

    serial: str
    tuning: Tuning


@dataclass(frozen=True)
class Quit:
    """Switch everything off and end."""


Command = Start | Cancel | Placed | Find | Tilt | Identify | Infrared | Tune | Quit


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
    capabilities
        What it can do beyond depth and colour; as long as it could not be opened, nothing.
    tuning, laser_range
        What is set of it, and the power that its projector can be set to.
    factory
        The calibration of its factory; None as long as it could not be opened.
    """

    serial: str
    model: str
    bus: int
    slot: int
    fps: float = 0.0
    discarded: int = 0
    warm_s: float = 0.0
    problem: str | None = None
    capabilities: frozenset[Capability] = frozenset()
    tuning: Tuning = UNTUNED
    laser_range: LaserRange | None = None
    factory: Sensor | None = field(default=None, compare=False)

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
        Why there are no sensors, or why some are missing.
    """

    states: tuple[SensorState, ...]
    problem: str | None = None


@dataclass(frozen=True)
class Alive:
    """The service still runs; sent where it has had nothing to say for `ALIVE_PERIOD_S`."""


ALIVE_PERIOD_S = 1.0


Event = Sensors | CaptureStatus | Message
"""A `Message` says why a command could not be carried out."""
