"""The measures of a visit as the record stores them: a number by side, name and unit.

``left_foot_length_mm`` is a measure. Its ± stands beside it under the same key and what tells it:
``left_foot_length_mm_limits_95_by_simulation``; where nothing does, as in older visits, there is no
such key.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from insole_core.foot.measures import DEFINITIONS
from insole_core.foot.spread import UNKNOWN, MeasuredFoot, Spread, SpreadSource
from insole_core.geometry.side import Side

_UNITS = {"mm": "_mm", "degrees": "", "": ""}
"""What a key ends with; names of angles already end so."""
_LIMITS = {
    SpreadSource.REPEATED: "_limits_95_by_repeat_test",
    SpreadSource.SIMULATED: "_limits_95_by_simulation",
}


@dataclass(frozen=True)
class StoredMeasure:
    """A measure of a visit.

    Parameters
    ----------
    key
        Name with its unit, without the side: ``foot_length_mm``.
    name
        As in `DEFINITIONS`; the key where it is not one of those.
    """

    key: str
    name: str
    side: Side | None
    value: float
    spread: Spread = UNKNOWN


def measures_to_store(measured: Mapping[Side, MeasuredFoot]) -> dict[str, float]:
    """Return the measures of feet by key, each with its ±; none for what was not scanned."""
    stored: dict[str, float] = {}
    for side, foot in measured.items():
        for name, value in foot.values.items():
            if value is None:
                continue
            key, spread = f"{side}_{name}{_UNITS[DEFINITIONS[name].unit]}", foot.spread(name)
            stored[key] = round(value, 3)
            if spread.limits_95 is not None:
                stored[key + _LIMITS[spread.source]] = round(spread.limits_95, 3)
    return stored


def stored_measures(stored: Mapping[str, float]) -> list[StoredMeasure]:
    """Return the measures of a visit, each with its ±, in the order of the record."""
    limits = {
        key.removesuffix(suffix): Spread(value, source)
        for key, value in stored.items()
        for source, suffix in _LIMITS.items()
        if key.endswith(suffix)
    }
    return [
        _measure(key, value, limits.get(key, UNKNOWN))
        for key, value in stored.items()
        if not key.endswith(tuple(_LIMITS.values()))
    ]


def measured_anew(stored: Mapping[str, float], found: Mapping[str, float]) -> dict[str, float]:
    """Return the measures of a visit after feet were measured anew: theirs are replaced at once."""
    sides = {f"{side}_" for side in Side if any(key.startswith(f"{side}_") for key in found)}
    kept = {key: value for key, value in stored.items() if not key.startswith(tuple(sides))}
    return {**kept, **found}


def _measure(key: str, value: float, spread: Spread) -> StoredMeasure:
    side = next((side for side in Side if key.startswith(f"{side}_")), None)
    rest = key if side is None else key.removeprefix(f"{side}_")
    name = next((n for n, d in DEFINITIONS.items() if rest == n + _UNITS[d.unit]), rest)
    return StoredMeasure(rest, name, side, value, spread)
