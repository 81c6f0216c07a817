"""How persons are found: by the beginnings of the words of one line of folded text."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator
from datetime import date
from typing import Final

from insole_core.folded_text import fold

MOST_KEY: Final = 80
MOST_WORD: Final = 40
"""Letters of a word that count: an index of any database takes as many."""
_NUMBER: Final = re.compile(r"[./+-]*\d[\d./+-]*")
_FULL_SWEDISH: Final = 12
"""Digits of a personal number with its century."""


def sort_key_of(name: str) -> str:
    """Return what persons are sorted by, and found at once by the beginning of their name.

    It is short enough for an index of any database.
    """
    return " ".join(fold(name).split())[:MOST_KEY]


def name_key_of(name: str) -> str:
    """Return the words of a name in one order: "Berg, Anna" is "Anna Berg"."""
    return " ".join(sorted(fold(name).replace(",", " ").split()))


def search_text_of(
    name: str, birth_date: date | None, personal_number: str, numbers: Iterable[str]
) -> str:
    """Return the text that a person is found by.

    Every word follows a space: a person is found by what stands after one. A word that only
    begins another one is left out.

    Parameters
    ----------
    numbers
        Pseudonym and numbers of orders.
    """
    words = [*_words_of(name), *_writings(birth_date), *_words_of_number(personal_number)]
    for number in numbers:
        words += _words_of(number)
    cut = list(dict.fromkeys(word[:MOST_WORD] for word in words if word))
    longest = [w for w in cut if not any(o.startswith(w) for o in cut if o != w)]
    return "".join(f" {word}" for word in longest)


def search_words(text: str) -> list[str]:
    """Return the words of what somebody typed, as they stand in a search text."""
    words = (_plain(word)[:MOST_WORD] for word in _split(text))
    return list(dict.fromkeys(word for word in words if word))


def _words_of(text: str) -> Iterator[str]:
    """Yield the words of a text, and what follows a sign within one, as in "Berg-Lund"."""
    for word in _split(text):
        for start in _starts(word):
            yield _plain(word[start:])


def _split(text: str) -> list[str]:
    """Return the folded words of a text: "Berg, Anna" has two, and no comma."""
    return fold(text).replace(",", " ").replace(";", " ").split()


def _starts(word: str) -> Iterator[int]:
    """Yield where somebody may begin to type a word.

    That is at any letter of a script that writes no spaces, or has its article before the word.
    """
    for index, letter in enumerate(word[:MOST_WORD]):
        follows_sign = index > 0 and letter.isalnum() and not word[index - 1].isalnum()
        if index == 0 or follows_sign or unicodedata.category(letter) == "Lo":
            yield index


def _plain(word: str) -> str:
    """Return the digits alone of a date or number, and any other word as it is.

    In a date as 8.2.1970, days and months get two digits.
    """
    if _NUMBER.fullmatch(word) is None:
        return word
    *first, last = re.split(r"[./]", word)
    return re.sub(r"\D", "", "".join([*(part.rjust(2, "0") for part in first), last]))


def _words_of_number(number: str) -> Iterator[str]:
    """Yield the words of a personal number, all of it in one, and that without its century."""
    joined = "".join(letter for letter in fold(number) if letter.isalnum())
    yield joined
    if len(joined) == _FULL_SWEDISH and joined.isdecimal():
        yield joined[2:]
    yield from _words_of(number)


def _writings(day: date | None) -> list[str]:
    """Return the digits of a date as it is written in Sweden, short, and in other countries."""
    return [] if day is None else [day.strftime(form) for form in ("%Y%m%d", "%y%m%d", "%d%m%Y")]
