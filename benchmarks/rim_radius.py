"""The radius of rounded rims, measured from the STL of 40 insoles every 5 mm.

    python -m benchmarks rim_radius

Limit: within 15 % of the radius asked for, or of half of the thickness where that is less.
"""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks._measure import print_table
from benchmarks._random_designs import DESIGNS_PER_FOOT, random_foot
from benchmarks._rim_sections import rim_sections
from insole_core.formats.stl import write_stl
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device
from insole_core.solids.solid import insole_solid
from insole_core.workflows.clinic_devices import clinic_devices

_SOLIDS = 40
_GRIDS_MM = (1.0, 1.0, 0.5, 2.0)


def main() -> None:
    """Measure all insoles, and print a line of each and of all."""
    devices = clinic_devices(Path("/nowhere")).load().items
    shells = {key: device for key, device in devices.items() if device.values.shell is not None}
    rng = np.random.default_rng(9)
    rows, missed, measured = [], 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for number in range(_SOLIDS):
            if number % DESIGNS_PER_FOOT == 0:
                foot = random_foot(3000 + number)
            key = list(shells)[number % len(shells)]
            grid_mm = _GRIDS_MM[number % len(_GRIDS_MM)]
            design = apply_device(shells[key], InsoleDesign(foot.side, grid_mm=grid_mm))
            assert design.shell is not None, "chosen so"
            asked_mm = design.shell.edge_radius_mm
            if number >= len(shells):
                asked_mm = float(rng.choice([0.5, 0.75, 1.0, 1.25, 1.5]))
            shell = replace(design.shell, edge_radius_mm=asked_mm)
            design = replace(design, shell=shell)
            path = Path(folder) / "insole.stl"
            write_stl(insole_solid(build_insole(foot, design)), path)
            sections = list(rim_sections(path, asked_mm))
            radii = np.array([section.radius_mm for section in sections])
            off = sum(not section.is_asked(asked_mm) for section in sections)
            missed, measured = missed + off, measured + len(sections)
            low, middle, high = np.quantile(radii, [0, 0.5, 1])
            rows.append([number, key, f"{grid_mm:g}", f"{asked_mm:g}", f"{low:.2f}",
                         f"{middle:.2f}", f"{high:.2f}", f"{off} of {len(sections)}"])  # fmt: skip
    print_table(
        ["insole", "device", "grid", "asked mm", "least", "median", "greatest", "missed"], rows
    )
    print(f"{missed} of {measured} sections of {_SOLIDS} insoles are off by more than 15 %")
