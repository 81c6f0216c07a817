"""How values are said, on paper and in lists, in a message that can be translated."""

from __future__ import annotations

from typing import Any

from insole_core.insole.fields import Angle, Choice, Declared, Number
from insole_core.messages import Message, joined

DECIMALS = 1
"""The least precision: that of the window's fields."""


def number_message(value: float, decimals: int = DECIMALS) -> Message:
    """Return the same number to be translated: with the decimal sign of the language."""
    return Message("{number:.12g}", number=round(value, decimals) + 0.0)  # never -0


def mm_message(value: float) -> Message:
    """Return a number of mm with its unit."""
    return Message("{number} mm", number=number_message(value))


def raised_message(angle_deg: float, decimals: int = DECIMALS) -> Message:
    """Say which edge an angle raises, and by how much."""
    angle = number_message(abs(angle_deg), decimals)
    if angle == "0":
        return Message("0°")
    if angle_deg > 0:
        return Message("{angle}° medial", angle=angle)
    return Message("{angle}° lateral", angle=angle)


def worded(found: Declared, value: Any, least_decimals: int = DECIMALS) -> Message:
    """Say a number, a pair of numbers, or a choice, with its unit.

    Parameters
    ----------
    least_decimals
        To which a number is rounded, if the window does not show more.
    """
    if isinstance(found, Choice):
        return Message(found.words.get(value, value))
    decimals = max(least_decimals, found.decimals) if isinstance(found, Number) else least_decimals
    if isinstance(found, Angle) and found.raises:
        return raised_message(value, decimals)
    if isinstance(found, Number):
        return Message(found.said, value=number_message(found.factor * value, decimals))
    if isinstance(value, tuple):
        both = joined((number_message(one, decimals) for one in value), " × ")
        return Message("{number} mm", number=both)
    return Message(value)


def duration_message(minutes: float) -> Message:
    """Say a time to whole minutes, in hours and minutes from an hour on."""
    hours, rest = divmod(max(round(minutes), 1), 60)
    if hours == 0:
        return Message("{minutes} min", minutes=rest)
    return Message("{hours} h {minutes} min", hours=hours, minutes=rest)
