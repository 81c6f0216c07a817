"""Strict and lenient presets of a simulated D415, by what is left of feet.

Makers state of their presets that *high accuracy* leaves out what is doubtful and *high density*
keeps it. Here a camera leaves out windows whose correlation is below a threshold, and nothing else
differs. Each foot is reconstructed from the camera's depth, and with its infrared pair matched
anew. ``FEET`` is the number of feet (6), at 450 to 600 mm in turn.

``readings`` is the share of the pixels with depth, relative to the usual threshold of 0.6; the
other columns are those of ``stereo_feet``.
"""

from __future__ import annotations

import os
from collections import defaultdict

import numpy as np
import trimesh

from benchmarks._measure import print_table
from benchmarks.infrared import figures
from benchmarks.stereo_feet import DISTANCES_MM
from insole_core.reconstruct import reconstruct
from insole_core.reconstruct.result import DepthSource
from insole_core.simulate import SimulatedSession, SimulationOptions, simulate_session

FEET = int(os.environ.get("FEET", "6"))
PRESETS = {"high density": 0.4, "usual": 0.6, "high accuracy": 0.8}
"""Least correlation of windows."""
WAYS: dict[str, DepthSource] = {"camera's depth": "chip", "pair anew": "auto"}
_FRAMES = 6


def main() -> None:
    rows: dict[tuple[str, str], list[dict[str, float]]] = defaultdict(list)
    for number in range(FEET):
        made = {name: _simulated(number, least) for name, least in PRESETS.items()}
        usual = _readings(made["usual"])
        for name, one in made.items():
            truth = trimesh.Trimesh(one.truth.vertices, one.truth.triangles, process=False)
            for way, depth in WAYS.items():
                mesh = reconstruct(one.session, depth=depth).mesh
                found = {"readings": _readings(one) / usual, **figures(mesh, truth)}
                rows[name, way].append(found)
                print(number, name, way, *_shown([found]), flush=True)
    head = ["preset", "", *next(iter(rows.values()))[0]]
    print_table(head, [[*key, *_shown(of)] for key, of in rows.items()])


def _simulated(number: int, least_likeness: float) -> SimulatedSession:
    return simulate_session(
        SimulationOptions(
            seed=3000 + number,
            distance_mm=DISTANCES_MM[number % len(DISTANCES_MM)],
            frames=_FRAMES,
            sensor="d415",
            least_likeness=least_likeness,
        )
    )


def _readings(made: SimulatedSession) -> float:
    return float(np.mean([(view.read_depth(0) > 0).mean() for view in made.session.views]))


def _shown(found: list[dict[str, float]]) -> list[str]:
    return [f"{np.mean([one[key] for one in found]):.3f}" for key in found[0]]
