"""Names of devices and forms, and the keys by which they are found and stored."""

from __future__ import annotations

from insole_core.errors import DesignError

MOST_CHARACTERS = 60


def key_of(name: str) -> str:
    """Return a name as one word: ``"EVA, full length"`` becomes ``"eva-full-length"``."""
    letters = "".join(c if c.isalnum() else " " for c in name.casefold())
    return "-".join(letters.split())


def checked_name(name: str) -> str:
    """Return a name without spaces around it.

    Raises
    ------
    DesignError
        If it is too long, or has neither letter nor digit.
    """
    name = name.strip()
    if not key_of(name) or len(name) > MOST_CHARACTERS:
        raise DesignError(
            "A name must have 1 to {most} characters, and a letter or a digit among them; type "
            "another one.",
            most=MOST_CHARACTERS,
        )
    return name
