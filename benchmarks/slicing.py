"""Random designs with zones through the real PrusaSlicer: without repair, and zones obeyed.

python -m benchmarks.slicing [number of designs] [of which zones are measured] [number of the first]

A design depends on its number alone, so that a long run may be made in pieces: `40 0 120` takes the
designs 120 to 159, of which none below 0 is measured.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from benchmarks._printed_density import BED_MM, sliced
from benchmarks._random_designs import DESIGNS_PER_FOOT, random_design, random_foot
from insole_core.errors import InsoleError
from insole_core.foot.foot import Foot
from insole_core.formats.slicer_3mf import Infill, write_slicer_3mf
from insole_core.insole.build import build_insole
from insole_core.solids.export_job import standing
from insole_core.solids.export_rules import read_rules
from insole_core.solids.order import Order, make_part
from insole_core.solids.print_zones import PrintPlan, Zone
from insole_core.solids.zone_bodies import placed_print, zoned_part

_WITHIN = 0.15


@dataclass(frozen=True)
class Outcome:
    """What the slicer said of a design, and how far each measured zone is from what was asked."""

    complaints: tuple[str, ...]
    away: tuple[float, ...] = ()


def main() -> None:
    """Slice the designs, and print a line of each and of all."""
    designs, measured, first = (
        int(sys.argv[place]) if len(sys.argv) > place else usual
        for place, usual in ((1, 200), (2, 20), (3, 0))
    )
    outcomes = []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(first, first + designs):
            if number == first or number % DESIGNS_PER_FOOT == 0:
                foot = random_foot(number - number % DESIGNS_PER_FOOT)
            outcome = _outcome(number, foot, Path(folder), is_measured=number < measured)
            outcomes.append(outcome)
            said = "; ".join(outcome.complaints) or "no complaint"
            away = "".join(f", a zone {share:.1%} away" for share in outcome.away)
            print(f"design {number}: {said}{away}", flush=True)
    deviations = [share for outcome in outcomes for share in outcome.away]
    faulty = sum(bool(outcome.complaints) for outcome in outcomes)
    obeyed = sum(share <= _WITHIN for share in deviations)
    print(
        f"designs {first} to {first + designs - 1}: {faulty} with complaints; {obeyed} of "
        f"{len(deviations)} zones obeyed, worst {max(deviations, default=0):.1%} away"
    )


def _outcome(number: int, foot: Foot, folder: Path, *, is_measured: bool) -> Outcome:
    rng = np.random.default_rng([0, number])
    design = random_design(foot, rng)
    if is_measured:
        design = replace(design, thickness_mm=10.0, bottom="flat")
    asked = [float(rng.uniform(*limits)) for limits in ((10, 25), (30, 60))]
    zones = (Zone("heel", Infill(asked[0], "grid")), Zone("arch", Infill(asked[1], "grid")))
    plan = PrintPlan(2, 3, 3, Infill(20, "grid"), zones)
    path = folder / "insole.3mf"
    try:
        part = make_part(build_insole(foot, design), Order(), read_rules())
        printed = placed_print(zoned_part(part, plan).printed, standing(part.solid))
    except InsoleError as error:
        return Outcome((f"not made: {error}",))
    write_slicer_3mf([printed], path, "prusaslicer")
    result = sliced(path, folder)
    if result is None:
        raise SystemExit("the program prusa-slicer is not installed")
    if not is_measured:
        return Outcome(result.complaints)
    middle = part.solid.bounds_mm.mean(axis=0)[:2]
    away = []
    for share, percent in zip((0.15, 0.45), asked, strict=True):
        at = np.array([0.0, share * foot.length_mm]) - middle + BED_MM / 2
        density = result.density_percent(_corner(at - 9, 2.0), _corner(at + 9, 6.0))
        away.append(abs(density / percent - 1))
    return Outcome(result.complaints, tuple(away))


def _corner(at: Sequence[float], height_mm: float) -> list[float]:
    return [*at, height_mm]


if __name__ == "__main__":
    main()
