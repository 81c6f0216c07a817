"""A field of the record, declared once on the value that holds it.

`Person`, `Visit`, `Order` and `FollowUp` say in the annotation of a field what it is called, what
it may hold, and what an erasure and a merge do to it. Column, checks, forms, conflicts, erasure,
merging, import, export and papers follow; nothing else lists the fields.
"""

from __future__ import annotations

import unicodedata
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from datetime import date
from enum import Enum, auto
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from insole_core.annotated import said_of_fields
from insole_core.cases.days import EARLIEST, LATEST_AHEAD, read_day
from insole_core.errors import InputError
from insole_core.folded_text import fold
from insole_core.messages import Message, joined
from insole_core.records.field_checks import (
    MOST_NAME,
    MOST_TEXT,
    check_between,
    check_day,
    check_line,
    check_name,
    check_number,
    check_text,
)
from insole_core.records.marks import Info, Mark

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

    Value = TypeVar("Value", bound=DataclassInstance)


# Without comparison and repr, which nobody asks for: every start of the window makes these classes.
@dataclass(frozen=True, eq=False, repr=False)
class Field(ABC):
    """What general code has to know of a field.

    Parameters
    ----------
    noun
        Within a sentence.
    info
        What an erasure and a merge do to its column, see `marks`.
    is_needed
        Whether it is never empty.
    """

    noun: str
    info: Info
    _: KW_ONLY
    is_needed: bool = False

    kind: ClassVar[type] = str
    """Of what the column holds."""

    @property
    def mark(self) -> Mark:
        """What general code has to know of the column."""
        mark: Mark = self.info["mark"]
        return mark

    @property
    def empty(self) -> str | None:
        """What the column holds that nobody has filled."""
        return "" if self.kind is str else None

    @abstractmethod
    def checked(self, value: Any, today: date) -> Any:
        """Return a value as it is stored.

        Raises
        ------
        InputError
            When it cannot be right.
        """


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Made(Field):
    """What the program fills by itself, and no form shows.

    Parameters
    ----------
    stored
        What the column holds at first; brackets for JSON.
    """

    stored: str = ""

    @property
    def empty(self) -> str:
        """What the column holds that nobody has filled."""
        return self.stored

    @property
    def is_json(self) -> bool:
        """Whether the column holds JSON."""
        return self.stored in ("[]", "{}")

    def checked(self, value: Any, today: date) -> Any:
        """Return it as it is."""
        return value


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class MadeLine(Made):
    """A text of one line that the program fills, such as the path of a folder.

    Parameters
    ----------
    most
        Characters.
    """

    most: int = MOST_NAME

    def checked(self, value: Any, today: date) -> str:
        """Return the text without spaces around it."""
        return check_line(value, self.noun, self.most)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Typed(Field):
    """What somebody fills in.

    Parameters
    ----------
    label
        In forms, and in front of the value on paper.
    headings
        Of a column that usually holds it in lists of other programs, in English, Swedish and
        German; none for a field that is not imported.
    is_told
        Whether papers and sentences tell it; not, if it only says how another one is meant.
    is_listed
        Whether it is a column of lists, and stands in the heading of a card.
    stated
        What the statement of a device calls it; empty where it does not tell it.
    fhir
        The element of the FHIR resource that holds it; empty for none.
    """

    label: str
    headings: tuple[str, ...] = ()
    is_told: bool = True
    is_listed: bool = False
    stated: str = ""
    fhir: str = ""

    def read(self, text: str, today: date) -> Any:
        """Return what was typed, as it is stored.

        Raises
        ------
        InputError
            When it cannot be right.
        """
        return self.checked(text, today)

    def written(self, value: Any) -> str:
        """Return a value as it can be typed."""
        return "" if value is None else str(value)

    def said(self, value: Any) -> str:
        """Return a value as papers and windows tell it: a message if it is to be translated."""
        return self.written(value)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Line(Typed):
    """A text of one line.

    Parameters
    ----------
    most
        Characters.
    has_breaks
        Whether it may hold line breaks all the same.
    """

    most: int = MOST_NAME
    has_breaks: bool = False

    def checked(self, value: Any, today: date) -> str:
        """Return the text without spaces around it."""
        if self.is_needed:
            return check_name(value, self.noun, self.most)
        check = check_text if self.has_breaks else check_line
        return check(value, self.noun, self.most)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Lines(Typed):
    """A text of several lines, of which two can be kept, one below the other.

    Parameters
    ----------
    is_low
        Whether a form shows it in one line, as there is little room.
    keeps_headings
        Whether each line is led by the heading of its column where an import finds several.
    """

    is_low: bool = False
    keeps_headings: bool = False

    most: ClassVar[int] = MOST_TEXT

    def checked(self, value: Any, today: date) -> str:
        """Return the text without spaces around it."""
        return check_text(value, self.noun, self.most)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Choice(Typed):
    """One of a few words.

    Parameters
    ----------
    names
        By the word that is stored, what it is called.
    """

    names: Mapping[str, str]

    def checked(self, value: Any, today: date) -> str:
        """Return the word."""
        word = str(value)
        if word not in self.names and (word or self.is_needed):
            raise InputError(
                "The {what} is one of: {names}; {word} is none of them.",
                what=self.noun,
                names=joined(map(Message, self.names.values())),
                word=word[:40],
            )
        return word

    def read(self, text: str, today: date) -> str:
        """Return the word, by itself or by what it is called, in whatever letters."""
        typed = fold(text.strip())
        words = (word for word, name in self.names.items() if typed in (fold(word), fold(name)))
        return self.checked(next(words, text.strip()), today)

    def said(self, value: Any) -> str:
        """Return what the word is called; nothing for none."""
        return Message(self.names[value]) if value else ""


