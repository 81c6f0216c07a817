"""Days in a patient's record: a birth date and a visit that the calendar has."""

from __future__ import annotations

import re
from datetime import date, timedelta
from itertools import product
from typing import Final

from insole_core.cases.case_record import Patient
from insole_core.cases.written_dates import AmbiguousDate, read_date
from insole_core.errors import InputError
from insole_core.messages import Message, Value, joined

DAY_FIELDS = ("born", "visit")
EARLIEST = date(1900, 1, 1)
LATEST_AHEAD = timedelta(days=366)
"""How far ahead a visit may be planned."""
_SHORT: Final = re.compile(r"(\d{2})([-./ ]?)(\d{2})\2(\d{2})", re.ASCII)
"""A date whose year has two digits, such as the first six of a Swedish personal number."""
_NAMES = {"born": "birth date", "visit": "date of the visit"}


def read_day(key: str, text: str, today: date) -> str:
    """Return a day as ISO 8601, written in any way that has one reading; empty if empty.

    Parameters
    ----------
    key
        "born" or "visit"; a birth date is not in the future, a visit at most a year ahead. The year
        of a birth date may have two digits where only one century is possible.

    Raises
    ------
    InputError
        If it is no day of the calendar, or not one that this field can have.
    """
    text = text.strip()
    if not text:
        return ""
    short = _short_readings(text, today) if key == "born" else []
    try:
        day, *others = short or [read_date(text, None)]
    except AmbiguousDate as error:
        raise _two_readings(**error.message.values) from error
    if others:
        raise _several_readings(text, short)
    latest = today if key == "born" else today + LATEST_AHEAD
    if not EARLIEST <= day <= latest:
        raise InputError(
            "{text} is not between {first} and {last}; check the year.",
            text=text,
            first=EARLIEST.isoformat(),
            last=latest.isoformat(),
        )
    return day.isoformat()


def _short_readings(text: str, today: date) -> list[date]:
    """Return the birth dates that one whose year has two digits can mean; empty for another one.

    Those that have the year first, as personal numbers have, come first, and of these the latest.
    """
    match = _SHORT.fullmatch(text)
    if match is None:
        return []
    first, mark, second, third = map(str, match.groups())
    day_first = third, second, first  # with dots everywhere, as `read_date` has it
    orders = (
        (day_first,) if mark == "." else ((first, second, third), day_first, (third, first, second))
    )
    centuries = range(today.year // 100, EARLIEST.year // 100 - 1, -1)
    found: dict[date, None] = {}
    for (year, month, day), century in product(orders, centuries):
        try:
            born = date(100 * century + int(year), int(month), int(day))
        except ValueError:
            continue
        if EARLIEST <= born <= today:
            found[born] = None
    return list(found)


def _several_readings(text: str, readings: list[date]) -> InputError:
    days = [day.isoformat() for day in readings]
    if len(days) == 2:
        return _two_readings(text=text, first=days[0], second=days[1])
    return InputError(
        "{text} can be {days}; write the one that is meant.", text=text, days=joined(days)
    )


def _two_readings(**values: Value) -> InputError:
    return InputError("{text} can be {first} or {second}; write the one that is meant.", **values)


def doubtful_days(patient: Patient, today: date) -> str:
    """Return a sentence for each date of a patient that cannot be right; empty if all are."""
    sentences = []
    for key in DAY_FIELDS:
        try:
            read_day(key, getattr(patient, key), today)
        except InputError as error:
            sentences.append(
                Message(
                    "The {what} cannot be right: {reason}", what=_NAMES[key], reason=error.message
                )
            )
    return joined(sentences, " ") if sentences else ""
