"""The plan of a capture, which sensor records which view, and the request to resume it by."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from itertools import chain
from typing import Any

from insole_core.errors import UsageError
from insole_core.messages import Message, joined
from insole_core.recording.session import ReferenceSystem
from insole_studio.acquisition.stabilisation import StabilisationRule

MOST_SENSORS = 8
MOST_FRAMES = 999
MOST_BURSTS = 9
_BURST_STEP_DEG = 1.0
_VIEW = re.compile(r"[a-z0-9_]{1,32}")
_TOP_FACE = "achilles"
_TOP = "top"
"""In the name of a view from above the tendon, such as ``left_top``."""
_KEY = "capture_plan"
"""Key in the manifest."""


@dataclass(frozen=True)
class Shot:
    """One view recorded by one sensor.

    Parameters
    ----------
    serial
        Serial number of the sensor.
    tilt_deg
        Tilt by the motor for this shot, relative to the sensor's tilt before the capture.
    place
        Position of the sensor: the view's name without the number of the burst.
    """

    view: str
    serial: str
    tilt_deg: float = 0.0
    place: str = ""


@dataclass(frozen=True)
class CaptureStep:
    """Shots that are taken at the same time.

    Parameters
    ----------
    by_hand
        Whether somebody has to move the sensor into position first.
    """

    shots: tuple[Shot, ...]
    by_hand: bool = False

    @property
    def names(self) -> Message:
        """Return the names of its views as text for a message."""
        return joined((shot.view for shot in self.shots), " and ")


@dataclass(frozen=True)
class CapturePlan:
    """All steps in order; during each step the emitters of all other sensors are off.

    Parameters
    ----------
    frames, color_frames
        Number of depth and colour pictures of each view.
    settle
        Rule that decides when the depth of a sensor is steady enough to be used.
    infrared
        Whether infrared pictures are taken also of sensors whose pattern of dots is to be learnt.
    """

    steps: tuple[CaptureStep, ...]
    frames: int = 10
    color_frames: int = 1
    settle: StabilisationRule = field(default_factory=StabilisationRule)
    infrared: bool = False

    @property
    def shots(self) -> tuple[Shot, ...]:
        """Return all shots in order."""
        return tuple(chain.from_iterable(step.shots for step in self.steps))

    @property
    def views(self) -> tuple[str, ...]:
        """Return the names of all views in order."""
        return tuple(shot.view for shot in self.shots)

    @property
    def serials(self) -> tuple[str, ...]:
        """Return the serial numbers of the sensors needed, each once."""
        return tuple(dict.fromkeys(shot.serial for shot in self.shots))

    def gathered(self, serials: Collection[str]) -> CapturePlan:
        """Return the plan that takes the views of some sensors at once, in the first one's turn.

        Parameters
        ----------
        serials
            Of sensors that do not disturb each other.
        """
        steps: list[CaptureStep] = []
        gathering: int | None = None
        for step in self.steps:
            users = {shot.serial for shot in step.shots}
            if step.by_hand or not users <= set(serials):
                steps.append(step)
                continue
            taken = (
                {shot.serial for shot in steps[gathering].shots} if gathering is not None else users
            )
            if gathering is None or users & taken:
                gathering = len(steps)
                steps.append(step)
            else:
                steps[gathering] = CaptureStep((*steps[gathering].shots, *step.shots))
        return replace(self, steps=tuple(steps))

    def only(self, views: Sequence[str]) -> CapturePlan:
        """Return the plan that captures only some of the views again.

        A sensor that is moved by hand may stand anywhere by then, so it is repositioned first.
        """
        moved = {shot.serial for step in self.steps if step.by_hand for shot in step.shots}
        steps: list[CaptureStep] = []
        for step in self.steps:
            shots = tuple(shot for shot in step.shots if shot.view in views)
            before = steps[-1].shots[-1].place if steps else None
            by_hand = any(shot.serial in moved and shot.place != before for shot in shots)
            if shots:
                steps.append(CaptureStep(shots, by_hand))
        return replace(self, steps=tuple(steps))


def make_plan(
    assignment: Sequence[tuple[str, str]],
    *,
    frames: int = 10,
    color_frames: int = 1,
    simultaneous: bool = False,
    bursts: int = 1,
    without_motor: Collection[str] = (),
) -> CapturePlan:
    """Plan a capture.

    Parameters
    ----------
    assignment
        Pairs of view and serial number, in the order of the capture. A sensor that is named
        twice is moved by hand in between.
    frames, color_frames
        Number of depth and colour pictures of each view.
    simultaneous
        Capture all views at the same time; for sensors that do not see the same surface.
    bursts
        Number of series per view. The motor tilts the sensor by a degree between them, so that
        its depth steps fall elsewhere; each further series is a view of its own, ``left_2`` and
        so on.
    without_motor
        Serial numbers of sensors that cannot tilt, which therefore take one series.

    Returns
    -------
    CapturePlan
        With one step per shot, or one per burst if simultaneous.

    Raises
    ------
    UsageError
        When the plan contradicts itself, or wants bursts of sensors of which none has a motor.
    """
    _check(assignment, simultaneous)
    for name, number, most in (
        ("frames", frames, MOST_FRAMES),
        ("colour frames", color_frames, MOST_FRAMES),
        ("bursts", bursts, MOST_BURSTS),
    ):
        if not 1 <= number <= most:
            raise UsageError(
                "{count} {things} were asked for, but 1 to {most} are possible.",
                count=number,
                things=name,
                most=most,
            )
    tilting = [pair for pair in assignment if pair[1] not in without_motor]
    if bursts > 1:
        _check_motors(assignment, tilting)
    rounds = [_round(tilting if burst else assignment, burst) for burst in range(bursts)]
    steps = [CaptureStep(shots) for shots in rounds] if simultaneous else _turns(rounds)
    plan = CapturePlan(tuple(steps), frames, color_frames)
    _check_names(plan.views)
    return plan


def parse_assignment(texts: Sequence[str]) -> tuple[tuple[str, str], ...]:
    """Parse assignments such as ``left=SERIAL``.

    Returns
    -------
    tuple of (str, str)
        View and serial number, in the given order.

    Raises
    ------
    UsageError
    """
    pairs = []
    for text in texts:
        view, _, serial = text.partition("=")
        if not view or not serial:
            raise UsageError(
                '"{text}" names no view and sensor; write for example left=A00362A.', text=text
            )
        pairs.append((view, serial))
    return tuple(pairs)


def view_faces(view: str, system: ReferenceSystem) -> tuple[str, ...]:
    """Return the marker groups that a view sees: for a top view the tendon's, else the others.

    Every view sees all groups of a reference system that has no group at the Achilles tendon.

    Parameters
    ----------
    view
        Name of the view, or of one of its bursts.

    Returns
    -------
    tuple of str
        Names of marker groups.
    """
    groups = tuple(dict.fromkeys(marker.face for marker in system.markers))
    if _TOP_FACE not in groups or len(groups) == 1:
        return groups
    if _TOP in view.split("_"):
        return (_TOP_FACE,)
    return tuple(group for group in groups if group != _TOP_FACE)


def _round(assignment: Sequence[tuple[str, str]], burst: int) -> tuple[Shot, ...]:
    return tuple(
        Shot(burst_view(view, burst), serial, burst_tilt_deg(burst), view)
        for view, serial in assignment
    )


def burst_view(view: str, burst: int) -> str:
    """Return the name of a burst of a view: ``left``, ``left_2``, ``left_3`` …

    Parameters
    ----------
    burst
        Counted from 0.
    """
    return f"{view}_{burst + 1}" if burst else view


def burst_tilt_deg(burst: int) -> float:
    """Return the tilt of a burst, which is counted from 0: 0, 1, −1, 2, −2 … degrees."""
    return _BURST_STEP_DEG * ((burst + 1) // 2) * (1.0 if burst % 2 else -1.0) + 0.0


def _turns(rounds: Sequence[tuple[Shot, ...]]) -> list[CaptureStep]:
    """Return one step per shot; a sensor that took an earlier view is moved by hand."""
    steps: list[CaptureStep] = []
    seen: set[str] = set()
    for first in rounds[0]:
        steps.append(CaptureStep((first,), by_hand=first.serial in seen))
        others = (shot for later in rounds[1:] for shot in later if shot.place == first.place)
        steps += [CaptureStep((shot,)) for shot in others]
        seen.add(first.serial)
    return steps


def _check(assignment: Sequence[tuple[str, str]], simultaneous: bool) -> None:
    if not assignment:
        raise UsageError("No view was named; say which sensor gives which view: left=SERIAL …")
    users: dict[str, list[str]] = {}
    for view, serial in assignment:
        users.setdefault(serial, []).append(view)
    if len(users) > MOST_SENSORS:
        raise UsageError(
            "{count} sensors were named, but at most {most} work.",
            count=len(users),
            most=MOST_SENSORS,
        )
    _check_shared(users if simultaneous else {})


def _check_shared(users: Mapping[str, Sequence[str]]) -> None:
    for serial, views in users.items():
        if len(views) > 1:
            raise UsageError(
                "The views {views} are both given to sensor {serial}, which cannot take them at "
                "the same time; give each view its own sensor, or capture one after the other.",
                views=joined(views, " and "),
                serial=serial,
            )


def _check_motors(
    assignment: Sequence[tuple[str, str]], tilting: Sequence[tuple[str, str]]
) -> None:
    if not tilting:
        raise UsageError(
            "Between bursts a motor tilts the sensor, and none of these has one: {serials}. "
            "Capture one series of each view, without bursts.",
            serials=joined(dict.fromkeys(serial for _, serial in assignment)),
        )


def _check_names(views: Sequence[str]) -> None:
    for view in views:
        if not _VIEW.fullmatch(view):
            raise UsageError(
                '"{view}" cannot name a view; use 1 to 32 of the letters a-z, 0-9 and _.', view=view
            )
        if views.count(view) > 1:
            raise UsageError("The view {view} is named twice; name every view once.", view=view)


@dataclass(frozen=True)
class PlanRequest:
    """The arguments that a plan is made from.

    Parameters
    ----------
    assignment, frames, color_frames, simultaneous, bursts, without_motor
        As in `make_plan`.
    """

    assignment: tuple[tuple[str, str], ...]
    frames: int = 10
    color_frames: int = 1
    simultaneous: bool = False
    bursts: int = 1
    without_motor: tuple[str, ...] = ()

    def plan(self) -> CapturePlan:
        """Make the plan.

        Raises
        ------
        UsageError
        """
        return make_plan(
            self.assignment,
            frames=self.frames,
            color_frames=self.color_frames,
            simultaneous=self.simultaneous,
            bursts=self.bursts,
            without_motor=self.without_motor,
        )

    def as_extra(self) -> dict[str, Any]:
        """Return the request in the form that the manifest keeps."""
        return {_KEY: asdict(self)}


def kept_request(extra: Mapping[str, Any]) -> PlanRequest | None:
    """Return the request that a manifest keeps; None if it keeps none that can be carried out.

    Parameters
    ----------
    extra
        The additional entries of the manifest.
    """
    try:
        kept = extra[_KEY]
        pairs = tuple((str(view), str(serial)) for view, serial in kept["assignment"])
        motorless = tuple(str(serial) for serial in kept.get("without_motor", ()))
        request = PlanRequest(**{**kept, "assignment": pairs, "without_motor": motorless})
        request.plan()
    except (AttributeError, KeyError, TypeError, ValueError, UsageError):
        return None
    return request
