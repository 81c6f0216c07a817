"""Density and mass of printed zones: what the window tells, beside the G-code of PrusaSlicer.

    python -m benchmarks printed_density

Ten designs of all devices with zones by their presets. Limit: the mass of each design, and of each
zone of at least a tenth of it, within 5 % of what the slicer lays down.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.path import Path as PlanPath

from benchmarks._measure import print_table
from benchmarks._printed_density import BED_MM, sliced
from benchmarks._random_designs import random_foot
from insole_core.formats.slicer_3mf import PrintedPart, write_slicer_3mf
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device
from insole_core.solids.export_job import standing
from insole_core.solids.export_rules import read_rules
from insole_core.solids.order import Order, make_part
from insole_core.solids.print_density import printed_densities
from insole_core.solids.print_presets import read_print_presets
from insole_core.solids.print_zones import plan_of
from insole_core.solids.simplification import to_manifold
from insole_core.solids.zone_bodies import placed_print, zoned_part
from insole_core.workflows.clinic_devices import clinic_devices

_DESIGNS = (
    ("functional-three-quarter", "PA12", 60), ("functional-three-quarter", "TPU, Shore 95", 95),
    ("ucbl-child", "PETG", 60), ("ucbl-child", "TPU, Shore 85", 75),
    ("dress-three-quarter", "PA12", 100), ("sport-full-length", "PETG", 75),
    ("sport-full-length", "TPU, Shore 95", 60), ("eva-full-length", "TPU, Shore 85", 100),
    ("eva-full-length", "TPU, Shore 95", 75), ("diabetic-full-length", "TPU, Shore 85", 75),
)  # fmt: skip
_LEAST_SHARE = 0.1


def main() -> None:
    """Slice the designs, and print a line of each zone and of all."""
    presets = {preset.name: preset for preset in read_print_presets()}
    devices = clinic_devices(Path("/nowhere")).load().items
    rows, away = [], []
    with tempfile.TemporaryDirectory() as folder:
        for number, (key, preset, weight_kg) in enumerate(_DESIGNS):
            foot = random_foot(7000 + number)
            design = apply_device(devices[key], InsoleDesign(foot.side))
            part = make_part(build_insole(foot, design), Order(), read_rules().only(()))
            plan = plan_of(presets[preset], weight_kg)
            printed = placed_print(zoned_part(part, plan).printed, standing(part.solid))
            told = printed_densities(printed, plan.layer_mm, 1.0).zones
            path = Path(folder) / "insole.3mf"
            write_slicer_3mf([printed], path, "prusaslicer")
            laid_mm3 = _laid(printed, path, plan.layer_mm)
            masses = {str(zone.name): zone.mass_g * 1000 for zone in told}
            for name, mm3 in {**masses, "all": sum(masses.values())}.items():
                real = sum(laid_mm3.values()) if name == "all" else laid_mm3.get(name, 0.0)
                if real < _LEAST_SHARE * sum(laid_mm3.values()):
                    continue
                off = mm3 / real - 1
                away.append(abs(off))
                rows.append([number, key, preset, name, f"{mm3:.0f}", f"{real:.0f}", f"{off:+.1%}"])
    print_table(["design", "device", "preset", "zone", "told mm³", "laid mm³", "off"], rows)
    print(f"of {len(away)} designs and larger zones, {sum(a > 0.05 for a in away)} are off by more "
          f"than 5 %; worst {max(away):.1%}")  # fmt: skip


def _laid(printed: PrintedPart, path: Path, layer_mm: float) -> dict[str, float]:
    """Return the plastic in mm³ that the slicer lays down in each zone."""
    result = sliced(path, path.parent, layer_mm)
    if result is None:
        raise SystemExit("the program prusa-slicer is not installed")
    places, plastic = result.pieces()
    plan: npt.NDArray[np.float64] = places[:, :2] - BED_MM / 2
    plan = plan + printed.mesh.bounds_mm.mean(axis=0)[:2]
    zone = np.full(len(plan), "", dtype=object)
    for modifier in printed.modifiers:
        outlines = to_manifold(modifier.mesh).project().to_polygons()
        zone[PlanPath(max(outlines, key=len)).contains_points(plan)] = modifier.name
    return {str(name): float(plastic[zone == name].sum()) for name in np.unique(zone)}


if __name__ == "__main__":
    main()
