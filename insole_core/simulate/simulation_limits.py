"""Which numbers can be simulated."""

from __future__ import annotations

from collections.abc import Mapping

from insole_core.errors import UsageError

Limits = Mapping[str, tuple[str, float, float]]
"""Attribute -> what it is called, least and greatest value."""


def check_limits(values: object, limits: Limits) -> None:
    """Compare the attributes of an object with their limits.

    Raises
    ------
    UsageError
        Names the first attribute that is out of range (or NaN).
    """
    for attribute, (words, low, high) in limits.items():
        value = getattr(values, attribute)
        if not low <= value <= high:
            raise UsageError(
                "The {what} cannot be {value:g}; choose a value from {least:g} to {most:g}.",
                what=words,
                value=value,
                least=low,
                most=high,
            )
