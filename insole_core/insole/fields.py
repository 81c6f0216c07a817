"""What a value of a prescription is, declared once, beside it.

A field of a part of a prescription is annotated with its words, range, unit and step:
``height_mm: Annotated[float, Number("Height", "How much the heel is raised", -10, 20)] = 3.0``.
What is read from JSON, limited, shown, printed, compared and mirrored follows from that by general
code. The fields are declared in the order in which they are shown and printed.
"""

from __future__ import annotations

import math
import types
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from functools import cache
from typing import (
    Any,
    ClassVar,
    Final,
    TypeAlias,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from insole_core.annotated import said_of_fields
from insole_core.messages import Message

Place: TypeAlias = tuple[float, float]
"""(x, y) in mm."""
LEAST_ZONE: Final = 0.05
"""Least share of the length over which a correction fades."""


@dataclass(frozen=True)
class Range:
    """Least and greatest value, both allowed, and the unit ("" for a plain number)."""

    least: float
    greatest: float
    unit: str = "mm"

    def __contains__(self, value: float) -> bool:
        return math.isfinite(value) and self.least <= value <= self.greatest

    def nearest(self, value: float) -> float:
        """Return a value itself if it is allowed, else the least or the greatest."""
        return min(max(value, self.least), self.greatest)

    def __str__(self) -> str:
        least, most = self.least, self.greatest
        if not self.unit:
            return Message("{least:g} to {most:g}", least=least, most=most)
        return Message("{least:g} to {most:g} {unit}", least=least, most=most, unit=self.unit)


@dataclass(frozen=True)
class Declared:
    """How one value of a prescription is called, whatever tells it.

    Parameters
    ----------
    label
        On the window's field, on paper and among differences; English, as all texts here.
    tip
        What the value does, in one sentence; without one the window has no general field for it.
    expert
        Whether it is about the computation, or rarely changed: shown apart, after all others.
    main
        How it is said where a correction is told by its main values, such as
        ``"{value} at the rearfoot"``; None if it is not among them.
    main_below
        The same of a number shown below 0, whose sign it says in words; empty if the sign is said.
    within
        What the label belongs to, where it stands alone among differences.
    effect
        For the manual, what the value does where there is no tip: where the window has a field of
        its own for it, or none.
    """

    label: str
    tip: str = ""
    expert: bool = field(default=False, kw_only=True)
    main: str | None = field(default=None, kw_only=True)
    main_below: str = field(default="", kw_only=True)
    within: str = field(default="", kw_only=True)
    effect: str = field(default="", kw_only=True)

    @property
    def range(self) -> Range | None:
        """What each number of the value may be; None of a value without numbers."""
        return None


@dataclass(frozen=True)
class Number(Declared):
    """A number.

    Parameters
    ----------
    least, greatest
        What a device and a workshop can do.
    unit
        "mm", "degrees", "kg", or "" for a plain number.
    step
        Of the window's field.
    template
        How the number is said on paper; with its unit if left out.
    offers
        The values that the window offers to choose from, with their names, instead of a field.
    """

    least: float = -math.inf
    greatest: float = math.inf
    unit: str = field(default="mm", kw_only=True)
    step: float = field(default=0.5, kw_only=True)
    template: str = field(default="", kw_only=True)
    offers: tuple[tuple[float | None, str], ...] = field(default=(), kw_only=True)

    @property
    def range(self) -> Range:
        """What the number may be."""
        return Range(self.least, self.greatest, self.unit)

    @property
    def factor(self) -> float:
        """By which a stored number is multiplied to be shown."""
        return 1

    @property
    def shown_unit(self) -> str:
        """The unit as it is shown."""
        return "°" if self.unit == "degrees" else self.unit

    @property
    def decimals(self) -> int:
        """How many are shown."""
        return 2 if self.step < 0.5 else 1

    @property
    def said(self) -> str:
        """The template of the number with its unit."""
        between = "" if self.shown_unit in ("°", "") else " "
        return self.template or f"{{value}}{between}{self.shown_unit}"


@dataclass(frozen=True)
class Depth(Number):
    """A height that is told by how far it lies below: shown > 0 where it is stored < 0."""

    @property
    def factor(self) -> float:
        """By which a stored number is multiplied to be shown."""
        return -1


@dataclass(frozen=True)
class Angle(Number):
    """An angle in degrees.

    Parameters
    ----------
    raises
        Whether it raises the medial edge above 0, and the lateral one below.
    """

    unit: str = field(default="degrees", kw_only=True)
    raises: bool = field(default=False, kw_only=True)


@dataclass(frozen=True)
class Share(Number):
    """A share from 0 to 1, shown in per cent.

    Parameters
    ----------
    before, after
        Name of the share of the same part that this one lies before or after, by `LEAST_ZONE` or
        more, or the surface gets a step.
    """

    least: float = 0.0
    greatest: float = 1.0
    unit: str = field(default="", kw_only=True)
    step: float = field(default=1.0, kw_only=True)
    before: str = field(default="", kw_only=True)
    after: str = field(default="", kw_only=True)

    @property
    def factor(self) -> float:
        """By which a stored number is multiplied to be shown."""
        return 100

    @property
    def shown_unit(self) -> str:
        """The unit as it is shown."""
        return "%"

    @property
    def decimals(self) -> int:
        """How many are shown."""
        return 0


@dataclass(frozen=True)
class OfLength(Share):
    """A share of the foot's length, counted from the heel."""

    expert: bool = field(default=True, kw_only=True)
    template: str = field(default="{value} % of the length", kw_only=True)


@dataclass(frozen=True)
class Choice(Declared):
    """One of several words, or yes or no.

    Parameters
    ----------
    words
        How each is said, within a sentence, by what the file holds.
    """

    words: Mapping[Any, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Text(Declared):
    """A text, such as a name."""


@dataclass(frozen=True)
class Spot(Declared):
    """A place on the foot; it is mirrored and moved with the foot."""

    each: ClassVar = (
        ("From axis", "Distance of the highest place from the foot axis; > 0 is medial"),
        ("From heel", "Distance of the highest place from the back of the heel"),
    )
    """Label and tip of either coordinate."""

    @property
    def range(self) -> Range:
        """What each coordinate may be."""
        return Range(-400, 400)


@dataclass(frozen=True)
class Pair(Declared):
    """Two numbers in mm, across and along.

    Parameters
    ----------
    each
        Label and tip of either.
    """

    least: float = 0.0
    greatest: float = 0.0
    each: tuple[tuple[str, str], tuple[str, str]] = (("", ""), ("", ""))

    @property
    def range(self) -> Range:
        """What each number may be."""
        return Range(self.least, self.greatest)


@dataclass(frozen=True)
class Line(Declared):
    """A line through places.

    Parameters
    ----------
    fewest, most
        How many places it may have.
    reach_mm
        How far from 0 they may lie, both ways.
    is_on_foot
        Whether its places are of the foot's frame, so that they are moved with the foot.
    is_mirrored
        Whether they are other ones for the other foot.
    """

    fewest: int = 1
    most: int = 2000
    reach_mm: float = field(default=400.0, kw_only=True)
    is_on_foot: bool = field(default=True, kw_only=True)
    is_mirrored: bool = field(default=True, kw_only=True)

    @property
    def range(self) -> Range:
        """What each coordinate may be."""
        return Range(-self.reach_mm, self.reach_mm)


@dataclass(frozen=True)
class Table(Declared):
    """Numbers in a row, or in rows: what is read from a form, and not told."""

    least: float = 0.0
    greatest: float = 0.0
    unit: str = field(default="mm", kw_only=True)

    @property
    def range(self) -> Range:
        """What each number may be."""
        return Range(self.least, self.greatest, self.unit)


class Part:
    """A part of a prescription: a frozen dataclass, its fields annotated as above."""

    def acts(self, name: str) -> bool:
        """Return whether a field does something beside the part's other values."""
        return True

    def declared(self, name: str) -> Declared:
        """Return what a field is, where that depends on the part's other values."""
        return declared(type(self))[name]


def declared(kind: type[Any]) -> Mapping[str, Declared]:
    """Return what the fields of a part are, by name, in the order in which they are shown."""
    return said_of_fields(kind, Declared)


def types_of(kind: type[Any]) -> Mapping[str, Any]:
    """Return what the fields of a part hold, without the None of what may be left out."""
    key: Any = kind
    return _types_of(key)


def ranges_of(kind: type[Any]) -> dict[str, Range]:
    """Return the ranges of all numbers of a part, by the names of their fields."""
    found = ((name, one.range) for name, one in declared(kind).items())
    return {name: allowed for name, allowed in found if allowed is not None}


def choices_of(kind: type[Any]) -> dict[str, tuple[str, ...]]:
    """Return the words that fields of a part may hold, by the names of the fields."""
    return {
        name: tuple(found.words)
        for name, found in declared(kind).items()
        if isinstance(found, Choice) and types_of(kind)[name] is str
    }


def range_beside(part: Part, name: str) -> Range:
    """Return the range of a number as the other values of its part narrow it.

    Raises
    ------
    KeyError
        If the field is no number.
    """
    found = part.declared(name)
    allowed = found.range
    if allowed is None:
        raise KeyError(name)
    least, greatest = allowed.least, allowed.greatest
    if isinstance(found, Share) and found.before:
        greatest = min(greatest, getattr(part, found.before) - LEAST_ZONE)
    if isinstance(found, Share) and found.after:
        least = max(least, getattr(part, found.after) + LEAST_ZONE)
    return Range(least, greatest, allowed.unit)


@cache
def _types_of(kind: type[Any]) -> Mapping[str, Any]:
    hints = get_type_hints(kind)
    return types.MappingProxyType({f.name: _without_none(hints[f.name]) for f in fields(kind)})


def _without_none(hint: Any) -> Any:
    if get_origin(hint) not in (types.UnionType, Union):
        return hint
    (kind,) = (one for one in get_args(hint) if one is not type(None))
    return kind
