"""The ranges of values that can be simulated."""

from __future__ import annotations

from collections.abc import Mapping

from insole_core.errors import UsageError

Limits = Mapping[str, tuple[str, float, float]]
"""Attribute -> description, least and greatest value."""


def check_limits(values: object, limits: Limits) -> None:
    """Check the attributes of an object against their limits.

    Parameters
    ----------
    values
        Any object that has the attributes; one that is None is not checked.
    limits
        Both ends are included.

    Raises
    ------
    UsageError
        Names the first attribute that is out of range or NaN.
    """
    for attribute, (words, low, high) in limits.items():
        value = getattr(values, attribute)
        if value is not None and not low <= value <= high:
            raise UsageError(
                "The {what} cannot be {value:g}; choose a value from {least:g} to {most:g}.",
                what=words,
                value=value,
                least=low,
                most=high,
            )
