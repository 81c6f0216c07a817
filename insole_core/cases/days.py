"""Days in a patient's record: a birth date and a visit that the calendar has."""

from __future__ import annotations

from datetime import date, timedelta

from insole_core.cases.case_record import Patient
from insole_core.cases.written_dates import AmbiguousDate, read_date
from insole_core.errors import InputError
from insole_core.messages import Message, joined

DAY_FIELDS = ("born", "visit")
EARLIEST = date(1900, 1, 1)
LATEST_AHEAD = timedelta(days=366)
"""How far ahead a visit may be planned."""
_NAMES = {"born": "birth date", "visit": "date of the visit"}


def read_day(key: str, text: str, today: date) -> str:
    """Return a day as ISO 8601, written in any way that has one reading; empty if empty.

    Parameters
    ----------
    key
        "born" or "visit"; a birth date is not in the future, a visit at most a year ahead.

    Raises
    ------
    InputError
        If it is no day of the calendar, or not one that this field can have.
    """
    text = text.strip()
    if not text:
        return ""
    try:
        day = read_date(text, None)
    except AmbiguousDate as error:
        raise InputError(
            "{text} can be {first} or {second}; write the one that is meant.",
            **error.message.values,
        ) from error
    latest = today if key == "born" else today + LATEST_AHEAD
    if not EARLIEST <= day <= latest:
        raise InputError(
            "{text} is not between {first} and {last}; check the year.",
            text=text,
            first=EARLIEST.isoformat(),
            last=latest.isoformat(),
        )
    return day.isoformat()


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
