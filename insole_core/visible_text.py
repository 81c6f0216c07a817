"""Texts of foreign origin, such as names of files and what stands in them, as they may be shown.

A control character in one moves the cursor of a terminal or ends a line of a log; one that turns
the direction of writing makes a name read as another. Here they become the letters ``\\u001b``,
which also JSON writes. `Message` fills in every value so, as does `tr` of the window; readers of
files, and the streams of the command line, call this themselves.
"""

from __future__ import annotations

import logging
import re
from typing import Final

_CONTROL: Final = re.compile("[\0-\x1f\x7f-\x9f\ud800-\udfff\u2028-\u202e\u2066-\u2069]")
"""Unicode's controls and surrogates (Cc, Cs), ends of lines and paragraphs, and directions."""
_CONTROL_IN_LINES: Final = re.compile(f"(?![\n\t]){_CONTROL.pattern}")
LONGEST: Final = 1000
"""Characters of a value within a sentence; the middle of a longer one is left out."""


def is_control(character: str) -> bool:
    """Return whether a character cannot be seen, but changes what is seen."""
    return _CONTROL.fullmatch(character) is not None


def visible(text: str) -> str:
    """Return a text without control characters, but for the ends of its lines and tabulators."""
    return _CONTROL_IN_LINES.sub(_seen, text.replace("\r\n", "\n"))


def visible_line(text: str) -> str:
    """Return a text without any control character, and so in one line."""
    return _CONTROL.sub(_seen, text)


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


def _seen(control: re.Match[str]) -> str:
    return f"\\u{ord(control[0]):04x}"
