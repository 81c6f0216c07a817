"""How near a pressure map is laid to where it was pressed, over feet, places and missing parts."""

from __future__ import annotations

import time

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.side import Side
from insole_core.pressure.alignment import Alignment, align_pressure
from insole_core.pressure.laid_map import Placement, PressureMap
from insole_core.pressure.recording import SeenFrom
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import vary_shape
from insole_core.simulate.plantar_pressure import pressed

FEET, EACH = 8, 4
LIMIT_MM = 3.0


def _feet(rng: np.random.Generator) -> list[Foot]:
    sides = [list(Side)[number % 2] for number in range(FEET)]
    meshes = [build_foot(vary_shape(rng, side), rng, cell_mm=3.0).mesh for side in sides]
    return [
        place_foot(mesh, side, frame="reference") for mesh, side in zip(meshes, sides, strict=True)
    ]


def _off_mm(found: Alignment, laid: PressureMap) -> float:
    points = laid.centres_mm[laid.kpa > 0]
    off = found.placement.to_insole(points) - laid.placement.to_insole(points)
    return float(np.sqrt((off**2).sum(axis=1).mean()))


def main() -> None:
    rng = np.random.default_rng(5)
    feet = _feet(rng)
    print(f"{FEET * EACH} maps each; limit {LIMIT_MM} mm rms")
    print(f"{'missing':<10}{'rms':>7}{'max':>7}  doubted  other side told  seconds each")
    for missing in ("", "toes", "midfoot", "rear"):
        off, doubted, told, seconds = [], 0, 0, 0.0
        for foot in feet * EACH:
            x_mm, y_mm, turn_deg = rng.uniform([-40, 80, -180], [40, 160, 180])
            laid = pressed(foot, Placement(x_mm, y_mm, turn_deg), rng, missing)
            started = time.process_time()
            found = align_pressure(foot, laid, SeenFrom.ABOVE)
            seconds += time.process_time() - started
            doubted += bool(found.doubt)
            if not found.doubt:  # too little contact; the user is told to lay it by hand
                off.append(_off_mm(found, laid))
            told += bool(align_pressure(foot, laid, SeenFrom.BELOW).doubt)
        rms = float(np.sqrt(np.mean(np.square(off))))
        print(
            f"{missing or 'nothing':<10}{rms:>7.2f}{max(off):>7.2f}{doubted:>9}"
            f"{told:>10} of {FEET * EACH}{seconds / FEET / EACH:>12.2f}"
        )
        if rms > LIMIT_MM or told < FEET * EACH:
            raise SystemExit(1)
