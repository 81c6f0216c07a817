"""The editable values of a prescription: a field for each, as its class declares it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Final, TypeVar

import numpy as np

from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.insole.fields import (
    Choice,
    Declared,
    Number,
    Pair,
    Part,
    Spot,
    declared,
    range_beside,
    ranges_of,
)
from insole_core.insole.pads.pad_form import SIZES
from insole_core.insole.pads.pad_shapes import local_outline, pad_size, resized
from insole_studio.features.design.correction_names import capitalised
from insole_studio.features.design.rows import ChoiceSpec, FieldSpec
from insole_studio.texts import translate_core_message

_Part = TypeVar("_Part", bound=Part)
_PLAIN: Final = Number("")


@dataclass(frozen=True)
class Editable:
    """One editable number or choice of a part of the prescription.

    Parameters
    ----------
    name
        Name of the attribute.
    found
        What it is.
    number
        Index into a place or pair; None for a single value.
    """

    name: str
    found: Declared
    number: int | None = None

    @property
    def key(self) -> str:
        """Key of the value, unique within its part."""
        return self.name if self.number is None else f"{self.name}.{self.number}"

    def factor(self, side: Side) -> float:
        """Return the number that a stored value is multiplied by to be shown.

        The x of a place is shown as > 0 on the medial side of either foot.
        """
        if isinstance(self.found, Number):
            return self.found.factor
        return side.medial_sign if isinstance(self.found, Spot) and self.number == 0 else 1


def field_specs(
    part: Part, prefix: str, side: Side, *, expert: bool = False
) -> tuple[FieldSpec | ChoiceSpec, ...]:
    """Return the fields of a correction, of the design, of its layers or outline, in tab order.

    Values that the part does not have (the taper of a bar, an automatic position) are omitted.

    Parameters
    ----------
    part
        The part of the prescription.
    prefix
        Prefix of the fields' keys.
    side
        The foot that it is for.
    expert
        Whether to return those for experts, or all others.
    """
    wanted = (e for e in editables(part) if e.found.tip and e.found.expert is expert)
    specs = (_spec(part, editable, f"{prefix}.{editable.key}", side) for editable in wanted)
    return tuple(spec for spec in specs if spec is not None)


def editables(part: Part) -> tuple[Editable, ...]:
    """Return the values of a part that a field may hold, in the order of their declaration."""
    return tuple(
        editable
        for name in declared(type(part))
        for editable in _editables_of(name, part.declared(name))
    )


def _editables_of(name: str, found: Declared) -> tuple[Editable, ...]:
    if not isinstance(found, Pair | Spot):
        return (Editable(name, found),)
    return tuple(
        Editable(name, replace(found, label=label, tip=tip), number)
        for number, (label, tip) in enumerate(found.each)
    )


def with_value(part: _Part, key: str, value: float | str, side: Side) -> _Part:
    """Return the part with one value replaced.

    Parameters
    ----------
    part
        The part of the prescription.
    key
        Key of the field, without the prefix.
    value
        The new number, as the field shows it, or choice.
    side
        The foot that it is for.
    """
    (editable,) = (editable for editable in editables(part) if editable.key == key)
    found = editable.found
    if (offers := _offers(found)) and isinstance(value, str):
        return replace(part, **{key: offers[int(value)][0]})  # type: ignore[type-var]
    if isinstance(value, str):
        return _within(replace(part, **{key: value}))  # type: ignore[type-var]
    stored = value / editable.factor(side)
    if isinstance(part, Pelott) and editable.name in SIZES:
        sizes = dict(zip(SIZES, pad_size(part), strict=True)) | {editable.name: stored}
        return resized(part, **sizes)
    if editable.number is None:
        return replace(part, **{editable.name: stored})  # type: ignore[type-var]
    pair = list(_pair(part, editable.name) or (0.0, 0.0))
    pair[editable.number] = stored
    return replace(part, **{editable.name: tuple(pair)})  # type: ignore[type-var]


def _within(part: _Part) -> _Part:
    """Return the part with its numbers clipped to the ranges that its choices allow."""
    for name in ranges_of(type(part)):
        number = getattr(part, name)
        if isinstance(number, int | float):
            fitting: dict[str, Any] = {name: range_beside(part, name).nearest(number)}
            part = replace(part, **fitting)  # type: ignore[type-var]
    return part


def _spec(part: Part, editable: Editable, key: str, side: Side) -> FieldSpec | ChoiceSpec | None:
    found = editable.found
    if editable.name not in SIZES and not part.acts(editable.name):
        return None
    label, tip = translate_core_message(found.label), translate_core_message(found.tip)
    if offers := _offers(found):
        return ChoiceSpec(key, label, _shown(part, editable.name, offers), _options(offers), tip)
    if isinstance(found, Choice):
        options = tuple((word, capitalised(name)) for word, name in found.words.items())
        return ChoiceSpec(key, label, getattr(part, editable.name), options, tip)
    value = _number(part, editable)
    if value is None:
        return None
    factor, allowed = editable.factor(side), range_beside(part, editable.name)
    least, greatest = sorted((factor * allowed.least, factor * allowed.greatest))
    shown = found if isinstance(found, Number) else _PLAIN
    return FieldSpec(
        key,
        label,
        shown.shown_unit,
        factor * value + 0.0,  # never "-0"
        least,
        greatest,
        shown.step,
        decimals=shown.decimals,
        tip=tip,
    )


def _offers(found: Declared) -> tuple[tuple[Any, str], ...]:
    """Return the values that are offered to choose from, where these are no words of the file."""
    if isinstance(found, Number):
        return tuple((value, capitalised(name)) for value, name in found.offers)
    if isinstance(found, Choice) and False in found.words:
        return tuple((value, translate_core_message(name)) for value, name in found.words.items())
    return ()


def _shown(part: Part, name: str, offers: tuple[tuple[Any, str], ...]) -> str:
    """Return the number of the offered value that a part has; nothing if it has another."""
    values, current = [value for value, _ in offers], getattr(part, name)
    return str(values.index(current)) if current in values else ""


def _options(offers: tuple[tuple[Any, str], ...]) -> tuple[tuple[str, str], ...]:
    return tuple((str(number), name) for number, (_, name) in enumerate(offers))


def _number(part: Part, editable: Editable) -> float | None:
    if isinstance(part, Pelott) and editable.name in SIZES:
        return pad_size(part)[SIZES.index(editable.name)]
    if editable.number is not None:
        pair = _pair(part, editable.name)
        return None if pair is None else float(pair[editable.number])
    value = getattr(part, editable.name)
    return None if value is None else float(value)


def _pair(part: Part, name: str) -> tuple[float, float] | None:
    pair: tuple[float, float] | None = getattr(part, name)
    if pair is None and isinstance(part, Pelott) and name == "sigma_mm":
        half = np.ptp(local_outline(part), axis=0) / 2
        return round(float(half[0]), 1), round(float(half[1]), 1)
    return pair
