"""What a field of the record may hold; each check returns the value as it is stored.

The windows call them while a field is filled in, the record calls them again before it writes.
"""

from __future__ import annotations

import unicodedata
from datetime import date
from typing import Final

from insole_core.cases.days import EARLIEST
from insole_core.errors import InputError
from insole_core.visible_text import is_control

MOST_NAME: Final = 200
"""Characters of a name, of a shop, of a short text."""
MOST_TEXT: Final = 20_000
"""Characters of a text of several lines."""
_LINE_BREAKS: Final = "\n\t"


def check_name(text: str, what: str = "name", most: int = MOST_NAME) -> str:
    """Return a name without spaces around it, in the composed form of its letters.

    Parameters
    ----------
    what
        Of the field, for the sentence.

    Raises
    ------
    InputError
        When it is empty, too long, or holds control characters.
    """
    text = check_line(text, what, most)
    if not text:
        raise InputError("The {what} is missing; type one.", what=what)
    return text


def check_line(text: str, what: str, most: int = MOST_NAME) -> str:
    """Do the same as `check_name` for a text of one line that may be empty."""
    return _checked(text, what, most, "")


def check_text(text: str, what: str, most: int = MOST_TEXT) -> str:
    """Do the same as `check_line` for a text of several lines."""
    return _checked(text.replace("\r\n", "\n").replace("\r", "\n"), what, most, _LINE_BREAKS)


def check_day(day: date | None, what: str, today: date) -> date | None:
    """Return another day, such as that of a consent or when an order is due; None is unknown.

    Raises
    ------
    InputError
        When it is far from today.
    """
    return check_between(day, EARLIEST, today.replace(year=today.year + 10, day=1), what)


def check_between(day: date | None, first: date, last: date, what: str) -> date | None:
    """Return a day between two others; None is unknown.

    Raises
    ------
    InputError
        When it is outside.
    """
    if day is None or first <= day <= last:
        return day
    raise InputError(
        "The {what} {day} is not between {first} and {last}; check the year.",
        what=what,
        day=day.isoformat(),
        first=first.isoformat(),
        last=last.isoformat(),
    )


def check_number(value: float | None, what: str, least: float, most: float) -> float | None:
    """Return a number between two limits; None is unknown.

    Raises
    ------
    InputError
        When it is outside, or not a number.
    """
    if value is None or least <= value <= most:
        return value
    raise InputError(
        "The {what} must be between {least:g} and {most:g}, not {value:g}.",
        what=what,
        least=least,
        most=most,
        value=value,
    )


def _checked(text: str, what: str, most: int, allowed: str) -> str:
    if len(text) > most:
        raise InputError(
            "The {what} has {count} characters, and may have {most}; shorten it.",
            what=what,
            count=len(text),
            most=most,
        )
    text = unicodedata.normalize("NFC", text).strip()
    wrong = next((c for c in text if c not in allowed and is_control(c)), None)
    if wrong is not None:
        raise InputError(
            "The {what} holds a character that cannot be seen (U+{code}) after “{before}”; delete "
            "it.",
            what=what,
            code=f"{ord(wrong):04X}",
            before=text[: text.index(wrong)][-20:],
        )
    return text
