"""The words of a name by which a text is known to hold it."""

from __future__ import annotations

import re
from collections.abc import Set
from typing import Final

WORD: Final = re.compile(r"[^\W\d_]+")
"""Letters alone."""


def identifying_words(name: str) -> Set[str]:
    """Return the surnames of "Anna Berg" or "Berg, Anna", folded; the name alone where it is all.

    A first name beside a surname identifies hardly anybody, and Eva is also a material. Initials
    are none.
    """
    before, comma, after = name.partition(",")
    parts = words_in(name)
    surnames = words_in(before) if comma and words_in(after) else parts[1:]
    long = {word for word in surnames if len(word) > 1}
    return long or set(parts) - set(surnames)


def words_in(text: str) -> list[str]:
    """Return the words of a text, folded."""
    return WORD.findall(text.casefold())


def holds_any(text: str, words: Set[str]) -> bool:
    """Return whether a text holds one of some folded words."""
    return not words.isdisjoint(words_in(text))
