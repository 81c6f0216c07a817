"""Names of any script in the letters that the product's own font has."""

from __future__ import annotations

import unicodedata
from functools import cache
from pathlib import Path

from arabic_reshaper import reshape
from bidi import get_display

_UNKNOWN = "?"


@cache
def font_path() -> Path:
    """Where DejaVu Sans lies: Latin, Greek, Cyrillic, Hebrew, Arabic and more."""
    from matplotlib import get_data_path  # it brings the font; importing it takes long

    return Path(get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf"


@cache
def _letters() -> frozenset[int]:
    from matplotlib.font_manager import get_font  # as above

    return frozenset(get_font(font_path()).get_charmap())


def with_known_letters(text: str) -> str:
    """Give a text in letters that the font has; "?" stands for one that has no likeness there.

    Accents that the font lacks are dropped; control characters become blanks.
    """
    return "".join(_known(letter) for letter in unicodedata.normalize("NFC", text)).strip()


def missing_letters(text: str) -> str:
    """Give the letters of a text that the font lacks, each once, in order."""
    letters = dict.fromkeys(unicodedata.normalize("NFC", text))
    return "".join(
        letter
        for letter in letters
        if not unicodedata.category(letter).startswith("C") and ord(letter) not in _letters()
    )


def as_written(text: str) -> str:
    """Put known letters into the order and forms in which they stand on paper, left to right.

    For writers that draw letter by letter; Arabic letters are joined, lines that run from the right
    are turned.
    """
    return str(get_display(reshape(with_known_letters(text))))


def _known(letter: str) -> str:
    if unicodedata.category(letter).startswith("C"):
        return " "
    if ord(letter) in _letters():
        return letter
    bare = "".join(c for c in unicodedata.normalize("NFKD", letter) if ord(c) in _letters())
    return bare or _UNKNOWN
