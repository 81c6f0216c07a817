"""Left and right foot, and the signs that follow from the side."""

from __future__ import annotations

from enum import StrEnum
from typing import Final, Literal


class Side(StrEnum):
    """Which foot. In the reference and insole frames +x points to the patient's right."""

    LEFT = "left"
    RIGHT = "right"

    @property
    def medial_sign(self) -> int:
        """Sign of x on the medial side (the side of the big toe): +1 left, -1 right."""
        return 1 if self is Side.LEFT else -1

    @property
    def other(self) -> Side:
        """The other foot."""
        return Side.RIGHT if self is Side.LEFT else Side.LEFT


BOTH: Final = "both"
"""In the place of a side: both feet, in one capture."""
Sides = Side | Literal["both"]


def sides_from(word: str) -> Sides:
    """Return the side, or both, of the word in a file or an argument."""
    return BOTH if word == BOTH else Side(word)