class Day(Typed):
    """A day not far from today."""

    kind = date
    limits: ClassVar[str] = "visit"
    """As `read_day` knows them."""

    def checked(self, value: Any, today: date) -> date | None:
        """Return the day."""
        return check_day(value, self.noun, today)

    def read(self, text: str, today: date) -> date | None:
        """Return the day, written in any way that has one reading; None for nothing."""
        day = read_day(self.limits, text, today)
        return self.checked(date.fromisoformat(day), today) if day else None


class BirthDate(Day):
    """A day on which somebody was born."""

    limits = "born"

    def checked(self, value: Any, today: date) -> date | None:
        """Return the day."""
        return check_between(value, EARLIEST, today, self.noun)


class VisitDay(Day):
    """A day on which somebody was there, or is to come."""

    def checked(self, value: Any, today: date) -> date | None:
        """Return the day."""
        return check_between(value, EARLIEST, today + LATEST_AHEAD, self.noun)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Number(Typed):
    """A number between two limits."""

    least: float
    most: float

    kind = float

    def checked(self, value: Any, today: date) -> float | None:
        """Return the number."""
        return check_number(value, self.noun, self.least, self.most)

    def read(self, text: str, today: date) -> float | None:
        """Return the number, with a point or a comma; None for nothing."""
        text = text.strip()
        if not text:
            return None
        try:
            number = float(text.replace(",", "."))
        except ValueError:
            raise InputError(
                "{text} is no number; write it such as 72.5.", text=text[:40]
            ) from None
        return self.checked(number, today)

    def written(self, value: Any) -> str:
        """Return the number without needless digits."""
        return "" if value is None else f"{value:g}"

    def said(self, value: Any) -> str:
        """Return the same, to be translated: with the decimal sign of the language."""
        return "" if value is None else Message("{number:.12g}", number=value)


def fields_of(kind: type[object]) -> Mapping[str, Field]:
    """Return the declared fields of a kind of value by their names, in the order of its forms."""
    return said_of_fields(kind, Field)  # type: ignore[type-abstract]


def typed_fields(kind: type[object]) -> dict[str, Typed]:
    """Return those fields that somebody fills in."""
    return {name: f for name, f in fields_of(kind).items() if isinstance(f, Typed)}


def listed_fields(kind: type[object]) -> dict[str, Typed]:
    """Return those fields that are columns of lists."""
    return {name: field for name, field in typed_fields(kind).items() if field.is_listed}


def told_fields(value: DataclassInstance) -> Iterator[tuple[Typed, str]]:
    """Yield the fields of a value that are told and filled in, and what is said of them."""
    for name, field in typed_fields(type(value)).items():
        said = field.said(getattr(value, name))
        if field.is_told and said:
            yield field, said


def check_fields(value: Value, today: date) -> Value:
    """Return a value with its declared fields as they are stored.

    Raises
    ------
    InputError
        Names the first field that cannot be right.
    """
    names = fields_of(type(value))
    held = {name: getattr(value, name) for name in names}
    return replace(value, **checked_values(type(value), held, today))


def checked_values(kind: type[object], values: Mapping[str, Any], today: date) -> dict[str, Any]:
    """Return values of declared fields as they are stored.

    Raises
    ------
    InputError
        Names the first one that cannot be right.
    """
    fields = fields_of(kind)
    return {name: fields[name].checked(value, today) for name, value in values.items()}


def changed_fields(before: DataclassInstance, after: DataclassInstance) -> list[str]:
    """Return the names of the declared fields that differ."""
    names = fields_of(type(after))
    return [name for name in names if getattr(before, name) != getattr(after, name)]


def merge_fields(
    before: Value, mine: Value, theirs: Value, names: Sequence[str]
) -> tuple[Value, tuple[str, ...]]:
    """Return theirs with what was changed in mine alone, and the fields that both have changed.

    Parameters
    ----------
    before
        What both changes are based on.
    names
        Of the fields to merge; all others are theirs.

    Returns
    -------
    tuple
        In a field that both have changed to different values, the first holds theirs.
    """
    changed = [n for n in names if not _are_equal(getattr(mine, n), getattr(before, n))]
    collided = tuple(
        name
        for name in changed
        if not _are_equal(getattr(theirs, name), getattr(before, name))
        and not _are_equal(getattr(theirs, name), getattr(mine, name))
    )
    taken = {name: getattr(mine, name) for name in changed if name not in collided}
    return replace(theirs, **taken), collided


class FieldChoice(Enum):
    """Which value of a field counts that two stations have changed."""

    MINE = auto()
    THEIRS = auto()
    BOTH = auto()
    """Theirs, and mine below it: for a text of several lines."""


def settle_fields(theirs: Value, mine: Value, choices: Mapping[str, FieldChoice]) -> Value:
    """Return theirs with the chosen value of each field."""
    chosen: dict[str, Any] = {}
    for name, choice in choices.items():
        if choice is FieldChoice.MINE:
            chosen[name] = getattr(mine, name)
        elif choice is FieldChoice.BOTH:
            chosen[name] = f"{getattr(theirs, name)}\n{getattr(mine, name)}"
    return replace(theirs, **chosen)


def _are_equal(one: object, other: object) -> bool:
    """Return whether two values are stored as the same one."""
    if isinstance(one, str) and isinstance(other, str):
        return _as_stored(one) == _as_stored(other)
    return one == other


def _as_stored(text: str) -> str:
    return unicodedata.normalize("NFC", text.replace("\r\n", "\n").replace("\r", "\n")).strip()
