"""Checks of personal numbers; each country that is known has one, the others take any text."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import date
from types import MappingProxyType
from typing import Final

from insole_core.errors import InputError
from insole_core.records.field_checks import check_line


@dataclass(frozen=True)
class PersonalNumberKind:
    """A kind of personal numbers.

    Parameters
    ----------
    key
        As it is stored; empty for any text.
    name
        For display.
    check
        Returns the number as it is stored, or raises an `InputError`.
    birth_date
        Returns the birth date that a checked number holds; None where it holds none.
    """

    key: str
    name: str
    check: Callable[[str], str]
    birth_date: Callable[[str], date | None]


MOST_NUMBER: Final = 40
"""Characters of one of any kind."""
_SWEDISH: Final = re.compile(r"(\d{2})?(\d{2})(\d{2})(\d{2})([-+]?)(\d{3})(\d)", re.ASCII)
_COORDINATION: Final = 60
"""Added to the day in a samordningsnummer."""


def check_swedish(text: str) -> str:
    """Return a Swedish personnummer or samordningsnummer as ``YYYYMMDD-NNNN``.

    It may be typed with ten or twelve digits; with ten, ``+`` marks who is over a hundred.
    Source: Skatteverket, SKV 704 and SKV 707.

    Raises
    ------
    InputError
        When digits are missing, its day is not in the calendar, or its last digit does not fit.
    """
    return _check_swedish(text, date.today())


def _check_swedish(text: str, today: date) -> str:
    match = _SWEDISH.fullmatch(re.sub(r"\s", "", text))
    if match is None:
        raise InputError(
            "{text} is no Swedish personal number; write it as YYYYMMDD-NNNN.", text=text[:40]
        )
    century, year, month, day, sign, serial, last = match.groups()
    if _luhn(year + month + day + serial) != int(last):
        raise InputError(
            "The last digit of {text} does not fit the others; compare it with the patient's card.",
            text=text,
        )
    month_day = int(month), int(day) % _COORDINATION
    try:
        full_year = (
            int(century + year) if century else _full_year(int(year), *month_day, sign, today)
        )
        born = date(full_year, *month_day)
    except ValueError:
        raise InputError(
            "{text} holds a day that the calendar does not have; check it.", text=text
        ) from None
    if born > today:
        raise InputError("{text} holds a day in the future; check its year.", text=text)
    return f"{full_year}{month}{day}-{serial}{last}"


def swedish_birth_date(number: str) -> date | None:
    """Return the birth date in a number that `check_swedish` has returned."""
    try:
        return date(int(number[:4]), int(number[4:6]), int(number[6:8]) % _COORDINATION)
    except ValueError:
        return None


def check_any(text: str) -> str:
    """Return a number of an unknown kind.

    Raises
    ------
    InputError
        When it is too long, or holds control characters.
    """
    return check_line(text, "personal number", MOST_NUMBER)


KINDS: Final[Mapping[str, PersonalNumberKind]] = MappingProxyType(
    {
        kind.key: kind
        for kind in (
            PersonalNumberKind("", "Any number", check_any, lambda _: None),
            PersonalNumberKind("se", "Swedish personal number", check_swedish, swedish_birth_date),
        )
    }
)


def check_personal_number(text: str, kind: str) -> str:
    """Return a personal number as it is stored; an empty one stays empty.

    Raises
    ------
    InputError
        When the kind refuses it, or is unknown.
    """
    text = text.strip()
    if not text:
        return ""
    if kind not in KINDS:
        raise InputError("There is no kind of personal number {kind}; choose one.", kind=kind)
    return KINDS[kind].check(text)


def _luhn(digits: str) -> int:
    """Return the check digit of nine digits."""
    doubled = (int(digit) * (2 - place % 2) for place, digit in enumerate(digits))
    return -sum(number // 10 + number % 10 for number in doubled) % 10


def _full_year(year: int, month: int, day: int, sign: str, today: date) -> int:
    """Return the latest year of a birth that ends with two digits; a hundred before with ``+``."""
    full_year = today.year - (today.year - year) % 100
    if (full_year, month, day) > (today.year, today.month, today.day):
        full_year -= 100
    return full_year - 100 if sign == "+" else full_year
