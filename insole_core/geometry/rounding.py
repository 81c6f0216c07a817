"""Round numbers to multiples of a step."""

from __future__ import annotations


def rounded(value: float, step: float) -> float:
    """Return the nearest multiple of `step`, without the floating-point error of the product."""
    return round(round(value / step) * step, 6)
