"""Text of any script, limited to the glyphs of the font used on paper and in solids."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from arabic_reshaper import reshape
from bidi import get_display

from insole_core.messages import Message

_UNKNOWN = "?"
_MOST_SHOWN = 20


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
    """Replace characters that the font lacks.

    Accents that the font lacks are dropped, control characters become spaces, and characters
    without a substitute become "?".
    """
    return "".join(_known(letter) for letter in unicodedata.normalize("NFC", text)).strip()


def missing_letters(text: str) -> str:
    """Return the characters of a text that the font lacks, each once, in order."""
    if text.isascii():
        return ""  # without loading the font
    letters = dict.fromkeys(unicodedata.normalize("NFC", text))
    return "".join(
        letter
        for letter in letters
        if not unicodedata.category(letter).startswith("C") and ord(letter) not in _letters()
    )


def letters_note(texts: Iterable[str]) -> Message | None:
    """Say before printing which letters of texts no paper can show; None if it has them all."""
    missing = missing_letters("".join(texts))
    if not missing:
        return None
    return Message(
        "The font of the papers has no letters {missing}, and “?” is printed for them; write the "
        "name or the text in Latin letters too.",
        missing=missing[:_MOST_SHOWN],
    )


def as_written(text: str) -> str:
    """Return known characters in visual order and form, left to right.

    For writers that draw character by character: Arabic letters are joined, right-to-left text is
    reversed.
    """
    return str(get_display(reshape(with_known_letters(text))))


def _known(letter: str) -> str:
    if unicodedata.category(letter).startswith("C"):
        return " "
    if ord(letter) in _letters():
        return letter
    bare = "".join(c for c in unicodedata.normalize("NFKD", letter) if ord(c) in _letters())
    return bare or _UNKNOWN
