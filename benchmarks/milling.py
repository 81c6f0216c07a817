"""Random designs milled: by an independent removal of material, LinuxCNC's interpreter, time."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import count, islice
from pathlib import Path

import numpy as np

from benchmarks._random_designs import random_design, random_foot
from insole_core.errors import DesignError
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.milling.gcode import gcode
from insole_core.milling.machine import Machine, read_machine
from insole_core.milling.plan import MillingPlan, plan_milling
from insole_core.milling.sides import turned_over
from insole_core.resources import resource_path
from insole_core.solids.nesting import closest_nest
from insole_core.solids.shop import Block
from insole_core.solids.simplification import simplify
from insole_core.solids.solid import make_solid
from insole_core.workflows.mill import MillingChoice
from insole_core.workflows.nest_orders import OrderedPiece, nest_pieces, write_nest
from tests.insole_core.milling.engagement import moves_of
from tests.insole_core.milling.judgement import (
    edge_round,
    judge,
    seen_from_above,
    tabs_that_hold,
)
from tests.insole_core.milling.test_milling import left_of

DESIGNS, HEIGHT_MM = 50, 60.0
GOUGE_MM, SURPLUS_MM, SECONDS = 0.02, 0.05, 4.0
DAY_PAIRS, DAY_SECONDS = 12, 60.0
SHEET = Block("sheet", (1600.0, 1300.0, 40.0))
PITCH_MM = 0.3
BOTH_SIDES_EVERY = 5
LEAST_TABS = 0.8
"""Share that holds: where an edge falls steeply, or pieces lie close, one may hold nothing."""


def main() -> None:
    """Mill the designs; `INSOLE_BENCHMARK_SEEDS=FIRST:LAST` takes a part of them."""
    machine = read_machine(resource_path("milling/linuxcnc.json"))
    first, last = map(int, os.environ.get("INSOLE_BENCHMARK_SEEDS", "1:999").split(":"))
    failed: list[int] = []
    print(
        "seed  sides   gouge  surplus (99.99 %)  beside   rapid  tabs  fast falls  too deep"
        "  too wide  deepest  interpreter  CPU s"
    )
    done, seed = 0, first - 1
    while done < DESIGNS and seed < last:
        seed += 1
        solid = _solid(seed)
        if solid is None:
            continue
        done += 1
        both = seed % BOTH_SIDES_EVERY == 0
        started = time.process_time()
        plan = _planned(solid, machine, both)
        seconds = time.process_time() - started
        found, accepted = _judged(plan, both), _interpreted(gcode(plan))
        print(f"{seed:>4}{1 + both:>7}{found}  {accepted:<11}{seconds:>7.2f}", flush=True)
        if not found.is_within(machine.contour.tabs) or accepted == "refused":
            failed.append(seed)
    plan, cpu, wall = _pair()
    found = _judged(plan, both=False)
    print(f"pair       {found}  {_interpreted(gcode(plan)):<11}")
    if not found.is_within(2 * machine.contour.tabs):
        failed.append(0)
    print(f"a pair roughed, finished and cut: {cpu:.2f} s CPU, {wall:.2f} s; limit {SECONDS} s")
    day_cpu, day_wall = _day(machine)
    print(
        f"a day of {DAY_PAIRS} pairs nested, milled and written: {day_cpu:.1f} s CPU, "
        f"{day_wall:.1f} s; limit {DAY_SECONDS} s"
    )
    if failed or cpu > SECONDS or day_cpu > DAY_SECONDS:
        raise SystemExit(f"beyond the limits: {failed}, {cpu:.2f} s, {day_cpu:.1f} s")


def _planned(solid: TriangleMesh, machine: Machine, both: bool) -> MillingPlan:
    ends = 40.0 if both else 15.0
    low, high = solid.bounds_mm
    moved = TriangleMesh(solid.vertices - low + [15.0, ends, 0.0], solid.triangles)
    block_mm = (float(high[0] - low[0]) + 30, float(high[1] - low[1]) + 2 * ends, HEIGHT_MM)
    return plan_milling([moved], block_mm, machine, both_sides=both)


def _solid(seed: int) -> TriangleMesh | None:
    foot = random_foot(seed)
    try:
        insole = build_insole(foot, random_design(foot, np.random.default_rng(seed)))
        solid = simplify(make_solid(insole, "insole"), 40_000, 0.05).mesh
    except DesignError:
        return None
    return solid if np.ptp(solid.vertices[:, 2]) < HEIGHT_MM else None


@dataclass(frozen=True)
class _Result:
    """Worst of all sides, mm; and by how many tabs the piece is held in the end."""

    gouge_mm: float
    surplus_mm: float
    usual_mm: float
    beside_mm: float
    rapid_mm: float
    tabs: int
    fast_falls: int
    too_deep: int
    too_wide: int
    deepest_mm: float

    def __str__(self) -> str:
        return (
            f"{self.gouge_mm:>8.3f}{self.surplus_mm:>9.3f}{self.usual_mm:>10.3f}"
            f"{self.beside_mm:>8.3f}{self.rapid_mm:>8.3f}{self.tabs:>6}"
            f"{self.fast_falls:>12}{self.too_deep:>10}{self.too_wide:>10}{self.deepest_mm:>9.1f}"
        )

    def is_within(self, tabs: int) -> bool:
        """Whether the figures are within the limits."""
        return (
            self.gouge_mm <= GOUGE_MM
            and max(self.usual_mm, self.beside_mm) <= SURPLUS_MM
            and self.rapid_mm <= 0.01
            and self.tabs >= LEAST_TABS * tabs
            and not self.fast_falls
            and not self.too_deep
            and not self.too_wide
        )


def _judged(plan: MillingPlan, both: bool) -> _Result:
    removal, machine = left_of(plan, gcode(plan), PITCH_MM), plan.machine
    lying, height = _joined(plan.solids), plan.block_mm[2]
    tab, flip = machine.contour.tab_height_mm, machine.both_sides.flip
    sides: list[tuple[TriangleMesh, FloatArray, float | FloatArray]]
    sides = [(lying, removal.sides[0], tab)]
    if both:
        turned = turned_over(lying, plan.block_mm, flip)
        edge = edge_round(turned, removal)
        below = np.flip(height - edge, axis=0 if flip == "length" else 1)
        sides = [(lying, removal.sides[0], below + tab), (turned, removal.sides[1], edge)]
    found = [judge(mesh, left, removal, machine, floor) for mesh, left, floor in sides]
    inside = np.isfinite(seen_from_above(sides[-1][0], removal)[0])
    return _Result(
        max(each.gouge_mm for each in found),
        max(each.surplus_mm for each in found),
        max(each.usual_surplus_mm for each in found),
        max(each.beside_mm for each in found),
        removal.rapid_cuts_mm,
        tabs_that_hold(removal, inside, machine.contour.cutter.diameter_mm),
        *_engaged(plan),
    )


def _engaged(plan: MillingPlan) -> tuple[int, int, int, float]:
    """Count falls at cutting feed, too deep moves and too wide ones; give the deepest."""
    fast, deep, wide, deepest = 0, 0, 0, 0.0
    for moves in moves_of(plan):
        fast += int(moves.fast_plunges.sum())
        deep += int((moves.too_deep | moves.above_flutes).sum())
        wide += int(moves.too_wide.sum())
        deepest = max(deepest, float(moves.depth_mm[moves.cuts].max()))
    return fast, deep, wide, deepest


def _joined(solids: Sequence[TriangleMesh]) -> TriangleMesh:
    counts = np.cumsum([0, *(len(solid.vertices) for solid in solids)])
    return TriangleMesh(
        np.concatenate([solid.vertices for solid in solids]),
        np.concatenate([s.triangles + n for s, n in zip(solids, counts[:-1], strict=True)]),
    )


def _interpreted(text: str) -> str:
    program = shutil.which("rs274")
    if program is None:
        return "missing"
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "piece.ngc").write_text(text, encoding="ascii")
        Path(folder, "tools.tbl").write_text("T1 P1 Z0 D6\nT2 P2 Z0 D6\n", encoding="ascii")
        Path(folder, "variables").touch()
        call = [program, "-t", "tools.tbl", "-v", "variables", "-g", "piece.ngc", "moves"]
        done = subprocess.run(call, cwd=folder, capture_output=True, check=False)
    return "refused" if done.returncode else "accepted"


def _pair() -> tuple[MillingPlan, float, float]:
    """Return the plan of a pair, with its processor and wall time, the least of three."""
    solid = next(solid for solid in map(_solid, range(1, 100)) if solid is not None)
    nest = closest_nest(solid, solid.mirrored())
    width, length, _ = nest.size_mm
    machine = read_machine(resource_path("milling/linuxcnc.json"))
    times = []
    for _ in range(3):
        started, began = time.process_time(), time.perf_counter()
        plan = plan_milling(nest.meshes, (width, length, HEIGHT_MM), machine)
        times.append((time.process_time() - started, time.perf_counter() - began))
    return plan, *min(times)


def _day(machine: Machine) -> tuple[float, float]:
    """Return processor and wall time of all files of a day's pairs on one sheet."""
    solids = (solid for solid in map(_solid, count(1)) if solid is not None)
    low = (solid for solid in solids if np.ptp(solid.vertices[:, 2]) < SHEET.size_mm[2])
    pieces = [
        OrderedPiece(f"26-{number}", side, solid if side is Side.LEFT else solid.mirrored())
        for number, solid in enumerate(islice(low, DAY_PAIRS), 1)
        for side in Side
    ]
    length = SHEET.sides_mm[0]
    router = replace(machine, travel_mm=(length, length, machine.travel_mm[2]))
    started, began = time.process_time(), time.perf_counter()
    nest = nest_pieces(pieces, SHEET, across=False)
    with tempfile.TemporaryDirectory() as folder:
        write_nest(nest, Path(folder, "day.3mf"), title="day", milling=MillingChoice(router))
    return time.process_time() - started, time.perf_counter() - began
