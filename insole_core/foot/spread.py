"""How far each measure of a foot may be off, and what says so.

The ± of a measure is half of its 95 % limits: in 95 of 100 cases the value lies no farther off

- from the mean of many captures like this one, where a repeat test of the same sensors gives it,
- from the same measure of the true surface, where simulated captures give it.

Of the file of another scanner it is not known, nor of what rests on a place set by hand. Two values
differ by more than their error when their difference exceeds the root of the sum of both squares.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Any, TypeAlias

from insole_core.foot.landmarks import Landmarks
from insole_core.foot.measures import (
    DEFINITIONS,
    SIZES,
    Measured,
    by_hand,
    deviations_mm,
    doubts,
    measure,
)
from insole_core.messages import Message

if TYPE_CHECKING:
    from insole_core.foot.foot import Foot

_DEVIATIONS = 2.0
"""Standard deviations on either side that hold 95 % (`benchmarks/measures.py`)."""
Limits: TypeAlias = Mapping[str, float]
"""Halves of 95 % limits by measure, in its unit, as a repeat test gives them."""


class SpreadSource(StrEnum):
    """What says how far a measure may be off."""

    REPEATED = "repeat test"
    SIMULATED = "simulation"
    FOREIGN = "another scanner"
    UNKNOWN = "unknown"


EXPLAINED: Mapping[SpreadSource, str] = {
    SpreadSource.REPEATED: Message("±: 95 % limits, by the repeat test of this place"),
    SpreadSource.SIMULATED: Message("±: 95 % limits, by simulated captures"),
    SpreadSource.FOREIGN: Message("± ?: not known of another scanner's file"),
    SpreadSource.UNKNOWN: Message("± ?: not known for this value"),
}


@dataclass(frozen=True)
class Spread:
    """How far a value may be off.

    Parameters
    ----------
    limits_95
        Half of the 95 % limits, in the unit of the measure; None where nothing tells them.
    source
    """

    limits_95: float | None = None
    source: SpreadSource = SpreadSource.UNKNOWN

    def beside(self, other: Spread) -> float | None:
        """Return the 95 % limit of a difference of two values; None where one is not known."""
        if self.limits_95 is None or other.limits_95 is None:
            return None
        return math.hypot(self.limits_95, other.limits_95)


UNKNOWN, FOREIGN = Spread(), Spread(source=SpreadSource.FOREIGN)
Spreads: TypeAlias = Mapping[str, Spread]


@dataclass(frozen=True)
class MeasuredFoot:
    """The measures of a foot with their ±, by the names in `DEFINITIONS`.

    Parameters
    ----------
    values
    spreads
    doubts
        Why a measure is uncertain, a text for each that is.
    """

    values: Measured
    spreads: Spreads
    doubts: Mapping[str, str] = field(default_factory=dict)

    def spread(self, name: str) -> Spread:
        """Return the ± of a measure."""
        return self.spreads.get(name, UNKNOWN)

    def limits_json(self, names: Iterable[str]) -> dict[str, dict[str, Any]]:
        """Return the ± of some measures for a report, and by what each is told.

        Returns
        -------
        dict
            ``limits_95`` and ``limits_by``, each by the name of the measure.
        """
        told = {name: self.spread(name) for name in names if self.values.get(name) is not None}
        return {
            "limits_95": {
                name: None if spread.limits_95 is None else round(spread.limits_95, 3)
                for name, spread in told.items()
            },
            "limits_by": {name: str(spread.source) for name, spread in told.items()},
        }


def spreads_of(
    landmarks: Landmarks, *, is_recorded: bool, repeated: Limits | None = None
) -> dict[str, Spread]:
    """Tell how far the measures of a foot may be off.

    Parameters
    ----------
    landmarks
        Of the foot.
    is_recorded
        Whether its surface was reconstructed from a session; of other files nothing is known.
    repeated
        By the repeat test of the same sensors. It says nothing of an end that was seen badly this
        time: there the wider ± counts.

    Returns
    -------
    dict
        By the names in `DEFINITIONS`; unknown for what rests on a place set by hand.
    """
    if not is_recorded:
        return dict.fromkeys(DEFINITIONS, FOREIGN)
    stated, uncertain = deviations_mm(landmarks), doubts(landmarks)
    found = {name: _spread(name, stated, uncertain.keys(), repeated or {}) for name in DEFINITIONS}
    return found | dict.fromkeys(by_hand(landmarks), UNKNOWN)


def _spread(name: str, stated: Limits, uncertain: Set[str], repeated: Limits) -> Spread:
    """Return the ± of a measure; a size has that of the length, in whole steps of its own."""
    if name in SIZES:
        length = _spread("foot_length", stated, uncertain, repeated)
        return _in_steps(length, *SIZES[name])
    is_doubtful = name in uncertain
    deviation = stated.get(name, None if is_doubtful else DEFINITIONS[name].deviation)
    simulated = None if deviation is None else _DEVIATIONS * deviation
    tested = repeated.get(name)
    if tested is not None and (not is_doubtful or (simulated or math.inf) <= tested):
        return Spread(tested, SpreadSource.REPEATED)
    return UNKNOWN if simulated is None else Spread(simulated, SpreadSource.SIMULATED)


def _in_steps(length: Spread, mm_per_unit: float, step: float) -> Spread:
    if length.limits_95 is None:
        return length
    return replace(length, limits_95=math.ceil(length.limits_95 / mm_per_unit / step) * step)


def measure_foot(
    foot: Foot, landmarks: Landmarks, *, is_recorded: bool, repeated: Limits | None = None
) -> MeasuredFoot:
    """Measure a foot, and tell how far each measure may be off: `measure` and `spreads_of`."""
    spreads = spreads_of(landmarks, is_recorded=is_recorded, repeated=repeated)
    return MeasuredFoot(measure(foot, landmarks), spreads, doubts(landmarks))


def number_text(name: str, value: float) -> str:
    """Return a value with the decimals of its measure."""
    if DEFINITIONS[name].decimals == 2:
        return Message("{value:.2f}", value=value)
    return Message("{value:.1f}", value=value)


def spread_text(name: str, limits_95: float | None) -> str:
    """Return the ± that stands beside a measure, with the decimals of its value."""
    if limits_95 is None:
        return "± ?"
    if DEFINITIONS[name].decimals == 2:
        return Message("± {limits:.2f}", limits=limits_95)
    return Message("± {limits:.1f}", limits=limits_95)


def explained(spreads: Iterable[Spread]) -> list[str]:
    """Return a line for each source of the ± that stand beside values."""
    shown = {spread.source for spread in spreads}
    return [EXPLAINED[source] for source in SpreadSource if source in shown]
