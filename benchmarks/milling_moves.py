"""Every move of 50 programs: depth, width, flutes, falls into solid; tabs; time of a planner."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks._measure import print_table
from benchmarks._random_designs import DESIGNS_PER_FOOT, random_design, random_foot
from insole_core.errors import DesignError
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.device import Device, apply_device
from insole_core.milling.gcode import gcode
from insole_core.milling.machine import Machine, read_machine
from insole_core.milling.plan import MillingPlan, plan_milling
from insole_core.milling.sides import turned_over
from insole_core.resources import resource_path
from insole_core.solids.nesting import closest_nest
from insole_core.solids.simplification import simplify
from insole_core.solids.solid import make_solid
from insole_core.workflows.clinic_devices import clinic_devices
from tests.insole_core.milling.engagement import moves_of
from tests.insole_core.milling.judgement import seen_from_above, tab_thicknesses
from tests.insole_core.milling.planner import program_minutes
from tests.insole_core.milling.test_milling import left_of

_DESIGNS, _HEIGHT_MM, _PITCH_MM = 50, 60.0, 0.4
_MACHINES = ("linuxcnc", "grbl", "mach3")
_PAIR_EVERY = 5
_END_MM = {False: 15.0, True: 40.0}
"""From a piece to the ends of its block, whether or not it is turned over."""
_THICK, _TIME = 0.8, 0.1
"""Share of the thickness asked for below which a tab is told; and by which times may be off."""


def main() -> None:
    """Mill all designs; `INSOLE_BENCHMARK_SEEDS=FIRST:LAST` takes a part of them."""
    first, last = map(int, os.environ.get("INSOLE_BENCHMARK_SEEDS", f"0:{_DESIGNS - 1}").split(":"))
    devices = list(clinic_devices(Path("/nowhere")).load().items.values())
    rows, failed = [], []
    for number in range(first, last + 1):
        device, machine = devices[number % len(devices)], _machine(number)
        both = number % 2 == 1
        try:
            plan = _planned(_solid(number, device), machine, both, number % _PAIR_EVERY == 4)
        except DesignError as error:
            rows.append([number, device.name, str(error)])
            continue
        found = _found(plan, both)
        rows.append([number, device.name, machine.name, 1 + both, len(plan.solids), *found.cells])
        if not found.is_within:
            failed.append(number)
    print_table(
        ["design", "device", "machine", "sides", "pieces", "too deep", "mm", "too wide", "shank",
         "falls", "rapid mm", "thin tabs", "told", "time"],
        [row for row in rows if len(row) > 3],
    )  # fmt: skip
    print(f"beyond the limits: {failed or 'none'}; not made: {[r for r in rows if len(r) == 3]}")


def _machine(number: int) -> Machine:
    return read_machine(resource_path(f"milling/{_MACHINES[number % len(_MACHINES)]}.json"))


def _solid(number: int, device: Device) -> TriangleMesh:
    foot = random_foot(5000 + number // DESIGNS_PER_FOOT)
    design = apply_device(device, random_design(foot, np.random.default_rng(number)))
    return simplify(make_solid(build_insole(foot, design), "insole"), 40_000, 0.05).mesh


def _planned(solid: TriangleMesh, machine: Machine, both: bool, pair: bool) -> MillingPlan:
    if pair:
        nest = closest_nest(solid, solid.mirrored())
        width, length, _ = nest.size_mm
        more = np.array([0.0, 25.0 if both else 0.0, 0.0])
        pieces = [TriangleMesh(m.vertices + more, m.triangles) for m in nest.meshes]
        block_mm = (width, length + 2 * float(more[1]), _HEIGHT_MM)
        return plan_milling(pieces, block_mm, machine, both_sides=both)
    low, high = solid.bounds_mm
    end = _END_MM[both]
    moved = TriangleMesh(solid.vertices - low + [15.0, end, 0.0], solid.triangles)
    width, length = (float(size) for size in (high - low)[:2])
    block_mm = (width + 30, length + 2 * end, _HEIGHT_MM)
    return plan_milling([moved], block_mm, machine, both_sides=both)


@dataclass(frozen=True)
class _Found:
    """What breaks a rule: counts of moves, the way of the too deep ones, tabs, and the time."""

    too_deep: int
    too_deep_mm: float
    too_wide: int
    shank: int
    falls: int
    rapid_mm: float
    thin_tabs: int
    is_told: bool
    time: float

    @property
    def cells(self) -> list[str]:
        """For a line of the table."""
        return [
            f"{self.too_deep}", f"{self.too_deep_mm:.1f}", f"{self.too_wide}", f"{self.shank}",
            f"{self.falls}", f"{self.rapid_mm:.2f}", f"{self.thin_tabs}",
            "yes" if self.is_told else "no", f"{self.time:.3f}",
        ]  # fmt: skip

    @property
    def is_within(self) -> bool:
        """Whether no rule is broken."""
        moves = self.too_deep + self.too_wide + self.shank + self.falls
        tabs = not self.thin_tabs or self.is_told
        return not moves and tabs and self.rapid_mm < 0.05 and abs(self.time - 1) < _TIME


def _found(plan: MillingPlan, both: bool) -> _Found:
    how, program = plan.machine, gcode(plan)
    deep, deep_mm, wide, shank, falls, rapid_mm = 0, 0.0, 0, 0, 0, 0.0
    for moves in moves_of(plan):
        deep += int(moves.too_deep.sum())
        deep_mm += float(np.linalg.norm(moves.way_mm[moves.too_deep], axis=1).sum())
        wide += int(moves.too_wide.sum())
        shank += int(moves.above_flutes.sum())
        falls += int(moves.fast_plunges.sum())
        rapid_mm = max(rapid_mm, float(moves.depth_mm[~moves.cuts].max()))
    minutes, _, _ = program_minutes(program, how.rapid_mm_min, how.acceleration_mm_s2)
    return _Found(
        deep, deep_mm, wide, shank, falls, rapid_mm, _thin_tabs(plan, program, both),
        any("tabs stay thinner" in note for note in plan.notes), plan.minutes / minutes,
    )  # fmt: skip


def _thin_tabs(plan: MillingPlan, program: str, both: bool) -> int:
    how = plan.machine
    removal = left_of(plan, program, _PITCH_MM)
    inside = np.zeros(removal.heights.shape, bool)
    for solid in plan.solids:
        lying = turned_over(solid, plan.block_mm, how.both_sides.flip) if both else solid
        inside |= np.isfinite(seen_from_above(lying, removal)[0])
    left = tab_thicknesses(removal, inside, how.contour.cutter.diameter_mm)
    return int((left < _THICK * how.contour.tab_height_mm).sum())


if __name__ == "__main__":
    main()
