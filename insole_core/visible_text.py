"""Texts of foreign origin, such as names of files and what stands in them, as they may be shown.

A control character in one moves the cursor of a terminal or ends a line of a log; one that turns
the direction of writing makes a name read as another. Here they become the letters ``\\u001b``,
which also JSON writes. `Message` fills in every value so, as does `tr` of the window; readers of
files, and the streams of the command line, call this themselves.
"""

from __future__ import annotations

import logging
import unicodedata
from typing import Final

_DIRECTIONS: Final = frozenset("\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
_UNSEEN: Final = ("Cc", "Cs", "Zl", "Zp")
_LINES: Final = "\n\t"
LONGEST: Final = 1000
"""Characters of a value within a sentence; the middle of a longer one is left out."""


def is_control(character: str) -> bool:
    """Return whether a character cannot be seen, but changes what is seen."""
    return character in _DIRECTIONS or unicodedata.category(character) in _UNSEEN


def visible(text: str) -> str:
    """Return a text without control characters, but for the ends of its lines and tabulators."""
    return text if text.isprintable() else "".join(map(_seen_in_lines, text.replace("\r\n", "\n")))


def visible_line(text: str) -> str:
    """Return a text without any control character, and so in one line."""
    return text if text.isprintable() else "".join(map(_seen, text))


def visible_value(text: str) -> str:
    """Do the same as `visible_line` for a value within a sentence, where a long one is cut."""
    if len(text) > LONGEST:
        text = f"{text[: LONGEST // 2]}…{text[-LONGEST // 2 :]}"
    return visible_line(text)


class VisibleRecord(logging.LogRecord):
    """A line of the log: whatever is filled into it, it stays one line."""

    def getMessage(self) -> str:  # noqa: N802 - the name of logging
        """Return the line."""
        return visible_line(super().getMessage())


def _seen_in_lines(character: str) -> str:
    return character if character in _LINES else _seen(character)


def _seen(character: str) -> str:
    return f"\\u{ord(character):04x}" if is_control(character) else character
