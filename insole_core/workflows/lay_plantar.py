"""Lay a map of pressures or a footprint under a foot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.messages import Message
from insole_core.pressure.alignment import Alignment, align_contact, align_pressure
from insole_core.pressure.laid_map import FootprintPicture, Placement, PressureMap
from insole_core.pressure.picture import contact_of_picture
from insole_core.pressure.recording import (
    Answers,
    PressureRecording,
    Question,
    SeenFrom,
    Step,
    is_faint,
)

_ASKED = {
    Question.PITCH: "the distance of the sensors",
    Question.LENGTH: "the length of the insole",
    Question.UNIT: "the unit of its numbers",
    Question.SIDE: "which foot it is",
    Question.SEEN_FROM: "whether it is seen from above or below",
}


@dataclass(frozen=True)
class Shown:
    """What of a recording is laid.

    Parameters
    ----------
    kind
        "peak", "mean" or "frame".
    step
        Contact, counted from 0; None for all frames. Not for a single frame.
    frame
        Counted from 0.
    """

    kind: str = "peak"
    step: int | None = None
    frame: int = 0

    def of(self, recording: PressureRecording) -> FloatArray:
        """Return the pressures (rows, columns), kPa.

        Raises
        ------
        InputError
            When there is no such step or frame.
        """
        if self.kind == "frame":
            return recording.frame(self.frame)
        step = None if self.step is None else _step(recording.steps(), self.step)
        return recording.peak(step) if self.kind == "peak" else recording.mean(step)

    def __str__(self) -> str:
        """Return how the case names it."""
        if self.kind == "frame":
            return f"frame {self.frame + 1}"
        return self.kind if self.step is None else f"{self.kind}, step {self.step + 1}"


@dataclass(frozen=True, eq=False)
class LaidPressure:
    """A map under its foot, and what is to be said of it.

    Parameters
    ----------
    pressure
    doubts
        Sentences on what may be wrong; empty if nothing.
    """

    pressure: PressureMap
    doubts: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class LaidPicture:
    """A picture under its foot, and what is to be said of it; as `LaidPressure`."""

    picture: FootprintPicture
    doubts: tuple[str, ...] = ()


def lay_pressure(
    foot: Foot, recording: PressureRecording, answers: Answers, shown: Shown, file: str
) -> LaidPressure:
    """Align one foot of a file to that foot.

    Parameters
    ----------
    file
        Its name, for what is wrong with it.

    Raises
    ------
    InputError
        When something of the map is not known, or it is that of the other foot.
    """
    known = recording.answered(answers)
    if known.questions:
        raise InputError(
            "{file} does not say {what}; state it.", file=file, what=_ASKED[known.questions[0]]
        )
    if known.side is not foot.side:
        raise InputError(
            "{file} is the map of a {side} foot, and the foot is a {foot_side} one; choose the "
            "other foot, or the other map.",
            file=file,
            side=str(known.side),
            foot_side=foot.side,
        )
    assert known.pitch_mm is not None
    assert known.seen_from is not None
    kpa = shown.of(known)
    laid = PressureMap(kpa, known.pitch_mm, Placement(), known.device, str(shown))
    found = align_pressure(foot, laid, known.seen_from)
    doubts: tuple[str, ...] = (found.doubt,) if found.doubt else ()
    if is_faint(kpa):
        doubts += (
            Message(
                "The greatest pressure is {kpa:.0f} kPa, little for a foot that stands; check the "
                "unit.",
                kpa=laid.peak_kpa,
            ),
        )
    return LaidPressure(laid.placed(found.placement), doubts)


def lay_picture(foot: Foot, picture: FootprintPicture, seen_from: SeenFrom) -> LaidPicture:
    """Align a picture of a footprint to its foot; in the middle where no print stands out."""
    try:
        found = align_contact(foot, contact_of_picture(picture), seen_from)
    except InputError as error:
        middle = Placement(0.0, foot.length_mm / 2, mirrored=seen_from is SeenFrom.BELOW)
        found = Alignment(middle, 1.0, error.message)
    return LaidPicture(picture.placed(found.placement), (found.doubt,) if found.doubt else ())


def _step(steps: Sequence[Step], number: int) -> Step:
    if not 0 <= number < len(steps):
        raise InputError(
            "There is no step {number}; choose one from 1 to {count}.",
            number=number + 1,
            count=len(steps),
        )
    return steps[number]
