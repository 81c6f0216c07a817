"""Random designs milled: by an independent removal of material, LinuxCNC's interpreter, time."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
import scipy

from benchmarks._random_designs import random_design, random_foot
from insole_core.errors import DesignError
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import build_insole
from insole_core.milling.gcode import gcode
from insole_core.milling.machine import read_machine
from insole_core.milling.plan import MillingPlan, plan_milling
from insole_core.resources import resource_path
from insole_core.solids.nesting import closest_nest
from insole_core.solids.simplification import simplify
from insole_core.solids.solid import make_solid
from tests.insole_core.milling.test_milling import cusp_mm, least_near, left_of, seen_from_above

DESIGNS, HEIGHT_MM = 50, 60.0
GOUGE_MM, SURPLUS_MM, SECONDS = 0.02, 0.05, 1.5
PITCH_MM = 0.5


def main() -> None:
    machine = read_machine(resource_path("milling/linuxcnc.json"))
    failed = []
    print("seed  gouge   surplus over what the ball reaches (99 %)  rapid  interpreter  CPU s")
    done, seed = 0, 0
    while done < DESIGNS:
        seed += 1
        solid = _solid(seed)
        if solid is None:
            continue
        done += 1
        low, high = solid.bounds_mm
        moved = TriangleMesh(solid.vertices - low + [15.0, 15.0, 0.0], solid.triangles)
        block_mm = (float(high[0] - low[0]) + 30, float(high[1] - low[1]) + 30, HEIGHT_MM)
        started = time.process_time()
        plan = plan_milling([moved], block_mm, machine)
        seconds = time.process_time() - started
        gouge, surplus, rapid = _judged(plan, moved)
        accepted = _interpreted(gcode(plan))
        print(
            f"{seed:>4}{gouge:>8.3f}{surplus:>10.3f}{rapid:>40.3f}  {accepted:<11}{seconds:>6.2f}",
            flush=True,
        )
        if gouge > GOUGE_MM or surplus > SURPLUS_MM or rapid > 0.01 or accepted == "refused":
            failed.append(seed)
    seconds = _pair_seconds()
    print(f"a pair roughed, finished and cut: {seconds:.2f} s; limit {SECONDS} s")
    if failed or seconds > SECONDS:
        raise SystemExit(f"beyond the limits: {failed}, {seconds:.2f} s")


def _solid(seed: int) -> TriangleMesh | None:
    foot = random_foot(seed)
    try:
        insole = build_insole(foot, random_design(foot, np.random.default_rng(seed)))
        solid = simplify(make_solid(insole, "insole"), 40_000, 0.05).mesh
    except DesignError:
        return None
    return solid if np.ptp(solid.vertices[:, 2]) < HEIGHT_MM else None


def _judged(plan: MillingPlan, solid: TriangleMesh) -> tuple[float, float, float]:
    """Return gouge, surplus over cusp and closing at 99 % of the pixels, and cut in rapid."""
    removal = left_of(plan, gcode(plan), PITCH_MM)
    asked, cosine = seen_from_above(solid, removal)
    gouge = -float(np.nanmin(removal.heights - least_near(solid, removal, GOUGE_MM)))
    within = scipy.ndimage.binary_erosion(np.isfinite(asked), iterations=6)
    nearest = scipy.ndimage.distance_transform_edt(
        ~within, return_distances=False, return_indices=True
    )
    radius = plan.machine.finishing.cutter.radius_mm
    reach = int(radius / PITCH_MM)
    i, j = np.mgrid[-reach : reach + 1, -reach : reach + 1] * PITCH_MM
    ball = np.sqrt(np.maximum(radius**2 - i**2 - j**2, 0)) - 1e3 * (i**2 + j**2 > radius**2)
    centres = scipy.ndimage.grey_dilation(asked[tuple(nearest)], structure=ball)
    reached = -scipy.ndimage.grey_dilation(-centres, structure=ball)
    surplus = (removal.heights - reached) * cosine - cusp_mm(cosine, plan.machine)
    return gouge, float(np.quantile(surplus[within], 0.99)), removal.rapid_cuts_mm


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


def _pair_seconds() -> float:
    solid = next(solid for solid in map(_solid, range(1, 100)) if solid is not None)
    mirrored = TriangleMesh(solid.vertices * [-1, 1, 1], solid.triangles[:, ::-1])
    nest = closest_nest(solid, mirrored)
    width, length, _ = nest.size_mm
    machine = read_machine(resource_path("milling/linuxcnc.json"))
    times = []
    for _ in range(3):
        started = time.process_time()
        plan_milling(nest.meshes, (width, length, HEIGHT_MM), machine)
        times.append(time.process_time() - started)
    return min(times)
