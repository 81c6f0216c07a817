"""What a file of plantar pressure holds of one foot: its frames, their unit, what it says."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np
import numpy.typing as npt

from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side

_KPA = {"kPa": 1.0, "N/cm²": 10.0, "mmHg": 0.133322, "psi": 6.894757, "g/cm²": 0.0980665,
        "kg/cm²": 98.0665}  # fmt: skip
_WRITTEN = {
    "kpa": "kPa", "n/cm2": "N/cm²", "n/cm²": "N/cm²", "n/cm^2": "N/cm²", "mmhg": "mmHg",
    "psi": "psi", "g/cm2": "g/cm²", "g/cm²": "g/cm²", "g/cm^2": "g/cm²", "kg/cm2": "kg/cm²",
    "kg/cm²": "kg/cm²", "kg/cm^2": "kg/cm²", "n": "N",
}  # fmt: skip
PITCH_MM = (1.0, 30.0)
LENGTH_MM = (120.0, 380.0)
"""Of an insole with sensors."""
_MOST_KPA = 3000.0
_LEAST_USUAL_KPA = 40.0
_STEP, _LEAST_FRAMES = 0.05, 3  # of the greatest sum, and frames that a step takes at least


class PressureUnit(StrEnum):
    """Unit of the numbers of a map."""

    KPA = "kPa"
    N_CM2 = "N/cm²"
    MMHG = "mmHg"
    PSI = "psi"
    G_CM2 = "g/cm²"
    KG_CM2 = "kg/cm²"
    NEWTON = "N"
    """Force on each sensor."""

    def kpa(self, sensor_mm2: float) -> float:
        """Return the pressure, kPa, of a number 1 on a sensor of an area, mm²."""
        return 1000.0 / sensor_mm2 if self is PressureUnit.NEWTON else _KPA[self]

    @classmethod
    def written(cls, text: str) -> PressureUnit | None:
        """Return the unit that a text names, in whatever case; None when it names none."""
        name = _WRITTEN.get(text.strip().lower())
        return None if name is None else cls(name)


class SeenFrom(StrEnum):
    """From where a map or picture shows the foot: from above as one sees one's own feet."""

    ABOVE = "above"
    BELOW = "below"


class Question(StrEnum):
    """What a file does not say of its map."""

    PITCH = "pitch"
    LENGTH = "length"
    UNIT = "unit"
    SIDE = "side"
    SEEN_FROM = "seen_from"


@dataclass(frozen=True)
class Answers:
    """What the user says of a map; None leaves what the file says.

    Parameters
    ----------
    pitch_mm
        Distance of the sensors, across and along.
    length_mm
        Of an insole with sensors whose places are known as shares of its length.
    """

    side: Side | None = None
    pitch_mm: tuple[float, float] | None = None
    length_mm: float | None = None
    unit: PressureUnit | None = None
    seen_from: SeenFrom | None = None


@dataclass(frozen=True)
class Step:
    """Frames of one contact, from `first` to `last`, counted from 0."""

    first: int
    last: int


