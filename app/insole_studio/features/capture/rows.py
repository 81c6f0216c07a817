"""What the capture stage shows, as values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from insole_core.geometry.side import Side
from insole_studio.acquisition.guidance import DEPTH_RANGE_MM
from insole_studio.scene.coloring import Coloring
from insole_studio.texts import tr

Mode = Literal["turns", "together", "moved"]
USUAL_VIEWS = ("left", "right", "top")


@dataclass(frozen=True)
class CaptureOptions:
    """What the user chooses before a capture.

    Parameters
    ----------
    side
    weight_bearing
        ``none``, ``semi`` or ``full``.
    held
        Whether somebody holds the foot.
    notes
    mode
        The sensors one after the other, all at once, or moved by hand from view to view.
    views
        Where sensors are moved: all views, in order.
    frames
        Depth frames a view.
    bursts
        Series a view, a degree of tilt apart.
    """

    side: Side = Side.LEFT
    weight_bearing: str = "none"
    held: bool = False
    notes: str = ""
    mode: Mode = "turns"
    views: tuple[str, ...] = USUAL_VIEWS
    frames: int = 10
    bursts: int = 1


@dataclass(frozen=True)
class SensorRow:
    """One sensor's card.

    Parameters
    ----------
    serial, view
    title
        The view with the depth in the middle of the picture.
    facts
        Frame rate, losses, valid pixels, markers.
    hints
        What to change, the most urgent first.
    problem
        Why it sends nothing; None where it sends.
    progress
        How far the capture of its view is.
    retakes
        Its views that can be captured again.
    """

    serial: str
    view: str
    title: str
    facts: str
    hints: tuple[str, ...] = ()
    problem: str | None = None
    progress: str = ""
    retakes: tuple[str, ...] = ()


@dataclass(frozen=True)
class CaptureRow:
    """The line below the cards.

    Parameters
    ----------
    running
    fraction
        The share that is done.
    sentence
        What goes on, or how it ended.
    button
        What the large button says.
    can_capture
    can_use
        Whether a session is ready to be opened.
    is_whole
        Whether all its views are there, so that it is time to open it.
    waits_for_hand
        Whether somebody has to say that a sensor stands.
    offer
        What an unfinished capture has left, to be gone on with; empty where there is none.
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


def depth_coloring() -> Coloring:
    """Give the colours of the depth pictures, for the legend."""
    return Coloring(np.empty(0), DEPTH_RANGE_MM, tr("Depth"))
