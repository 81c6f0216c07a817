"""Random designs with zones through the real PrusaSlicer: without repair, and zones obeyed.

python -m benchmarks.slicing [number of designs] [number of those whose zones are measured]
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks._printed_density import BED_MM, sliced
from benchmarks._random_designs import DESIGNS_PER_FOOT, random_design, random_foot
from insole_core.export.slicer_3mf import Infill, write_slicer_3mf
from insole_core.insole.build import build_insole
from insole_core.solids.export_job import standing
from insole_core.solids.export_rules import read_rules
from insole_core.solids.order import Order, make_part
from insole_core.solids.print_zones import PrintPlan, Zone
from insole_core.solids.zone_bodies import placed_print, zoned_part

_WITHIN = 0.15


def main() -> None:
    designs = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    measured = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    rng = np.random.default_rng(0)
    rules = read_rules()
    faulty, obeyed, boxes, worst = 0, 0, 0, 0.0
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "insole.3mf"
        for number in range(designs):
            if number % DESIGNS_PER_FOOT == 0:
                foot = random_foot(number)
            design = random_design(foot, rng)
            if number < measured:
                design = replace(design, thickness_mm=10.0, bottom="flat")
            part = make_part(build_insole(foot, design), Order(), rules)
            heel, arch = (float(rng.uniform(*limits)) for limits in ((10, 25), (30, 60)))
            zones = (Zone("heel", Infill(heel, "grid")), Zone("arch", Infill(arch, "grid")))
            plan = PrintPlan(2, 3, 3, Infill(20, "grid"), zones)
            printed = placed_print(zoned_part(part, plan).printed, standing(part.solid))
            write_slicer_3mf([printed], path, "prusaslicer")
            result = sliced(path, Path(folder))
            if result is None:
                raise SystemExit("the program prusa-slicer is not installed")
            faulty += bool(result.complaints)
            for said in result.complaints:
                print(f"design {number}: {said}")
            if number >= measured:
                continue
            middle = part.solid.bounds_mm.mean(axis=0)[:2]
            for share, asked in ((0.15, heel), (0.45, arch)):
                at = np.array([0.0, share * foot.length_mm]) - middle + BED_MM / 2
                density = result.density_percent([*(at - 9), 2.0], [*(at + 9), 6.0])
                away = abs(density / asked - 1)
                boxes, obeyed, worst = boxes + 1, obeyed + (away <= _WITHIN), max(worst, away)
            print(f"design {number}: {obeyed} of {boxes} zones obeyed, worst {worst:.1%} away")
    print(f"{designs} designs, {faulty} with complaints; {obeyed} of {boxes} zones obeyed")


if __name__ == "__main__":
    main()
