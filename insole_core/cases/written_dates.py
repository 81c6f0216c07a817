"""Dates in the writings of other programs and countries.

Whether 03/04 is in March or April cannot be seen from one date: it is asked, or told by the other
dates of the same column, and never guessed.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from datetime import date
from enum import StrEnum
from typing import Final

from insole_core.errors import InputError
from insole_core.folded_text import fold


class DateOrder(StrEnum):
    """Which of two numbers before a year is the day."""

    DAY_FIRST = "day first"
    MONTH_FIRST = "month first"


class AmbiguousDate(InputError):  # noqa: N818 - says what is wrong with the date
    """Day and month of a date could be exchanged."""


_MIDNIGHT: Final = re.compile(r"(.*\d)[T ]00:00(:00(\.0+)?)?Z?")
"""What databases add to a day."""
_YEAR_FIRST: Final = re.compile(r"(\d{4})(?:([-./ ])(\d{1,2})\2(\d{1,2})|(\d{2})(\d{2}))")
_YEAR_LAST: Final = re.compile(r"(\d{1,2})([-./ ])(\d{1,2})\2(\d{4})")
_DAY_AND_NAME: Final = re.compile(r"(\d{1,2})[. -]+([^\W\d_]+)[., -]+(\d{4})")
_NAME_AND_DAY: Final = re.compile(r"([^\W\d_]+)[. ]+(\d{1,2})[., ]+(\d{4})")
_MONTHS: Final = (
    ("jan", "january", "januari", "januar"),
    ("feb", "february", "februari", "februar"),
    ("mar", "march", "mars", "marz", "mrz"),
    ("apr", "april"),
    ("may", "maj", "mai"),
    ("jun", "june", "juni"),
    ("jul", "july", "juli"),
    ("aug", "august", "augusti"),
    ("sep", "sept", "september"),
    ("oct", "okt", "october", "oktober"),
    ("nov", "november"),
    ("dec", "dez", "december", "dezember"),
)
"""Names in English, Swedish and German, without accents."""
_MONTH_OF: Final = {name: number for number, names in enumerate(_MONTHS, start=1) for name in names}


def read_date(text: str, order: DateOrder | None) -> date:
    """Return the day of a text.

    Parameters
    ----------
    order
        Of ``03/04/1970`` and ``03-04-1970``; None where it is not known. With dots the day is first
        everywhere, and ``1970-04-03`` has one reading only.

    Raises
    ------
    AmbiguousDate
        When it has two readings, and `order` is None.
    InputError
        When it is no day of the calendar, or not written with four digits of the year.
    """
    readings = _readings(text)
    if order is not None and order in readings:
        return readings[order]
    if order is not None and readings:
        raise _no_date(text)
    days = set(readings.values())
    if not days:
        raise _no_date(text)
    if len(days) > 1:
        first, second = sorted(days)
        raise AmbiguousDate(
            "{text} can be {first} or {second}; say whether day or month comes first.",
            text=text,
            first=first.isoformat(),
            second=second.isoformat(),
        )
    return days.pop()


def order_of(texts: Iterable[str]) -> DateOrder | None:
    """Return the order in which the dates of one column are written.

    Returns
    -------
    DateOrder or None
        The only one in which all dates are in the calendar; None where both are possible, or
        neither.
    """
    possible = set(DateOrder)
    for text in texts:
        readings = _readings(text)
        if readings:
            possible &= readings.keys()
    return possible.pop() if len(possible) == 1 else None


def needs_order(texts: Iterable[str]) -> bool:
    """Return whether one of the dates has two readings."""
    return any(len(set(_readings(text).values())) > 1 for text in texts)


def _readings(text: str) -> dict[DateOrder, date]:
    """Return the days that a text can mean, by order; empty when it is no date."""
    text = text.strip()
    if match := _MIDNIGHT.fullmatch(text):
        text = match.group(1)
    if match := _YEAR_FIRST.fullmatch(text):
        year, _, month, day, month_8, day_8 = match.groups()
        return _in_any_order(year, month or month_8, day or day_8)
    if match := _YEAR_LAST.fullmatch(text):
        first, mark, second, year = match.groups()
        if mark == ".":
            return _in_any_order(year, second, first)
        days = {
            DateOrder.DAY_FIRST: _day(year, second, first),
            DateOrder.MONTH_FIRST: _day(year, first, second),
        }
        return {order: day for order, day in days.items() if day is not None}
    return _readings_of_named_month(text)


def _readings_of_named_month(text: str) -> dict[DateOrder, date]:
    if match := _DAY_AND_NAME.fullmatch(text):
        day, name, year = match.groups()
    elif match := _NAME_AND_DAY.fullmatch(text):
        name, day, year = match.groups()
    else:
        return {}
    month = _MONTH_OF.get(fold(name))
    return {} if month is None else _in_any_order(year, str(month), day)


def _in_any_order(year: str, month: str, day: str) -> dict[DateOrder, date]:
    found = _day(year, month, day)
    return {} if found is None else dict.fromkeys(DateOrder, found)


def _day(year: str, month: str, day: str) -> date | None:
    try:
        return date(int(year), int(month), int(day))
    except ValueError:
        return None


def _no_date(text: str) -> InputError:
    return InputError(
        "{text} is no date; write year, month and day, such as 1970-02-28.", text=text[:40]
    )
