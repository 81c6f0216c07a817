"""The ticks of a chart's rulers: round millimetres that leave room for their numbers."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

STEPS_MM = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)
LEAST_TICK_PX = 28.0


def chart_ticks(
    low_mm: float, high_mm: float, px_per_mm: float, least_px: float = LEAST_TICK_PX
) -> Iterator[float]:
    """Yield the ticks between two values.

    Parameters
    ----------
    px_per_mm
        Scale of the ruler.
    least_px
        Least distance of two ticks.
    """
    wide_enough = (step for step in STEPS_MM if step * px_per_mm >= least_px)
    step = next(wide_enough, STEPS_MM[-1])
    first = int(np.ceil(low_mm / step))
    return (number * step for number in range(first, int(np.floor(high_mm / step)) + 1))