@dataclass(frozen=True, eq=False)
class PressureRecording:
    """The frames of one foot.

    Parameters
    ----------
    device
        Make of the plate or insole; empty where the file does not tell.
    name
        Which of several of one file; empty for the only one.
    values : (frames, rows, columns) float32
        In `unit`; NaN where there is no sensor.
    pitch_mm
        Distance of the sensors, across and along; None where the file does not say.
    unit, side, seen_from
        None where the file does not say.
    drawn_as
        The foot whose insole the columns show, where the file does not say which foot it is: for
        the other one they are mirrored.
    is_insole
        Whether the sensors' places are known as shares of the length of an insole.
    """

    device: str
    name: str
    values: npt.NDArray[np.float32]
    pitch_mm: tuple[float, float] | None = None
    unit: PressureUnit | None = None
    side: Side | None = None
    seen_from: SeenFrom | None = None
    drawn_as: Side | None = None
    is_insole: bool = False

    @property
    def questions(self) -> tuple[Question, ...]:
        """What has to be answered before the map can be laid."""
        pitch = Question.LENGTH if self.is_insole else Question.PITCH
        asked = {
            pitch: self.pitch_mm,
            Question.UNIT: self.unit,
            Question.SIDE: self.side,
            Question.SEEN_FROM: self.seen_from,
        }
        return tuple(question for question, known in asked.items() if known is None)

    def answered(self, answers: Answers) -> PressureRecording:
        """Return the recording with what the user says in place of what the file says.

        Raises
        ------
        InputError
            When a length is not one of sensors or of an insole.
        """
        values, side = self.values, answers.side or self.side
        if self.drawn_as is not None and side is not None and side is not self.drawn_as:
            values = values[:, :, ::-1]
        drawn_as = self.drawn_as if side is None or self.drawn_as is None else side
        return replace(
            self,
            values=values,
            pitch_mm=self._pitch(answers),
            unit=answers.unit or self.unit,
            side=side,
            seen_from=answers.seen_from or self.seen_from,
            drawn_as=drawn_as,
        )

    def _pitch(self, answers: Answers) -> tuple[float, float] | None:
        if self.is_insole and answers.length_mm is not None:
            _check("length of the insole", answers.length_mm, LENGTH_MM)
            each = answers.length_mm / self.values.shape[1]
            return each, each
        for pitch in answers.pitch_mm or ():
            _check("distance of the sensors", pitch, PITCH_MM)
        return answers.pitch_mm or self.pitch_mm

    @property
    def sums(self) -> FloatArray:
        """(frames,) sum of all sensors, to show the course of the contact."""
        return np.asarray(np.nansum(self.values, axis=(1, 2), dtype=np.float64))

    def steps(self) -> tuple[Step, ...]:
        """Return the contacts, in order; a single frame is one."""
        sums = self.sums
        if len(sums) < 2 * _LEAST_FRAMES:
            return (Step(0, len(sums) - 1),)
        on = np.concatenate([[False], sums > _STEP * sums.max(), [False]])
        changes = np.flatnonzero(on[1:] != on[:-1])
        found = [
            Step(int(first), int(after) - 1)
            for first, after in zip(changes[::2], changes[1::2], strict=True)
            if after - first >= _LEAST_FRAMES
        ]
        return tuple(found) or (Step(0, len(sums) - 1),)

    def peak(self, step: Step | None = None) -> FloatArray:
        """(rows, columns) greatest pressure of each sensor, kPa; NaN where there is none.

        Raises
        ------
        InputError
            When unit or distance of the sensors are not known, or nothing presses.
        """
        chosen = self._frames(step)
        return self._kpa(np.fmax.reduce(chosen, axis=0))

    def mean(self, step: Step | None = None) -> FloatArray:
        """(rows, columns) mean pressure of each sensor over the frames, kPa; as for `peak`."""
        return self._kpa(self._frames(step).mean(axis=0, dtype=np.float64))

    def frame(self, number: int) -> FloatArray:
        """(rows, columns) pressure in one frame, counted from 0, kPa; as for `peak`."""
        if not 0 <= number < len(self.values):
            raise InputError(
                "There is no frame {number}; choose one from 1 to {count}.",
                number=number + 1,
                count=len(self.values),
            )
        return self._kpa(self.values[number])

    def _frames(self, step: Step | None) -> npt.NDArray[np.float32]:
        return self.values if step is None else self.values[step.first : step.last + 1]

    def _kpa(self, values: npt.NDArray[np.floating]) -> FloatArray:
        if self.unit is None or self.pitch_mm is None:
            raise InputError(
                "The file does not say the {what} of its numbers; state it.",
                what="unit" if self.unit is None else "distance of the sensors",
            )
        kpa = values.astype(np.float64) * self.unit.kpa(self.pitch_mm[0] * self.pitch_mm[1])
        greatest = float(np.nanmax(kpa, initial=0.0))
        if not 0 < greatest <= _MOST_KPA:
            raise InputError(
                "The greatest pressure is {greatest:.0f} kPa, and a foot presses with more than 0 "
                "and at most {most:.0f} kPa; check the unit and the frame.",
                greatest=greatest,
                most=_MOST_KPA,
            )
        return np.asarray(kpa)


def is_faint(kpa: FloatArray) -> bool:
    """Return whether a map is so faint that its unit may be another one."""
    return float(np.nanmax(kpa)) < _LEAST_USUAL_KPA


def _check(what: str, value: float, between: tuple[float, float]) -> None:
    if not between[0] <= value <= between[1]:
        raise InputError(
            "The {what} is {value:g} mm, and it must be {low:g} to {high:g} mm.",
            what=what,
            value=value,
            low=between[0],
            high=between[1],
        )
