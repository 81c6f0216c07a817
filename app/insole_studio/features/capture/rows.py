"""Values shown by the capture stage."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from insole_core.geometry.side import Side, Sides
from insole_studio.acquisition.guidance import DEPTH_RANGE_MM
from insole_studio.acquisition.messages import UNTUNED, Capability, LaserRange, Tuning
from insole_studio.scene.coloring import Coloring
from insole_studio.texts import tr

Mode = Literal["turns", "together", "moved"]
USUAL_VIEWS = ("left", "right", "top")
VIEWS_OF_BOTH = ("left", "right", "left_top", "right_top", "middle", "far_left", "far_right")
"""The first four are enough for both feet."""


@dataclass(frozen=True)
class CaptureOptions:
    """The options of a capture.

    Parameters
    ----------
    side
        The foot, or both.
    weight_bearing
        ``none``, ``semi`` or ``full``.
    held
        Whether somebody holds the foot.
    notes
        Free text for the session.
    mode
        Sensors in sequence, all at once, or moved by hand from view to view.
    views
        All views in order, if sensors are moved by hand.
    frames
        Depth frames per view.
    bursts
        Series per view, each tilted by one degree.
    """

    side: Sides = Side.LEFT
    weight_bearing: str = "none"
    held: bool = False
    notes: str = ""
    mode: Mode = "turns"
    views: tuple[str, ...] = USUAL_VIEWS
    frames: int = 10
    bursts: int = 1


@dataclass(frozen=True)
class SensorRow:
    """The card of one sensor.

    Parameters
    ----------
    serial, view
        Serial number and assigned view.
    title
        Name of the view and depth in the image centre.
    facts
        Frame rate, lost frames, valid pixels, markers.
    hints
        What to change, the most urgent first.
    problem
        Why the sensor sends nothing; None if it does.
    progress
        Completed share of the capture of its view.
    retakes
        Its views that can be captured again.
    capabilities
        What the sensor can be asked for.
    tuning, laser_range
        What is set of it, and the power that its projector can be set to.
    can_tune
        Whether it may be set now, rather than while a capture runs.
    """

    serial: str
    view: str
    title: str
    facts: str
    hints: tuple[str, ...] = ()
    problem: str | None = None
    progress: str = ""
    retakes: tuple[str, ...] = ()
    capabilities: frozenset[Capability] = frozenset()
    tuning: Tuning = UNTUNED
    laser_range: LaserRange | None = None
    can_tune: bool = True


@dataclass(frozen=True)
class CaptureRow:
    """The line below the cards.

    Parameters
    ----------
    running
        Whether a capture is running.
    fraction
        Completed share.
    sentence
        What is being done, or how it ended.
    button
        Text of the large button.
    can_capture
        Whether a capture can be started.
    can_use
        Whether a session can be opened.
    is_whole
        Whether it has all views, so that opening it is the next step.
    waits_for_hand
        Whether the user has to confirm that a sensor is in position.
    offer
        Text that offers to continue an unfinished capture; empty if there is none.
    can_tilt
        Whether a sensor has a motor, which bursts need.
    """

    running: bool = False
    fraction: float = 0.0
    sentence: str = ""
    button: str = ""
    can_capture: bool = False
    can_use: bool = False
    is_whole: bool = False
    waits_for_hand: bool = False
    offer: str = ""
    can_tilt: bool = True


def depth_coloring() -> Coloring:
    """Return the colour map of the depth images, for the legend."""
    return Coloring(np.empty(0), DEPTH_RANGE_MM, tr("Depth"))
