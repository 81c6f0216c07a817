"""Numbers in whole steps."""

from __future__ import annotations


def rounded(value: float, step: float) -> float:
    """Return the nearest whole multiple of `step`, free of the last bits of its product."""
    return round(round(value / step) * step, 6)
