"""Which height or depth of a pad changes the pressure in a region as much as is asked."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from insole_core.contact.change import Assumptions, Change, Loading, Told
from insole_core.contact.stance import Ground
from insole_core.insole.elements import Pelott
from insole_core.insole.fields import ranges_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.progress import SILENT, Progress

_DOSES, _USUAL_MM, _BEYOND = 7, 8.0, 1.5
"""Number of doses, and how far they reach: usually, and beyond that of the design."""


@dataclass(frozen=True)
class DoseCurve:
    """Change of the peak pressure in a region by the height of a pad.

    Parameters
    ----------
    doses_mm
        From none on; negative for a recess.
    percents
        Of each dose.
    """

    doses_mm: tuple[float, ...]
    percents: tuple[float, ...]

    @property
    def span(self) -> tuple[float, float]:
        """The least and the greatest change of all doses."""
        return min(self.percents), max(self.percents)

    def is_within(self, told: Told) -> bool:
        """Return whether the doses differ by less than what is told of one of them is sure to."""
        if told.limits is None:
            return False
        low, high = told.limits
        least, greatest = self.span
        return greatest - least < (high - low) / 2

    def reaching(self, percent: float) -> float | None:
        """Return the smallest dose with a change; None if no dose of the curve has it."""
        for (low, before), (high, after) in pairwise(
            zip(self.doses_mm, self.percents, strict=True)
        ):
            if min(before, after) <= percent <= max(before, after):
                share = 0.0 if after == before else (percent - before) / (after - before)
                return low + share * (high - low)
        return None


@dataclass(frozen=True)
class Dose:
    """The dose that has a change, and what is told of the region with it.

    Parameters
    ----------
    height_mm
    told
        The limits are those of this height, or the reason why there are none is.
    """

    height_mm: float
    told: Told


def dosed(design: InsoleDesign, pad: Pelott) -> list[tuple[float, InsoleDesign]]:
    """Return doses of a pad of a design, and the design with each; the first is without it."""
    heights = ranges_of(Pelott)["height_mm"]
    most = max(_USUAL_MM, _BEYOND * abs(pad.height_mm))
    end = min(most, heights.greatest) if pad.height_mm >= 0 else max(-most, heights.least)
    doses = [float(dose) for dose in np.linspace(0.0, end, _DOSES)[1:]]
    return [(dose, with_dose(design, pad, dose)) for dose in (0.0, *doses)]


def with_dose(design: InsoleDesign, pad: Pelott, height_mm: float) -> InsoleDesign:
    """Return a design with a height of one of its pads; without the pad if that is 0."""
    if height_mm == 0:
        return design.with_removed(pad.id)
    return design.with_changed(replace(pad, height_mm=height_mm))


def dose_curve(
    loading: Loading,
    known: Change,
    grounds: Iterable[tuple[float, Ground]],
    region: str,
    progress: Progress = SILENT,
    *,
    assumed: Assumptions | None = None,
) -> DoseCurve | None:
    """Compute the change in a region by the dose.

    Parameters
    ----------
    known
        With these assumptions, whose old pressures are compared with.
    grounds
        Doses in mm, and what the foot stands on with each.
    region
        One of `GROUPS`.
    assumed
        By default those for anybody.

    Returns
    -------
    DoseCurve or None
        None where nothing pressed in the region before.

    Raises
    ------
    InputError
        When no pressure on the sole has the centre of the posture.
    Cancelled
    """
    doses: list[float] = []
    percents: list[float] = []
    pressed = known.new
    for dose, ground in grounds:
        progress.step(min(len(doses) / _DOSES, 1.0), "Loading the foot")
        pressed = loading.pressed(ground, assumed or Assumptions(), pressed)
        new = replace(known, grounds=(known.grounds[0], ground), new=pressed)
        percent = new.of(region).peak_percent
        if percent is None:
            return None
        doses.append(dose)
        percents.append(percent)
    return DoseCurve(tuple(doses), tuple(percents))
