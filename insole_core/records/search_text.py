"""How persons are found: by words of one line of folded text."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from datetime import date
from typing import Final

MOST_KEY: Final = 80
_LETTERS = str.maketrans({"ø": "o", "ł": "l", "đ": "d", "æ": "ae", "œ": "oe", "ı": "i"})
"""Letters that Unicode does not take apart into a base letter and an accent."""


def fold(text: str) -> str:
    """Return a text without case and accents, so that "Ångström" is found by "angstrom"."""
    apart = unicodedata.normalize("NFKD", text.casefold())
    plain = "".join(letter for letter in apart if not unicodedata.combining(letter))
    return plain.translate(_LETTERS)


def sort_key_of(name: str) -> str:
    """Return what persons are sorted by, and found at once by the beginning of their name.

    It is short enough for an index of any database.
    """
    return " ".join(fold(name).split())[:MOST_KEY]


def search_text_of(
    name: str, birth_date: date | None, personal_number: str, numbers: Iterable[str]
) -> str:
    """Return the text that a person is found by; the name comes first.

    Every word follows a space, so that one that begins with what was typed is told from one that
    only holds it.

    Parameters
    ----------
    numbers
        Pseudonym and numbers of orders.
    """
    words = [" ".join(fold(name).split()), *_writings(birth_date)]
    digits = "".join(c for c in personal_number if c.isalnum())
    words += [fold(personal_number), fold(digits)] if personal_number else []
    words += [fold(number) for number in numbers]
    return f" {' '.join(dict.fromkeys(word for word in words if word))}"


def search_words(text: str) -> list[str]:
    """Return the words of what somebody typed, as they stand in a search text."""
    return list(dict.fromkeys(fold(text).split()))


def _writings(day: date | None) -> list[str]:
    """Return a date as it is written in Sweden and Britain, in Germany, and in one row."""
    if day is None:
        return []
    forms = ("%Y-%m-%d", "%Y%m%d", "%d.%m.%Y", "%d/%m/%Y")
    return [day.strftime(form) for form in forms]
