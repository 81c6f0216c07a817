"""What the panels list, as plain values between presenter and view."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.geometry.side import Side


@dataclass(frozen=True)
class Measure:
    """One measure, ready to be read; `tip` is its definition.

    `values` holds one number, or those of left and right, their difference and per cent; `key` is
    its name where a click leads to its place.
    """

    name: str
    values: tuple[str, ...]
    unit: str = ""
    tip: str = ""
    key: str = ""


@dataclass(frozen=True)
class WarningRow:
    """One warning: its sentence, and whether a click leads anywhere."""

    text: str
    leads: bool


@dataclass(frozen=True)
class CorrectionRow:
    """One correction in the list; `ordered` where its place among the others has a meaning."""

    id: str
    side: Side
    text: str
    enabled: bool
    selected: bool
    ordered: bool = False


@dataclass(frozen=True)
class FieldSpec:
    """One number that can be edited."""

    key: str
    label: str
    unit: str
    value: float
    least: float
    greatest: float
    step: float
    decimals: int = 1


@dataclass(frozen=True)
class ChoiceSpec:
    """One word out of several; `options` are pairs of the word and its text."""

    key: str
    label: str
    value: str
    options: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Proposal:
    """A button: what it does by key, its text, and what it says when the pointer rests on it."""

    key: str
    text: str
    tip: str = ""


@dataclass(frozen=True)
class FieldGroup:
    """Numbers that belong together, under a title, with what can be done to them.

    `caption` says what the offers are, where their texts alone do not.
    """

    title: str
    fields: tuple[FieldSpec | ChoiceSpec, ...] = ()
    offers: tuple[Proposal, ...] = ()
    note: str = ""
    caption: str = ""

    @property
    def shape(self) -> tuple[object, ...]:
        """Everything but the values: equal shapes need no other fields."""
        fields = tuple((f.key, getattr(f, "options", ())) for f in self.fields)
        return (self.title, fields, self.offers, self.note)
